// Draw figures: hands the figures' files to the drawing script.
#include "study/figures/study_outputs.h"

namespace tilepress {

Result<std::vector<std::string>> write_study_outputs(const std::string& study_folder) {
  return write_study_data(study_folder);
}

}  // namespace tilepress
