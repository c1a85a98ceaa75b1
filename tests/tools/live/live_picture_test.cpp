// Tests of the live picture: asked for, given whole, gone with the run.
#include "tilepress/live_picture.h"

#include <cerrno>
#include <fstream>

#include "live_samples.h"

namespace tilepress {
namespace {

using LivePictureTest = LiveFolderTest;

int write_sample(LivePictureWriter& writer, const std::string& folder, uint32_t n, uint32_t width = 21,
                 uint32_t height = 11) {
  const SamplePicture picture(n, width, height);
  return writer.write(folder, sample_state(n), picture.view, picture.bits, 128);
}

TEST_F(LivePictureTest, NobodyGetsPicturesWhoDoesNotAsk) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  LiveReader top, view;
  ASSERT_TRUE(top.open(folder_));
  EXPECT_FALSE(writer.picture_wanted());
  ASSERT_TRUE(view.open(folder_, true));
  EXPECT_FALSE(writer.picture_wanted());
  view.ask_for_pictures();
  EXPECT_TRUE(writer.picture_wanted());
}

TEST_F(LivePictureTest, AtMostOnePictureIn100Milliseconds) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  LiveReader view;
  ASSERT_TRUE(view.open(folder_, true));
  view.ask_for_pictures();
  const auto begin = std::chrono::steady_clock::now();
  uint64_t given = 0;
  for (int i = 0; i < 20000; ++i) given += writer.picture_wanted();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(given, 1u);
  EXPECT_LE(static_cast<double>(given), 1 + elapsed.count() / 0.1);
}

TEST_F(LivePictureTest, APictureComesWholeAndOnce) {
  LivePictureWriter writer;
  LivePicture picture;
  EXPECT_FALSE(read_live_picture(folder_, picture));
  ASSERT_EQ(write_sample(writer, folder_, 7), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  EXPECT_EQ(picture.head.width, 21u);
  EXPECT_EQ(picture.head.height, 11u);
  EXPECT_EQ(picture.head.blocks_x, 3u);
  EXPECT_EQ(picture.head.blocks_y, 2u);
  EXPECT_EQ(picture.head.raw_bits, 2048u);
  EXPECT_EQ(picture.head.burst_bits, 128u);
  EXPECT_TRUE(is_sample(picture, 7));
  EXPECT_FALSE(read_live_picture(folder_, picture));
  ASSERT_EQ(write_sample(writer, folder_, 8), 0);
  ASSERT_EQ(write_sample(writer, folder_, 9), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  EXPECT_TRUE(is_sample(picture, 9));
}

TEST_F(LivePictureTest, ASchemeThatSkipsTheSurfaceHasNoBits) {
  LivePictureWriter writer;
  LivePicture picture;
  ASSERT_EQ(write_sample(writer, folder_, 4), 0);
  SamplePicture sample(6, 21, 11);
  sample.bits.schemes[0].clear();
  ASSERT_EQ(writer.write(folder_, sample_state(6), sample.view, sample.bits, 128), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  ASSERT_EQ(picture.bits.size(), 2u);
  EXPECT_TRUE(picture.bits[0].empty());
  EXPECT_EQ(picture.bits[1], std::vector<uint16_t>(6, 7));
}

TEST_F(LivePictureTest, PicturesOfAnySizeFollowEachOther) {
  LivePictureWriter writer;
  LivePicture picture;
  ASSERT_EQ(write_sample(writer, folder_, 1), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  ASSERT_EQ(write_sample(writer, folder_, 2, 200, 100), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  EXPECT_TRUE(is_sample(picture, 2));
  ASSERT_EQ(write_sample(writer, folder_, 3, 8, 8), 0);
  ASSERT_TRUE(read_live_picture(folder_, picture));
  EXPECT_TRUE(is_sample(picture, 3));
}

TEST_F(LivePictureTest, TheFileGoesWithTheRunAndTheLastPictureStaysReadable) {
  LivePictureWriter writer;
  LivePicture picture;
  ASSERT_EQ(write_sample(writer, folder_, 4), 0);
  EXPECT_TRUE(has(kLivePictureFile));
  ASSERT_TRUE(read_live_picture(folder_, picture));
  writer.close();
  EXPECT_FALSE(has(kLivePictureFile));
  EXPECT_FALSE(read_live_picture(folder_, picture));
  EXPECT_TRUE(is_sample(picture, 4));
}

TEST_F(LivePictureTest, WhatCannotBeMadeIsToldToTheWatcher) {
  LivePictureWriter pictures;
  EXPECT_EQ(write_sample(pictures, folder_ + "/missing", 1), ENOENT);
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  LiveReader view;
  ASSERT_TRUE(view.open(folder_, true));
  EXPECT_EQ(view.picture_error(), 0);
  writer.set_picture_error(ENOSPC);
  EXPECT_EQ(view.picture_error(), ENOSPC);
}

TEST_F(LivePictureTest, FilesOfOthersAreNotRead) {
  LivePicture picture;
  const std::string path = folder_ + "/" + kLivePictureFile;
  std::ofstream(path) << "TPPICT";
  EXPECT_FALSE(read_live_picture(folder_, picture));
  std::ofstream(path) << std::string(100'000, '\xFF');
  EXPECT_FALSE(read_live_picture(folder_, picture));
  std::filesystem::remove(path);

  // A picture whose size was changed behind the capture's back, so that it would reach past the file's end.
  LivePictureWriter writer;
  ASSERT_EQ(write_sample(writer, folder_, 5), 0);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  LivePictureHead head;
  file.read(reinterpret_cast<char*>(&head), sizeof head);
  head.width = head.height = 60000;
  head.blocks_x = head.blocks_y = 7500;
  file.seekp(0).write(reinterpret_cast<const char*>(&head), sizeof head);
  file.close();
  EXPECT_FALSE(read_live_picture(folder_, picture));
}

}  // namespace
}  // namespace tilepress
