// Image library: found as the shim is found, relative to the command.
#include "images/image_library.h"

#include <dlfcn.h>

#include "capture/shim_path.h"

namespace tilepress {
namespace {

struct Loaded {
  const ImageLibrary* library = nullptr;
  std::string error;
};

Loaded load() {
  Loaded out;
  const auto path = find_shim("libtilepress-images.so");
  if (!path) {
    out.error = path.error().text;
    return out;
  }
  void* module = dlopen(path->c_str(), RTLD_LAZY | RTLD_LOCAL);
  using Function = const ImageLibrary* (*)();
  const auto function =
      module == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(module, "tilepress_image_library"));
  if (function == nullptr)
    out.error = dlerror();
  else
    out.library = function();
  return out;
}

}  // namespace

const ImageLibrary* image_library(std::string& error) {
  static const Loaded loaded = load();
  if (loaded.library == nullptr) error = loaded.error;
  return loaded.library;
}

}  // namespace tilepress
