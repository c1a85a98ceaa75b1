// Write outputs: writes the outputs of the study folders named on the command line, without drawings.
#include <cstdio>

#include "study/figures/study_outputs.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const auto lines = tilepress::write_study_data(argv[i]);
    if (!lines) {
      std::fprintf(stderr, "%s\n", lines.error().text.c_str());
      return 1;
    }
    for (const std::string& line : *lines) std::printf("%s\n", line.c_str());
  }
  return 0;
}
