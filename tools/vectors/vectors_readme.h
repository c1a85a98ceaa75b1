// Vectors' README: describes the files that `tilepress vectors` writes.
#pragma once

#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"
#include "vectors/frame_parameters.h"

namespace tilepress {

/// The text of README.md for the frames written, at least one. `surface` is one of them: its scheme, size and
/// format count.
std::string vectors_readme(const std::vector<VectorFrame>& frames, const CompressedSurface& surface);

/// "frame-000003", the folder of an input frame.
std::string vector_folder(uint64_t frame);

}  // namespace tilepress
