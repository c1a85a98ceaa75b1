// Image library: the module lies beside the shim.
#include "images/image_library.h"

#include <dlfcn.h>

#include "capture/shim_path.h"
#include "images/image_kind.h"
#include "images/png_image.h"

namespace tilepress {
namespace {

Result<const ImageLibrary*> load() {
  const auto path = find_shim("libtilepress-images.so");
  if (!path) return path.error();
  void* module = dlopen(path->c_str(), RTLD_LAZY | RTLD_LOCAL);
  using Function = const ImageLibrary* (*)();
  const auto function =
      module == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(module, "tilepress_image_library"));
  if (function == nullptr) return Error{ErrorKind::kSystem, dlerror()};
  return function();
}

}  // namespace

Result<const ImageLibrary*> image_library() {
  static const Result<const ImageLibrary*> loaded = load();
  return loaded;
}

OpenedImage open_image(const std::string& path) {
  if (image_kind_of_file(path.c_str()).reader == ImageReader::kPng) {
    OpenedImage png = open_png(path);
    if (!png || *png != nullptr) return png;
  }
  const auto library = image_library();
  if (!library) return library.error();
  return (*library)->open(path);
}

}  // namespace tilepress
