// C calls: what the functions of tilepress.h share: errors, structures that grow, formats and options.
#pragma once

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "tilepress.h"
#include "tilepress/model_options.h"
#include "tilepress/plugin_scheme.h"
#include "tilepress/result.h"
#include "tilepress/surface.h"

namespace tilepress {

/// Notes the error of this thread and returns its status.
tp_status c_failure(tp_status status, std::string text) noexcept;

/// Runs `call`, which returns a tp_status. No exception passes.
template <class Call>
tp_status c_call(const Call& call) noexcept {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return c_failure(TP_NO_MEMORY, {});
  } catch (const std::exception& error) {
    return c_failure(TP_FAILED, error.what());
  } catch (...) {
    return c_failure(TP_FAILED, "an exception of a plugin");
  }
}

/// Copies the members that the caller's structure has, and zeros those that this version does not know.
/// `value.struct_bytes` keeps the caller's size. Returns TP_BAD_ARGUMENT for a size that cannot be.
template <class Struct>
tp_status c_fill(Struct* out, Struct value, const char* name) {
  if (out == nullptr) return c_failure(TP_BAD_ARGUMENT, std::string(name) + " is NULL");
  const uint32_t bytes = out->struct_bytes;
  if (bytes < 2 * sizeof(uint32_t) || bytes > 16 * sizeof(Struct))
    return c_failure(TP_BAD_ARGUMENT, std::string(name) + ": struct_bytes is " + std::to_string(bytes) +
                                          ", set it to sizeof of the structure");
  value.struct_bytes = bytes;
  std::memset(out, 0, bytes);
  std::memcpy(out, &value, std::min<size_t>(bytes, sizeof value));
  return TP_OK;
}

struct CFormat {
  PixelFormat format = PixelFormat::kRgba8;
  ByteOrder order = ByteOrder::kRgba;
};
/// Error: not one of TP_RGBA8, ….
Result<CFormat> c_format(uint32_t format);

struct COptions {
  ModelOptions model;
  bool keeps_blocks = false;
};
/// Null stands for the defaults. Error: a value out of its range.
Result<COptions> c_options(const tp_options* options);

}  // namespace tilepress
