// Own environment: the engine's getenv, which the engine does not export. Shells and sandboxes define a
// getenv of their own, which may not know the launcher's variables.
#include <unistd.h>

#include <cstddef>
#include <cstring>

extern "C" char* getenv(const char* name) noexcept {
  const size_t length = std::strlen(name);
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry)
    if (std::strncmp(*entry, name, length) == 0 && (*entry)[length] == '=') return *entry + length + 1;
  return nullptr;
}
