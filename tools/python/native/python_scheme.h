// Python scheme: a scheme whose blocks a Python class measures, encodes and decodes.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "python_values.h"
#include "tilepress/scheme.h"

namespace tilepress::python {

/// What a SchemeInfo of a Python class points to. Kept until the program ends.
struct PythonSchemeText {
  std::deque<std::string> strings;
  std::vector<SchemeKey> keys;
  const char* keep(std::string text) { return strings.emplace_back(std::move(text)).c_str(); }
};

/// The factories of every Python scheme: they find the class by the name in the specification.
std::unique_ptr<BlockEncoder> make_python_encoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model);
std::unique_ptr<BlockDecoder> make_python_decoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model);

/// Engines made from now on use `type` for the scheme `name`.
void set_python_class(const std::string& name, const py::object& type);
/// Returns the class, or None.
py::object python_class(const std::string& name);

}  // namespace tilepress::python
