// Plugin library: dlopen, then the tables that the library's one function returns.
#include "tilepress/plugin_library.h"

#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "tilepress/plugin_scheme.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

constexpr uint32_t kMostSchemesOfPlugin = 64;

/// Never destroyed: threads of the shim outlive static objects.
std::deque<PluginLibrary>& libraries() {
  static auto& loaded = *new std::deque<PluginLibrary>;
  return loaded;
}

/// Held while a library is loaded. A forked child does not wait for a thread of its parent.
class LoadingLock {
 public:
  LoadingLock() {
    const pid_t own = getpid();
    for (pid_t seen = 0; !holder_.compare_exchange_strong(seen, own); seen = seen == own ? 0 : seen)
      if (seen == own) sched_yield();
  }
  ~LoadingLock() { holder_ = 0; }

 private:
  static inline std::atomic<pid_t> holder_{0};
};

/// FNV-1a of 64 bits, as hexadecimal digits.
std::string digest_of(std::string_view bytes) {
  uint64_t hash = 0xCBF29CE484222325u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3u;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 0xF];
  return digits;
}

Error no_plugin(std::string reason) {
  return {ErrorKind::kFile, std::move(reason)};
}

/// What dlopen() says, without the path in front.
std::string loader_text(const std::string& path) {
  const char* text = dlerror();
  std::string reason = text != nullptr ? text : "cannot be loaded";
  if (reason.starts_with(path + ": ")) reason.erase(0, path.size() + 2);
  return reason;
}

Result<void> register_schemes(void* library, PluginLibrary& out) {
  const auto scheme_of = reinterpret_cast<const tp_scheme* (*)(uint32_t)>(dlsym(library, "tilepress_scheme"));
  if (scheme_of == nullptr)
    return no_plugin("is no plugin: it has no function tilepress_scheme() (see tilepress_plugin.h)");
  for (uint32_t index = 0; const tp_scheme* table = scheme_of(index); ++index) {
    if (index == kMostSchemesOfPlugin)
      return no_plugin("has more than " + std::to_string(kMostSchemesOfPlugin) + " schemes");
    if (auto registered = register_plugin_scheme(*table); !registered) return registered;
    out.schemes.emplace_back(table->name);
  }
  return out.schemes.empty() ? no_plugin("has no scheme") : Result<void>();
}

}  // namespace

Result<void> load_plugin(const std::string& path) {
  const LoadingLock lock;
  std::error_code code;
  PluginLibrary library;
  library.path = std::filesystem::absolute(path, code).lexically_normal().string();
  for (const PluginLibrary& known : libraries())
    if (known.path == library.path) return {};
  const auto bytes = read_whole_file(library.path);
  if (!bytes) {
    std::string reason = bytes.error().text;
    if (reason.starts_with(library.path + ": ")) reason.erase(0, library.path.size() + 2);
    return no_plugin(reason);
  }
  library.digest = digest_of(*bytes);
  // The library stays even if it is refused: a thread that it has started may run.
  void* opened = dlopen(library.path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (opened == nullptr) return no_plugin(loader_text(library.path));
  if (auto registered = register_schemes(opened, library); !registered) return registered;
  libraries().push_back(std::move(library));
  return {};
}

const std::deque<PluginLibrary>& loaded_plugins() {
  return libraries();
}

}  // namespace tilepress
