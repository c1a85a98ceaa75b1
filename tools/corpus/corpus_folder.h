// Corpus folder: where the recipes and the program that records them lie.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// The folder share/tilepress/corpus beside the folder of this executable, in an installed tree and in a build tree.
/// Error: kFile.
Result<std::string> find_corpus_folder();

}  // namespace tilepress
