// Open image: libpng reads PNG files; the module reads the others.
#include "images/image_kind.h"
#include "images/image_library.h"
#include "images/image_readers.h"

namespace tilepress {

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
