// CSV rows: quotes, columns found by name, and the rows that the shim writes.
#include "tilepress/csv_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tilepress/present_rows.h"

namespace tilepress {
namespace {

using ::testing::ElementsAre;

TEST(CsvReader, KnowsQuotesAsRfc4180HasThem) {
  const std::string text = "a,\"b,1\",\"c\"\"q\"\r\n\"two\nlines\",,\nunfinished,\"";
  CsvReader reader(text);
  std::vector<std::string> fields;
  ASSERT_TRUE(reader.next(fields));
  EXPECT_THAT(fields, ElementsAre("a", "b,1", "c\"q"));
  ASSERT_TRUE(reader.next(fields));
  EXPECT_THAT(fields, ElementsAre("two\nlines", "", ""));
  EXPECT_FALSE(reader.next(fields));
  EXPECT_EQ(text.substr(reader.offset()), "unfinished,\"");
}

struct Pair {
  uint64_t left = 1, right = 2;
};
constexpr CsvColumn<Pair> kPairColumns[] = {csv_column<Pair, &Pair::left>("left"),
                                            csv_column<Pair, &Pair::right>("right", true)};

/// "left right" of the first record, or what is wrong with it.
std::string first_pair(const char* text) {
  CsvRecords records(text);
  const CsvRowReader<Pair> reader(records, kPairColumns);
  if (!records.next()) return "no record";
  Pair pair;
  const auto read = reader.read(pair);
  return read ? std::to_string(pair.left) + " " + std::to_string(pair.right) : read.error().text;
}

TEST(CsvRows, FindColumnsByName) {
  EXPECT_EQ(first_pair("right,other,left\n5,x,4\n"), "4 5");
  EXPECT_EQ(first_pair("left,left\n3,4\n"), "4 2") << "of two columns with one name the last counts";
  EXPECT_EQ(first_pair("left\n"), "no record");
}

TEST(CsvRows, OnlyAnOptionalColumnMayBeMissingOrEmpty) {
  EXPECT_EQ(first_pair("left\n7\n"), "7 2");
  EXPECT_EQ(first_pair("left,right\n7,\n"), "7 2");
  EXPECT_EQ(first_pair("right\n7\n"), "record 2: left: the field is missing");
  EXPECT_EQ(first_pair("left,right\n7\n"), "record 2: right: the field is missing");
  EXPECT_EQ(first_pair("left,right\n,7\n"), "record 2: left: cannot read ''");
}

TEST(PresentRows, HaveTheColumnsThatTheirReadersKnow) {
  EXPECT_EQ(
      csv_header(kPresentColumns),
      "frame,surface,readback_ns,read_ns,wait_ns,damage,bind_ns,hand_off_ns,interval_ns,cause,readback\n");
  EXPECT_EQ(csv_header(kSurfaceColumns), "surface,role,origin,width,height,format,color_space\n");
  EXPECT_EQ(csv_header(kPresentTimeColumns), "surface,begin_ns,hook_ns\n");
}

TEST(PresentRows, AreReadBack) {
  PresentRow row;
  row.frame = 3;
  row.wait_ns = 5;
  row.damage = "0 0 8 8;8 8 4 4";
  row.cause = "swap";
  row.readback = "in-context";
  std::string text = csv_header(kPresentColumns);
  append_csv_row(kPresentColumns, row, text);
  EXPECT_THAT(text, ::testing::EndsWith("\n3,0,0,0,5,0 0 8 8;8 8 4 4,0,0,0,swap,in-context\n"));
  CsvRecords records(text);
  const CsvRowReader<PresentRow> reader(records, kPresentColumns);
  ASSERT_TRUE(records.next());
  PresentRow back;
  ASSERT_TRUE(reader.read(back));
  EXPECT_EQ(back.frame, 3u);
  EXPECT_EQ(back.wait_ns, 5u);
  EXPECT_EQ(back.damage, row.damage);
  EXPECT_EQ(back.readback, "in-context");
}

}  // namespace
}  // namespace tilepress
