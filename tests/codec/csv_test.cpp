// CSV rows: quoting, numbers, columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "tilepress/statistics_rows.h"

using namespace tilepress;

TEST(Csv, QuotesAFieldOnlyWhereItMust) {
  EXPECT_EQ(csv_field("vdcp"), "vdcp");
  EXPECT_EQ(csv_field("vdcp:fvc=128,policy=2lfc"), "\"vdcp:fvc=128,policy=2lfc\"");
  EXPECT_EQ(csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST(Csv, NumbersReadBackExactly) {
  EXPECT_EQ(csv_number(0), "0");
  EXPECT_EQ(csv_number(0.5), "0.5");
  EXPECT_EQ(csv_number(42.0), "42");
  for (const double value : {1.0 / 3, 5.26, 1e-9, 123456789.123}) {
    const std::string text = csv_number(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value) << text;
  }
}

TEST(Csv, HeadersBeginWithTheAgreedColumns) {
  EXPECT_EQ(
      frames_csv_header(),
      "frame,surface,width,height,format,warmup,time_ns,unique_colors,entropy,pixel_change,color_change,"
      "fvc_coverage,fvc_relative_coverage,top100_coverage,readback_ns,encode_ns\n");
  EXPECT_EQ(
      schemes_csv_header().find("frame,surface,scheme,warmup,blocks,raw_bits,payload_bits,bursts,csb_bits,"
                                "palette_bits,rate_payload,rate,"),
      0u);
}

TEST(Csv, ARowPerSchemeWithAsManyFieldsAsTheHeader) {
  FrameStatistics frame;
  frame.frame = 7;
  frame.surface = 2;
  frame.schemes.resize(2);
  frame.schemes[0].blocks = 1;
  frame.schemes[0].raw_bits = 2048;
  frame.schemes[0].payload_bits = 1000;
  frame.schemes[0].bursts = 8;
  frame.schemes[0].csb_bits = 24;
  std::string rows;
  append_schemes_rows(frame, {"ras", "red"}, rows);
  // rate_payload = 2048 / 1024 = 2, rate = 2048 / (8·128 + 24) = 1.954…
  EXPECT_EQ(rows.find("7,2,ras,0,1,2048,1000,8,24,0,2,1.95419847328244"), 0u) << rows;
  const std::string header = schemes_csv_header(), first = rows.substr(0, rows.find('\n'));
  EXPECT_EQ(std::count(first.begin(), first.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 2);

  frame.format = PixelFormat::kRgb565;
  frame.width = 640;
  frame.height = 480;
  frame.warmup = true;
  std::string row;
  append_frames_row(frame, row);
  EXPECT_EQ(row.find("7,2,640,480,RGB565,1,0,0,0,"), 0u) << row;
}

/// Prints `row`, reads each field into a new row, and expects that row to print the same.
template <class Row>
void expect_to_read_back(std::span<const CsvColumn<Row>> columns, const Row& row) {
  std::vector<std::string> fields;
  for (const auto& column : columns) column.print(row, fields.emplace_back());
  Row back;
  for (size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].read == nullptr) continue;
    EXPECT_TRUE(columns[i].read(fields[i], back)) << columns[i].name;
    std::string again;
    columns[i].print(back, again);
    EXPECT_EQ(again, fields[i]) << columns[i].name;
  }
}

TEST(Csv, EachColumnReadsBackWhatItPrinted) {
  FrameStatistics frame;
  frame.frame = 7;
  frame.surface = 2;
  frame.width = 640;
  frame.height = 480;
  frame.format = PixelFormat::kRgb10a2;
  frame.warmup = true;
  frame.time_ns = 1'000'000'007;
  frame.metrics = {12, 3.25, 0.5, 0.25, 1.0 / 3, 0.75, 0.875};
  frame.readback_ns = 8;
  frame.encode_ns = 9;
  expect_to_read_back(frame_columns(), frame);

  SchemeRow row{7, 2, "ras", true, {}};
  row.figures.blocks = 1;
  row.figures.raw_bits = 2048;
  row.figures.payload_bits = 1000;
  row.figures.bursts = 8;
  row.figures.csb_bits = 24;
  row.figures.palette_bits = 66;
  row.figures.extra_bits = 3;
  row.figures.checked_blocks = 4;
  row.figures.mismatched_blocks = 5;
  row.figures.fvc = {0.75, 1.0 / 3};
  expect_to_read_back(scheme_columns(), row);
  expect_to_read_back(scheme_check_columns(), row);
}

TEST(Csv, AColumnRefusesAFieldThatIsNone) {
  FrameStatistics frame;
  for (const auto& column : frame_columns()) {
    if (column.name == "warmup") continue;
    EXPECT_FALSE(column.read("", frame)) << column.name;
    EXPECT_FALSE(column.read("12x", frame)) << column.name;
  }
}

TEST(Statistics, ARateOfNothingMovedIsZeroNotInfinite) {
  SchemeStatistics nothing;
  EXPECT_EQ(nothing.rate(), 0.0);
  EXPECT_EQ(nothing.rate_payload(), 0.0);
}

TEST(Statistics, ARunsRateIsTheQuotientOfTheSums) {
  SchemeStatistics a, b;
  a.raw_bits = b.raw_bits = 2048;
  a.bursts = 4;   // 512 bits
  b.bursts = 12;  // 1536 bits
  a += b;
  EXPECT_EQ(a.rate(), 2.0);  // 4096 / 2048, not the mean of 4 and 1.33
}
