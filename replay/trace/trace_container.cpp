// Trace container: recognises the file by its first bytes.
#include "trace_container.h"

#include <array>

namespace tilepress {

Result<std::unique_ptr<TraceContainer>> open_container(TraceInput& input) {
  std::array<uint8_t, 4> start{};
  const size_t length = input.read(start);
  input.rewind();
  if (length == 0) return Error{ErrorKind::kUnsupported, "is empty"};
  if (length >= 2 && start[0] == 'a' && start[1] == 't') return open_snappy_container(input);
  if (length >= 2 && start[0] == 0x1f && start[1] == 0x8b) return open_gzip_container(input);
  if (length == 4 && start[0] == 0x28 && start[1] == 0xb5 && start[2] == 0x2f && start[3] == 0xfd)
    return Error{ErrorKind::kUnsupported,
                 "is compressed with zstd, which Debian 12's retracer cannot read (apitrace repack --brotli "
                 "converts it)"};
  return open_brotli_container(input);  // which has no signature
}

}  // namespace tilepress
