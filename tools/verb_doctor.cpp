// tilepress doctor: tells what this machine offers and lacks.
#include "command_line.h"
#include "verb.h"

namespace tilepress {

int verb_doctor(int argc, char** argv) {
  CLI::App app("Tells what this machine offers for capture and replay, and what is missing.");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  return kExitDone;
}

}  // namespace tilepress
