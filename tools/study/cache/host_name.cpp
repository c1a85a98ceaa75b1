// Host name: uname's node name.
#include "study/cache/host_name.h"

#include <sys/utsname.h>

namespace tilepress {

std::string host_name() {
  struct utsname names {};
  if (uname(&names) != 0 || names.nodename[0] == '\0') return "host";
  std::string name = names.nodename;
  for (char& c : name)
    if (c == '/') c = '_';
  return name;
}

}  // namespace tilepress
