// Fuzz target: any bytes as a packed file are read or refused in one line, and so are the pixels in it.
#include <cstdlib>
#include <sstream>

#include "frames/packed_reader.h"
#include "tilepress/surface_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace tilepress;
  std::istringstream in(std::string(reinterpret_cast<const char*>(bytes), size));
  PackedFileReader file;
  if (const auto opened = file.open(in); !opened) {
    const std::string& line = opened.error().text;
    if (line.empty() || line.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  CompressedSurface surface;
  for (uint32_t i = 0; i < file.count(); ++i) {
    if (!file.read(i, surface)) continue;
    SurfaceReader reader;
    std::vector<uint32_t> words;
    if (reader.open(surface, {})) (void)reader.read_rect({0, 0, surface.width, surface.height}, words);
    if (reader.traffic().payload_bursts > reader.traffic().raw_bursts) std::abort();
  }
  return 0;
}
