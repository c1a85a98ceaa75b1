// Image library: the module lies beside the shim.
#include "images/image_library.h"

#include <dlfcn.h>

#include "capture/shim_path.h"

namespace tilepress {

static Result<const ImageLibrary*> load() {
  const auto path = find_shim("libtilepress-images.so");
  if (!path) return path.error();
  void* module = dlopen(path->c_str(), RTLD_LAZY | RTLD_LOCAL);
  using Function = const ImageLibrary* (*)();
  const auto function =
      module == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(module, "tilepress_image_library"));
  if (function == nullptr) return Error{ErrorKind::kSystem, dlerror()};
  return function();
}

Result<const ImageLibrary*> image_library() {
  static const Result<const ImageLibrary*> loaded = load();
  return loaded;
}

}  // namespace tilepress
