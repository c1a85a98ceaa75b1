// GL trigger: recognises a frame's end, and the same end met twice.
#include "interposer/engine/gl_trigger.h"

#include <algorithm>
#include <cstring>

namespace tilepress {
namespace {

constexpr uint32_t kNoKind = TILEPRESS_GL_KINDS;

uint64_t pixel_hash(const CapturedFrame& frame) {
  const SurfaceView& view = frame.view;
  const size_t row_bytes = size_t{view.width} * traits(view.format).pixel_bits / 8;
  uint64_t hash = 0x9E3779B97F4A7C15u;
  for (uint32_t y = 0; y < view.height; ++y) {
    const std::byte* row = view.top_row + static_cast<ptrdiff_t>(y) * view.pitch_bytes;
    for (size_t at = 0; at < row_bytes; at += 8) {
      uint64_t word = 0;
      memcpy(&word, row + at, std::min<size_t>(8, row_bytes - at));
      hash = (hash ^ word) * 0xFF51AFD7ED558CCDu;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

}  // namespace

bool is_trigger(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH || kind == TILEPRESS_GL_FLUSH || kind == TILEPRESS_GL_READ_PIXELS;
}

const char* cause_of(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH ? "finish" : kind == TILEPRESS_GL_FLUSH ? "flush" : "readpixels";
}

FramebufferUse use_of(uint32_t kind) {
  return kind == TILEPRESS_GL_READ_PIXELS ? FramebufferUse::kRead : FramebufferUse::kDraw;
}

bool comes_again(const TilepressGlCall& call) {
  thread_local uint32_t awaited = kNoKind;
  if (call.osmesa != nullptr) return false;
  const bool glvnd = call.road == TILEPRESS_ROAD_GLVND;
  const bool again = glvnd && awaited == call.kind;
  awaited = glvnd ? kNoKind : call.kind;
  return again;
}

bool is_second_of_pair(uint32_t kind, const CapturedFrame& frame) {
  thread_local struct {
    uint32_t kind = kNoKind;
    uint64_t hash = 0;
  } last;
  const uint64_t hash = pixel_hash(frame);
  const bool second = last.kind != kNoKind && last.kind != kind && last.hash == hash;
  last.kind = second ? kNoKind : kind;
  last.hash = hash;
  return second;
}

}  // namespace tilepress
