// Plugin scheme: registers a scheme that is a C table of functions (tilepress_plugin.h).
#pragma once

#include <stdexcept>

#include "tilepress/result.h"
#include "tilepress_plugin.h"

namespace tilepress {

/// What encoders and decoders of a plugin throw when the plugin breaks its contract: one line with the
/// scheme's name.
class PluginFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs `work`, which returns a Result, and returns a plugin's fault as an error.
template <class Work>
auto catch_plugin_fault(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const PluginFault& fault) {
    return Error{ErrorKind::kSystem, fault.what()};
  }
}

/// Registers the scheme as register_scheme() does. `table`, and everything it points to, must live until the
/// program ends. Checks the table, and compares measure() with encode() on a small picture. Error: the scheme
/// and the reason; the scheme is not registered then.
Result<void> register_plugin_scheme(const tp_scheme& table);

}  // namespace tilepress
