// Image folders: a folder named in place of its images.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Replaces each folder in `paths` by the images, movies and raw files in it. Numbers in names count as numbers: 2.png
/// comes before 10.png. Leaves out hidden files, other files and inner folders. Fails with kFile for a folder that
/// holds no frame. `is_raw` decides whether a file is a raw frame.
Result<std::vector<std::string>> expand_image_folders(const std::vector<std::string>& paths,
                                                      const std::function<bool(const std::string&)>& is_raw);

/// The regular files of a folder that `wanted` accepts, without hidden ones, in the order above. Error:
/// kFile.
Result<std::vector<std::string>> files_in_order(const std::string& folder,
                                                const std::function<bool(const std::string&)>& wanted);

/// Movies have no signature: in a folder their names decide.
bool has_movie_ending(const std::string& path);

}  // namespace tilepress
