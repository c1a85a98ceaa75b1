// Tests of the window's arithmetic: keys, places, colours. No window is opened.
#include <gtest/gtest.h>

#include "live/heat_colors.h"
#include "live/view/view_pixels.h"
#include "live/view/view_request.h"
#include "live/view/view_state.h"

namespace tilepress {
namespace {

LivePicture picture_of(PixelFormat format, uint32_t width, uint32_t height) {
  LivePicture out;
  out.head.number = 1;
  out.head.width = width;
  out.head.height = height;
  out.head.format = static_cast<uint64_t>(format);
  out.head.blocks_x = (width + 7) / 8;
  out.head.blocks_y = (height + 7) / 8;
  out.head.raw_bits = 2048;
  out.head.burst_bits = 128;
  out.pixels.resize(out.head.blocks_x * 8 * height);
  out.bits = {std::vector<uint16_t>(out.head.blocks_x * out.head.blocks_y)};
  return out;
}

TEST(ViewRequest, GoesToTheWindowAndBackUnchanged) {
  ViewRequest request;
  request.folder = "a folder";
  request.scheme = "vdcp:fvc=128,policy=2lfc";
  request.screenshot = "x y.png";
  request.width = 390;
  request.zoom = 3;
  request.overlay = Overlay::kHeatOnly;
  request.wait_s = 99;
  const auto back = from_arguments(to_arguments(request));
  ASSERT_TRUE(back);
  EXPECT_EQ(to_arguments(*back), to_arguments(request));
  EXPECT_EQ(back->folder, "a folder");
  EXPECT_EQ(back->overlay, Overlay::kHeatOnly);
  EXPECT_FALSE(from_arguments({}));
  EXPECT_FALSE(from_arguments({"d", "", "", "9x", "640", "0", "blend", "10"}));
  EXPECT_FALSE(from_arguments({"d", "", "", "960", "640", "0", "blended", "10"}));
}

TEST(ViewState, ArrowsGoRoundTheSchemesAndDigitsTakeOne) {
  ViewState state;
  state.press(ViewKey::kPrevious, 3, 1);
  EXPECT_EQ(state.scheme, 2u);
  state.press(ViewKey::kNext, 3, 1);
  EXPECT_EQ(state.scheme, 0u);
  state.choose_scheme(1, 3);
  EXPECT_EQ(state.scheme, 1u);
  state.choose_scheme(3, 3);
  EXPECT_EQ(state.scheme, 1u);
  state.press(ViewKey::kNext, 0, 1);  // nothing attached yet
  EXPECT_EQ(state.scheme, 1u);
}

TEST(ViewState, HeatMapGoesOverAloneOff) {
  ViewState state;
  EXPECT_EQ(state.overlay, Overlay::kBlended);
  state.press(ViewKey::kHeat, 1, 1);
  EXPECT_EQ(state.overlay, Overlay::kHeatOnly);
  state.press(ViewKey::kHeat, 1, 1);
  EXPECT_EQ(state.overlay, Overlay::kOff);
  state.press(ViewKey::kHeat, 1, 1);
  EXPECT_EQ(state.overlay, Overlay::kBlended);
}

TEST(ViewState, EscapeClosesTheHelpFirst) {
  ViewState state;
  state.press(ViewKey::kHelp, 1, 1);
  state.press(ViewKey::kQuit, 1, 1);
  EXPECT_FALSE(state.help);
  EXPECT_FALSE(state.quit);
  state.press(ViewKey::kQuit, 1, 1);
  EXPECT_TRUE(state.quit);
}

TEST(ViewState, ZoomStepsFromWhatFits) {
  ViewState state;
  state.press(ViewKey::kLarger, 1, 0.3);  // the step above 0.3 is 0.5
  EXPECT_DOUBLE_EQ(state.zoom, 0.5);
  state.press(ViewKey::kSmaller, 1, 0.3);
  EXPECT_DOUBLE_EQ(state.zoom, 0.25);
  for (int i = 0; i < 50; ++i) state.press(ViewKey::kLarger, 1, 0.3);
  EXPECT_DOUBLE_EQ(state.zoom, 32);
  state.press(ViewKey::kFit, 1, 0.3);
  EXPECT_DOUBLE_EQ(state.zoom, 0);
}

TEST(ViewState, TheWheelKeepsThePointUnderThePointer) {
  const ViewRect area{10, 20, 400, 300};
  ViewState state;
  state.zoom = 2;
  const ViewRect before = picture_place(state, area, 100, 50);
  const double x = 150, y = 180;
  const double frame_x = (x - before.x) / 2, frame_y = (y - before.y) / 2;
  state.zoom_at(1, x, y, area, 2);
  const ViewRect after = picture_place(state, area, 100, 50);
  EXPECT_DOUBLE_EQ(state.zoom, 3);
  // Places are whole pixels: half a pixel of rounding at either zoom.
  EXPECT_NEAR((x - after.x) / 3, frame_x, 0.5);
  EXPECT_NEAR((y - after.y) / 3, frame_y, 0.5);
}

TEST(ViewLayout, FitsWholeTimesWhereThereIsRoom) {
  EXPECT_DOUBLE_EQ(fitting_zoom({0, 0, 640, 640}, 96, 64), 6);  // 640/96 = 6.67
  EXPECT_DOUBLE_EQ(fitting_zoom({0, 0, 640, 640}, 1280, 720), 0.5);
  const ViewRect place = picture_place({}, {0, 0, 640, 640}, 96, 64);
  EXPECT_DOUBLE_EQ(place.width, 576);
  EXPECT_DOUBLE_EQ(place.x, 32);   // (640 - 576) / 2
  EXPECT_DOUBLE_EQ(place.y, 128);  // (640 - 384) / 2
}

TEST(ViewLayout, ANarrowWindowHasThePanelBelow) {
  const ViewLayout wide = lay_out(960, 640, 320, 400), narrow = lay_out(390, 844, 320, 400);
  EXPECT_DOUBLE_EQ(wide.picture.width, 640);
  EXPECT_DOUBLE_EQ(wide.panel.x, 640);
  EXPECT_DOUBLE_EQ(narrow.picture.width, 390);
  EXPECT_DOUBLE_EQ(narrow.panel.y, 444);
  EXPECT_DOUBLE_EQ(narrow.panel.height, 400);
}

TEST(ViewPixels, EveryFormatWidensToEightBits) {
  LivePicture rgba = picture_of(PixelFormat::kRgba8, 2, 1);
  rgba.pixels[0] = 0x00'30'20'10;  // alpha 0 is shown opaque, as on a screen
  EXPECT_EQ(frame_image(rgba, 64).bytes, (std::vector<uint8_t>{0x10, 0x20, 0x30, 255, 0, 0, 0, 255}));
  LivePicture rgb565 = picture_of(PixelFormat::kRgb565, 1, 1);
  rgb565.pixels[0] = 31u << 11 | 32u << 5 | 1u;  // 31/31, 32/63, 1/31
  EXPECT_EQ(frame_image(rgb565, 64).bytes, (std::vector<uint8_t>{255, 130, 8, 255}));
  LivePicture rgb10a2 = picture_of(PixelFormat::kRgb10a2, 1, 1);
  rgb10a2.pixels[0] = 1023u | 512u << 10 | 4u << 20;  // 512 · 255 / 1023 = 127.6, 4 · 255 / 1023 = 1.0
  EXPECT_EQ(frame_image(rgb10a2, 64).bytes, (std::vector<uint8_t>{255, 128, 1, 255}));
}

TEST(ViewPixels, AFrameTooLargeForATextureIsThinned) {
  LivePicture picture = picture_of(PixelFormat::kRgba8, 130, 3);
  for (uint32_t x = 0; x < 130; ++x) picture.pixels[x] = x;
  const ScreenImage image = frame_image(picture, 64);  // 130 / 64 rounds up to every third pixel
  EXPECT_EQ(image.width, 44u);
  EXPECT_EQ(image.height, 1u);
  EXPECT_EQ(image.bytes[4 * 43], 129);
}

TEST(ViewPixels, HeatGoesByTheShareOfARawBlock) {
  LivePicture picture = picture_of(PixelFormat::kRgba8, 24, 8);
  picture.bits[0] = {0, 1024, 2048};
  const ScreenImage opaque = heat_image(picture, 0, true);
  ASSERT_EQ(opaque.bytes.size(), 12u);
  const double shares[] = {0, 0.5, 1};
  for (size_t i = 0; i < 3; ++i) {
    const auto color = heat_color(shares[i]);
    for (size_t c = 0; c < 3; ++c) EXPECT_EQ(opaque.bytes[4 * i + c], color[c]);
    EXPECT_EQ(opaque.bytes[4 * i + 3], 255);
  }
  const ScreenImage blended = heat_image(picture, 0, false);
  EXPECT_LT(blended.bytes[3], blended.bytes[7]);
  EXPECT_LT(blended.bytes[7], blended.bytes[11]);
  EXPECT_TRUE(heat_image(picture, 1, true).bytes.empty());
  const BlockSummary sum = summarize_blocks(picture, 0);
  EXPECT_EQ(sum.blocks, 3u);
  EXPECT_EQ(sum.raw_blocks, 1u);
  EXPECT_EQ(sum.most_bits, 2048u);
  EXPECT_DOUBLE_EQ(sum.mean_bits, 1024);
}

}  // namespace
}  // namespace tilepress
