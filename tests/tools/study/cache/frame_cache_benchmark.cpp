// Frame cache benchmark, run by hand: speed and size of cache files beside LZ4 and zstd of the same frames.
//
//   frame_cache_benchmark FILE.frames…     files of a cache folder
//   frame_cache_benchmark                  made frames, a few: shows that the program works
//
// Times are those of the thread, without waiting, the best of some rounds. Reading includes the file (from
// the page cache) and its checksums. LZ4 decodes blocks that lie in memory, a frame each, without checksums.
#include <lz4.h>
#include <zstd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "made_frames.h"
#include "study/cache/frame_cache.h"

namespace tilepress {
namespace {

constexpr int kRounds = 7;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

template <class Work>
void time_once(double& best, const Work& work) {
  const double begin = thread_seconds();
  work();
  best = std::min(best, thread_seconds() - begin);
}

struct PackedFrame {
  std::string lz4;
  size_t bytes = 0;
};

/// Returns false if the file cannot be read.
bool measure(const std::string& path) {
  FrameCacheReader reader;
  if (const auto opened = reader.open(path); !opened) {
    std::fprintf(stderr, "%s\n", opened.error().text.c_str());
    return false;
  }
  std::vector<PackedFrame> packed;
  std::vector<std::byte> pixels;
  std::string room;
  size_t lz4_bytes = 0, zstd_bytes = 0, largest = 0;
  for (uint64_t i = 0; i < reader.frame_count(); ++i) {
    if (const auto read = reader.read(i, pixels); !read) {
      std::fprintf(stderr, "%s\n", read.error().text.c_str());
      return false;
    }
    const int size = static_cast<int>(pixels.size());
    const char* bytes = reinterpret_cast<const char*>(pixels.data());
    room.resize(std::max(ZSTD_compressBound(pixels.size()), static_cast<size_t>(LZ4_compressBound(size))));
    const int lz4 = LZ4_compress_default(bytes, room.data(), size, static_cast<int>(room.size()));
    packed.push_back({room.substr(0, static_cast<size_t>(lz4)), pixels.size()});
    lz4_bytes += static_cast<size_t>(lz4);
    zstd_bytes += ZSTD_compress(room.data(), room.size(), bytes, pixels.size(), 3);
    largest = std::max(largest, pixels.size());
  }
  std::string out(largest, '\0');
  double lz4_s = 1e9, read_s = 1e9;
  bool good = true;
  for (int round = 0; round < kRounds; ++round) {
    time_once(lz4_s, [&] {
      for (const PackedFrame& frame : packed)
        good &= LZ4_decompress_safe(frame.lz4.data(), out.data(), static_cast<int>(frame.lz4.size()),
                                    static_cast<int>(frame.bytes)) == static_cast<int>(frame.bytes);
    });
    FrameCacheReader fresh = reader.another();
    good &= static_cast<bool>(fresh.view(0));  // allocates
    time_once(read_s, [&] {
      for (uint64_t i = 0; i < fresh.frame_count(); ++i) good &= static_cast<bool>(fresh.view(i));
    });
  }
  const double raw = static_cast<double>(reader.raw_bytes()),
               file = static_cast<double>(std::filesystem::file_size(path));
  const std::string name = reader.origin().input.empty() ? path : reader.origin().input;
  std::printf("%s\n  %zu frames, raw %.1f MB, LZ4 %.1f MB, zstd -3 %.1f MB, cache %.1f MB: %.3f of zstd -3\n",
              name.c_str(), static_cast<size_t>(reader.frame_count()), raw / 1e6,
              static_cast<double>(lz4_bytes) / 1e6, static_cast<double>(zstd_bytes) / 1e6, file / 1e6,
              file / static_cast<double>(zstd_bytes));
  std::printf("  LZ4 %.0f MB/s, reading %.0f MB/s: %.2f of LZ4\n", raw / lz4_s / 1e6, raw / read_s / 1e6,
              lz4_s / read_s);
  return good;
}

bool measure_made_frames() {
  const TestFolder folder;
  bool good = true;
  for (const auto& [content, name] :
       {std::pair(Content::kMoving, "moving"), std::pair(Content::kGradient, "gradient")}) {
    write_cache(folder.file(name), make_frames(content, 0, 4, 128, 64));
    good &= measure(folder.file(name));
  }
  return good;
}

}  // namespace
}  // namespace tilepress

int main(int argc, char** argv) {
  bool good = argc > 1 || tilepress::measure_made_frames();
  for (int i = 1; i < argc; ++i) good &= tilepress::measure(argv[i]);
  return good ? 0 : 1;
}
