// Frame dump: through the same canonical plane that the schemes see.
#include "interposer/engine/frame_dump.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tilepress/plane.h"

namespace tilepress {
namespace {

bool write_all(int file, const std::vector<char>& bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written <= 0) return false;
    done += static_cast<size_t>(written);
  }
  return true;
}

}  // namespace

void dump_frame(const CapturedFrame& frame, const ShimLog& log) {
  const char* folder = getenv("TILEPRESS_DUMP");
  if (folder == nullptr || *folder == 0) return;
  PixelPlane plane;
  plane.assign(frame.view);
  const size_t pixel_bytes = traits(frame.view.format).pixel_bits / 8;
  std::vector<char> bytes(size_t{plane.width()} * plane.height() * pixel_bytes);
  char* out = bytes.data();
  for (uint32_t y = 0; y < plane.height(); ++y)
    for (uint32_t x = 0; x < plane.width(); ++x, out += pixel_bytes)
      memcpy(out, plane.row(y) + x, pixel_bytes);
  mkdir(folder, 0777);
  const std::string path =
      std::string(folder) + "/" + std::to_string(frame.surface) + "-" + std::to_string(frame.frame) + ".rgba";
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0 || !write_all(file, bytes)) log.write(LogLevel::kError, path + ": cannot be written");
  if (file >= 0) close(file);
}

}  // namespace tilepress
