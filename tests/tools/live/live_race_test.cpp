// Races of what a capture shares, under the thread sanitizer in every build: a capture that writes beside
// watchers that read and ask. The sanitizer goes by addresses, and two mappings of one file have two: the
// lock itself is tried at one address, page and picture for copies that are torn.
#include <atomic>
#include <thread>

#include "live_samples.h"
#include "run/sequenced_words.h"

namespace tilepress {
namespace {

using LiveRace = LiveFolderTest;

TEST(SequencedWords, AReaderAtTheSameAddressHasNoRaceAndNoMixture) {
  constexpr size_t kCount = 64;
  std::atomic<uint64_t> sequence{0};
  uint64_t shared[kCount] = {};
  std::atomic<bool> done{false};
  std::atomic<uint64_t> whole{0};
  std::thread reader([&] {
    while (!done) {
      uint64_t copy[kCount];
      const SequencedRead read(sequence);
      load_words(shared, copy, kCount);
      if (!read.whole()) continue;
      for (const uint64_t word : copy) ASSERT_EQ(word, copy[0]);
      ++whole;
    }
  });
  for (uint64_t n = 1; n < 5000 || (whole < 100 && !testing::Test::HasFailure()); ++n) {
    uint64_t words[kCount];
    for (uint64_t& word : words) word = n;
    const SequencedWrite write(sequence);
    store_words(shared, words, kCount);
  }
  done = true;
  reader.join();
}

TEST_F(LiveRace, SnapshotsOfThePageAreNeverTorn) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  update_page(writer, 1);
  std::atomic<bool> done{false};
  std::atomic<uint64_t> seen{0};
  const auto watch = [&] {
    LiveReader reader;
    ASSERT_TRUE(reader.open(folder_, true));
    uint64_t last = 0;
    while (!done) {
      reader.ask_for_pictures();
      LiveState state{};
      if (!reader.read(state)) continue;
      ASSERT_EQ(state.captured, state.frame);
      ASSERT_EQ(state.schemes[0].raw_bits, 512 * state.frame);
      ASSERT_EQ(state.schemes[1].moved_bits, 128 * state.frame);
      ASSERT_GE(state.frame, last);
      last = state.frame;
      ++seen;
    }
  };
  std::thread first(watch), second(watch);
  uint64_t pictures = 0;
  for (uint64_t n = 2; n < 5000 || (seen < 100 && !HasFailure()); ++n) {
    update_page(writer, n);
    pictures += writer.picture_wanted();
  }
  done = true;
  first.join();
  second.join();
  EXPECT_GE(pictures, 1u);
}

TEST_F(LiveRace, PicturesAreNeverTornAcrossSizes) {
  LivePictureWriter writer;
  std::atomic<bool> done{false};
  std::atomic<uint64_t> seen{0};
  std::thread reader([&] {
    LivePicture picture;
    while (!done)
      if (read_live_picture(folder_, picture)) {
        ASSERT_TRUE(is_sample(picture, static_cast<uint32_t>(picture.head.state.frame)));
        ++seen;
      }
  });
  for (uint32_t n = 1; n < 300 || (seen < 20 && !HasFailure()); ++n) {
    const SamplePicture sample(n, n < 100 ? 16 : 40, n % 3 == 0 ? 9 : 24);
    ASSERT_EQ(writer.write(folder_, sample_state(n), sample.view, sample.bits, 128), 0);
  }
  done = true;
  reader.join();
  EXPECT_GE(seen, 20u);
}

}  // namespace
}  // namespace tilepress
