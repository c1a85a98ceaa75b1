// Result: a value, or an error with its kind and one line of text.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tilepress {

enum class ErrorKind : uint8_t {
  kBadValue,     ///< an option or a specification that the caller wrote
  kFile,         ///< a file that is missing, or that cannot be read or written
  kBadBits,      ///< bits that no encoder writes
  kExists,       ///< the output is there already
  kUnsupported,  ///< valid input that tilepress does not handle
  kSystem,       ///< a system call or a library that failed
};

struct Error {
  ErrorKind kind;
  std::string text;  ///< one line without a newline
};

/// Returns `error` with "subject: " before its text.
inline Error about(std::string_view subject, Error error) {
  error.text.insert(0, std::string(subject) + ": ");
  return error;
}

/// Converts from a value or an Error, so that functions return either.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  bool has_value() const { return value_.has_value(); }
  explicit operator bool() const { return has_value(); }
  const T& operator*() const { return *value_; }
  T& operator*() { return *value_; }
  const T* operator->() const { return &*value_; }
  T* operator->() { return &*value_; }
  /// Precondition: no value.
  const Error& error() const {
    assert(!has_value());
    return error_;
  }

 private:
  std::optional<T> value_;
  Error error_{};
};

/// Success, or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_; }
  /// Precondition: no success.
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace tilepress
