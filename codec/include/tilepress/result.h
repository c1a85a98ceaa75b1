// Result: a value, or an error with its kind and one line of text.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace tilepress {

enum class ErrorKind : uint8_t {
  kBadValue,  ///< an option or a specification that the caller wrote
  kFile,      ///< a file that is missing or cannot be read
  kBadBits,   ///< bits that no encoder writes
};

struct Error {
  ErrorKind kind;
  std::string text;  ///< one line without a newline
};

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
