// View request: eight arguments in a fixed order, because both programs are of one build.
#include "live/view/view_request.h"

#include <charconv>

namespace tilepress {
namespace {

constexpr const char* kOverlayNames[] = {"blend", "only", "off"};

bool parse_number(const std::string& text, uint32_t& out) {
  const char* end = text.data() + text.size();
  const auto [next, status] = std::from_chars(text.data(), end, out);
  return status == std::errc() && next == end;
}

std::optional<Overlay> parse_overlay(const std::string& word) {
  for (int i = 0; i < 3; ++i)
    if (word == kOverlayNames[i]) return static_cast<Overlay>(i);
  return std::nullopt;
}

}  // namespace

std::vector<std::string> to_arguments(const ViewRequest& request) {
  return {request.folder,
          request.scheme,
          request.screenshot,
          std::to_string(request.width),
          std::to_string(request.height),
          std::to_string(request.zoom),
          kOverlayNames[static_cast<int>(request.overlay)],
          std::to_string(request.wait_s)};
}

std::optional<ViewRequest> from_arguments(const std::vector<std::string>& arguments) {
  if (arguments.size() != 8) return std::nullopt;
  ViewRequest out;
  out.folder = arguments[0];
  out.scheme = arguments[1];
  out.screenshot = arguments[2];
  const auto overlay = parse_overlay(arguments[6]);
  if (!overlay || !parse_number(arguments[3], out.width) || !parse_number(arguments[4], out.height) ||
      !parse_number(arguments[5], out.zoom) || !parse_number(arguments[7], out.wait_s))
    return std::nullopt;
  out.overlay = *overlay;
  return out;
}

}  // namespace tilepress
