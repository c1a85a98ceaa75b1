// View panel: texts from the picture's own numbers, so that they match a frozen picture.
#include "live/view/view_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "live/heat_colors.h"

namespace tilepress {

constexpr CanvasColor kPanel{28, 30, 34}, kText{222, 224, 228}, kDim{150, 154, 162}, kMarked{255, 221, 87},
    kRow{58, 64, 76}, kEdge{70, 74, 82};

constexpr const char* kHelp[] = {"left right up down   scheme before, after",
                                 "1 ... 9              this scheme",
                                 "h                    heat map over the frame,",
                                 "                     alone, off",
                                 "space                freeze, go on",
                                 "+ - wheel            zoom",
                                 "drag                 move the picture",
                                 "f                    fit into the window",
                                 "Tab                  next running capture",
                                 "? F1                 this help",
                                 "q Esc                quit; the program goes on"};

static std::string cut(std::string text, size_t columns) {
  if (text.size() > columns) text = text.substr(0, columns - 1) + '\xBB';  // », the text is cut
  return text;
}

std::optional<PointedBlock> block_under(const LivePicture& picture, const ViewRect& place, double x,
                                        double y) {
  if (picture.head.number == 0 || !place.contains(x, y)) return std::nullopt;
  PointedBlock out;
  const auto at = [](double offset, double length, uint64_t pixels) {
    return std::min(static_cast<uint64_t>(offset / length * static_cast<double>(pixels)), pixels - 1);
  };
  out.pixel_x = at(x - place.x, place.width, picture.head.width);
  out.pixel_y = at(y - place.y, place.height, picture.head.height);
  out.x = out.pixel_x / 8;
  out.y = out.pixel_y / 8;
  return out;
}

std::vector<std::string> capture_texts(const CaptureWatch& watch, const ViewState& state) {
  if (!watch.attached()) return {"waiting for a capture in", watch.folder(), watch.error()};
  const WatchedCapture& capture = watch.capture();
  const LiveState& now = watch.has_picture() ? watch.picture().head.state : capture.now;
  const double speed = frames_per_second(capture);
  std::vector<std::string> out;
  out.push_back(fmt::format("{} ({})", printable_name(capture.now.program), capture.now.pid));
  std::string mark = capture.ended ? "  ended" : state.frozen ? "  frozen" : "";
  const auto format =
      watch.has_picture() ? traits(static_cast<PixelFormat>(watch.picture().head.format)).name : "";
  out.push_back(fmt::format("{}x{} {}  surface {}", now.width, now.height, format, now.surface));
  std::string frame = fmt::format("frame {}", now.frame);
  if (!mark.empty())
    frame.append(mark);
  else if (!std::isnan(speed))
    frame.append(fmt::format("  {:.1f} frames/s", speed));
  out.push_back(std::move(frame));
  out.push_back(
      fmt::format("FVC coverage {:.1f} %  change {:.1f} %", now.fvc_coverage * 100, now.pixel_change * 100));
  out.push_back(fmt::format("readback {:.2f} ms  compress {:.2f} ms",
                            static_cast<double>(now.readback_ns) * 1e-6,
                            static_cast<double>(now.encode_ns) * 1e-6));
  out.push_back(fmt::format("queue {}/{}  dropped {}", now.queued, now.queue_depth, now.dropped));
  if (const int error = watch.picture_error(); error != 0)
    out.push_back(fmt::format("no pictures: {}", std::strerror(error)));
  else if (!watch.has_picture())
    out.push_back(capture.ended ? "ended before a frame came" : "waiting for its next frame");
  else if (watch.count() > 1)
    out.push_back(fmt::format("capture {} of {} (Tab: next)", watch.index() + 1, watch.count()));
  else
    out.push_back("");
  return out;
}

std::vector<std::string> rate_texts(const LiveState& state) {
  bool extra = false;
  size_t width = 8;
  for (size_t i = 0; i < state.scheme_count; ++i) {
    extra |= state.schemes[i].extra_bits > 0 || state.schemes[i].frame_extra_bits > 0;
    width = std::max(width, printable_name(state.schemes[i].name).size());
  }
  // The digit, spaces and the columns of rates need the rest.
  width = std::min(width, kPanelColumns - 4 - 16 - (extra ? 8 : 0));
  std::vector<std::string> out = {
      fmt::format("  {:<{}} {:>7} {:>7}{}", "rate of", width, "run", "frame", extra ? "  +extra" : "")};
  for (size_t i = 0; i < state.scheme_count; ++i) {
    const LiveScheme& scheme = state.schemes[i];
    std::string line = fmt::format("{} {:<{}} {} {}", i < 9 ? fmt::format("{}", i + 1) : " ",
                                   cut(printable_name(scheme.name), width), width,
                                   rate_text(scheme.raw_bits, scheme.moved_bits, 7),
                                   rate_text(scheme.frame_raw_bits, scheme.frame_moved_bits, 7));
    if (extra)
      line.append(" ").append(
          rate_text(scheme.frame_raw_bits, scheme.frame_moved_bits + scheme.frame_extra_bits, 7));
    out.push_back(std::move(line));
  }
  return out;
}

std::vector<std::string> block_texts(const LivePicture& picture, size_t scheme,
                                     const std::optional<PointedBlock>& pointed) {
  const BlockSummary sum = summarize_blocks(picture, scheme);
  if (sum.blocks == 0) return {"", "", "", "", ""};
  std::vector<std::string> out = {
      fmt::format("mean {:.0f}, most {}", sum.mean_bits, sum.most_bits),
      fmt::format("raw {} of {} blocks, {:.1f} %", sum.raw_blocks, sum.blocks,
                  100.0 * static_cast<double>(sum.raw_blocks) / static_cast<double>(sum.blocks))};
  if (!pointed) {
    out.insert(out.end(), {"", "point at a block for its bits", ""});
    return out;
  }
  const LivePictureHead& head = picture.head;
  const uint32_t bits = picture.bits[scheme][pointed->y * head.blocks_x + pointed->x];
  const FormatTraits& format = traits(static_cast<PixelFormat>(head.format));
  const uint32_t word = picture.pixels[pointed->pixel_y * head.blocks_x * 8 + pointed->pixel_x];
  out.push_back("");
  out.push_back(fmt::format("block {},{}: {} bits, {} bursts", pointed->x, pointed->y, bits,
                            (bits + head.burst_bits - 1) / head.burst_bits));
  std::string color;
  for (int c = 0; c < 4; ++c)
    if (format.channel_bits[static_cast<size_t>(c)] > 0)
      color += fmt::format(" {}", channel(format, word, c));
  out.push_back(fmt::format("pixel {},{}:{}", pointed->pixel_x, pointed->pixel_y, color));
  return out;
}

size_t panel_lines(const CaptureWatch& watch) {
  // Seven for the capture, the table, four for the scale, five for the blocks, the hint, and empty lines.
  return 7 + 1 + std::max<size_t>(1, watch.capture().now.scheme_count) + 4 + 5 + 1 + 3;
}

void draw_panel(WindowCanvas& canvas, const ViewRect& place, const CaptureWatch& watch,
                const ViewState& state, const std::optional<PointedBlock>& pointed) {
  canvas.clip(place);
  canvas.fill(place, kPanel);
  canvas.fill({place.x, place.y, 1, place.height}, kEdge);
  canvas.fill({place.x, place.y, place.width, 1}, kEdge);
  const double line = canvas.line_height(), margin = canvas.character_width();
  const double x = place.x + margin, width = place.width - 2 * margin;
  const size_t columns = static_cast<size_t>(std::max(8.0, width / canvas.character_width()));
  double y = place.y + std::floor(line / 2);
  bool first = true;
  for (const std::string& text : capture_texts(watch, state)) {
    canvas.text(x, y, cut(text, columns), first ? kMarked : kText);
    first = false;
    y += line;
  }
  if (watch.attached()) {
    const LiveState& rates = watch.has_picture() ? watch.picture().head.state : watch.capture().now;
    y += std::floor(line / 2);
    const std::vector<std::string> texts = rate_texts(rates);
    for (size_t i = 0; i < texts.size(); ++i) {
      const bool marked = i == state.scheme + 1;
      if (marked) canvas.fill({place.x + 1, y, place.width - 1, line}, kRow);
      canvas.text(x, y, cut(texts[i], columns), i == 0 ? kDim : marked ? kMarked : kText);
      y += line;
    }
  }
  if (watch.has_picture()) {
    const LivePicture& picture = watch.picture();
    y += std::floor(line / 2);
    std::string title = "bits of blocks";
    if (state.scheme < picture.head.scheme_count)
      title.append(", ").append(printable_name(picture.head.state.schemes[state.scheme].name));
    canvas.text(x, y, cut(title, columns), kDim);
    y += line;
    const double step = 1;
    for (double at = 0; at < width; at += step) {
      const auto color = heat_color(at / width);
      canvas.fill({x + at, y, step, line}, {color[0], color[1], color[2]});
    }
    y += line;
    const std::string most = fmt::format("{} raw", picture.head.raw_bits);
    canvas.text(x, y, "0", kDim);
    canvas.text(x + width - static_cast<double>(most.size()) * canvas.character_width(), y, most, kDim);
    const std::string half = fmt::format("{}", picture.head.raw_bits / 2);
    canvas.text(x + std::floor((width - static_cast<double>(half.size()) * canvas.character_width()) / 2), y,
                half, kDim);
    y += line;
    for (const std::string& text : block_texts(picture, state.scheme, pointed)) {
      canvas.text(x, y, cut(text, columns), kText);
      y += line;
    }
  }
  const double bottom = place.y + place.height - std::floor(line * 1.3);
  if (bottom >= y) canvas.text(x, bottom, cut("? keys   q quit; the program goes on", columns), kDim);
  canvas.no_clip();
}

void draw_help(WindowCanvas& canvas, const ViewRect& window) {
  size_t columns = 0;
  for (const char* text : kHelp) columns = std::max(columns, std::string_view(text).size());
  const double line = canvas.line_height(), margin = line;
  ViewRect box;
  box.width = std::min(window.width, static_cast<double>(columns) * canvas.character_width() + 2 * margin);
  box.height = static_cast<double>(std::size(kHelp)) * line + 2 * margin;
  box.x = std::floor((window.width - box.width) / 2);
  box.y = std::max(0.0, std::floor((window.height - box.height) / 2));
  canvas.fill({box.x - 1, box.y - 1, box.width + 2, box.height + 2}, kEdge);
  canvas.fill(box, kPanel);
  double y = box.y + margin;
  const size_t room = static_cast<size_t>((box.width - 2 * margin) / canvas.character_width());
  for (const char* text : kHelp) {
    canvas.text(box.x + margin, y, cut(text, room), kText);
    y += line;
  }
}

}  // namespace tilepress
