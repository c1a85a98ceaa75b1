// Frame dump: through the same canonical plane that the schemes see.
#include "interposer/engine/worker/frame_dump.h"

#include <sys/stat.h>

#include <cstdlib>
#include <string>

#include "tilepress/frame_pictures.h"

namespace tilepress {

void dump_frame(const CapturedFrame& frame, const ShimLog& log) {
  const char* folder = getenv("TILEPRESS_DUMP");
  if (folder == nullptr || *folder == 0) return;
  mkdir(folder, 0777);
  const std::string path =
      std::string(folder) + "/" + std::to_string(frame.surface) + "-" + std::to_string(frame.frame) + ".rgba";
  if (const auto written = write_raw_frame(path, frame.view); !written)
    log.write(LogLevel::kError, written.error().text);
}

}  // namespace tilepress
