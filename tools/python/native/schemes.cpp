// Schemes: the registry for Python, and what a scheme in Python writes with.
#include <pybind11/stl.h>

#include <filesystem>

#include "bit_string.h"
#include "python_scheme.h"
#include "tilepress/plugin_library.h"

namespace tilepress::python {
namespace {

constexpr std::pair<const char*, KeyKind> kKeyKinds[] = {{"number", KeyKind::kNumber},
                                                         {"power_of_two", KeyKind::kPowerOfTwo},
                                                         {"share", KeyKind::kShare},
                                                         {"choice", KeyKind::kChoice},
                                                         {"file", KeyKind::kFile}};

const char* name_of_kind(KeyKind kind) {
  for (const auto& [name, each] : kKeyKinds)
    if (each == kind) return name;
  return "";
}

py::list registry() {
  py::list schemes;
  for (const SchemeInfo& info : scheme_registry()) {
    py::list keys;
    for (const SchemeKey& key : info.keys)
      keys.append(
          py::make_tuple(key.name, name_of_kind(key.kind), key.summary, key.values(), key.default_value()));
    schemes.append(py::make_tuple(info.name, info.label, info.family, tilepress::name_of(info.group),
                                  info.summary, info.source, info.eight_bit_only, keys));
  }
  return schemes;
}

SchemeKey key_of(const py::handle& given, PythonSchemeText& text) {
  const auto kind = given.attr("kind").cast<std::string>();
  SchemeKey key{.name = text.keep(given.attr("name").cast<std::string>()),
                .summary = text.keep(given.attr("summary").cast<std::string>())};
  bool known = false;
  for (const auto& [name, each] : kKeyKinds)
    if (kind == name && each != KeyKind::kFile) {
      key.kind = each;
      known = true;
    }
  if (!known)
    throw LibraryError({ErrorKind::kBadValue, std::string("key '") + key.name + "': kind '" + kind +
                                                  "' is not number, power_of_two, share or choice"});
  key.choices = text.keep(py::str(", ").attr("join")(given.attr("choices")).cast<std::string>());
  key.low = given.attr("low").cast<uint32_t>();
  key.high = given.attr("high").cast<uint32_t>();
  key.initial = given.attr("initial").cast<uint32_t>();
  return key;
}

/// Registers the class, or replaces the one of that name.
void register_class(const std::string& name, const py::object& type) {
  if (!python_class(name).is_none()) return set_python_class(name, type);
  auto text = std::make_unique<PythonSchemeText>();
  const auto keep = [&](const char* attribute) {
    return text->keep(type.attr(attribute).cast<std::string>());
  };
  for (const py::handle key : type.attr("keys")) text->keys.push_back(key_of(key, *text));
  const SchemeInfo info = {.name = text->keep(name),
                           .label = keep("label"),
                           .family = keep("family"),
                           .summary = keep("summary"),
                           .source = keep("source"),
                           .make_encoder = make_python_encoder,
                           .make_decoder = make_python_decoder,
                           .keys = text->keys,
                           .eight_bit_only = type.attr("eight_bit_only").cast<bool>()};
  require(register_scheme(info));
  text.release();  // the registry points to it from now on
  set_python_class(name, type);
}

/// Whole numbers of `bits` bits each, from any array of whole numbers.
using Words = py::array_t<uint32_t, py::array::c_style | py::array::forcecast>;

void put(BitSink& sink, uint64_t value, uint32_t count) {
  if (count > 64 || (count < 64 && value >> count != 0))
    throw LibraryError({ErrorKind::kBadValue, "put: " + std::to_string(value) + " does not fit into " +
                                                  std::to_string(count) + " bits (at most 64)"});
  sink.put(value, count);
}

py::array get_words(BitSource& source, py::ssize_t length, uint32_t bits) {
  if (length < 0 || length > py::ssize_t{1} << 20 || bits > 32)
    throw LibraryError({ErrorKind::kBadValue, "get_words: takes up to 1048576 words of up to 32 bits"});
  py::array_t<uint32_t> words(length);
  for (py::ssize_t i = 0; i < length; ++i) words.mutable_data()[i] = static_cast<uint32_t>(source.get(bits));
  return words;
}

/// The names of the schemes that a library brings.
std::vector<std::string> schemes_of_plugin(const std::string& path) {
  if (const auto loaded = load_plugin(path); !loaded) throw LibraryError(about(path, loaded.error()));
  const std::string whole = std::filesystem::absolute(path).lexically_normal().string();
  return std::ranges::find(loaded_plugins(), whole, &PluginLibrary::path)->schemes;
}

}  // namespace

void bind_schemes(py::module_& module) {
  module.def("schemes", &registry);
  module.def("register_class", &register_class);
  module.def("python_class", &python_class);
  module.def("load_plugin", &schemes_of_plugin);
  module.def("parse_schemes", [](const std::string& text) {
    std::vector<std::string> texts;
    for (const SchemeSpec& spec : value_of(parse_schemes(text))) texts.push_back(spec.text);
    return texts;
  });
  py::class_<BitSink>(module, "BitWriter", "The bits that a scheme writes, highest first.")
      .def("put", &put, py::arg("value"), py::arg("count"),
           "Appends the low `count` bits of a value, at most 64. Raises Error if the value needs more bits.")
      .def(
          "put_words",
          [](BitSink& sink, const Words& words, uint32_t bits) {
            for (py::ssize_t i = 0; i < words.size(); ++i) put(sink, words.data()[i], bits);
          },
          py::arg("words"), py::arg("bits"), "Appends an array of whole numbers, `bits` bits each.")
      .def_property_readonly("bit_count", &BitSink::bit_count, "Bits written.")
      .def("__bytes__", [](const BitSink& sink) {
        return py::bytes(reinterpret_cast<const char*>(sink.bytes().data()), sink.bytes().size());
      });
  py::class_<BitSource>(module, "BitReader", "The bits that a scheme reads; zeros past the end.")
      .def(
          "get",
          [](BitSource& source, uint32_t count) {
            if (count > 64) throw LibraryError({ErrorKind::kBadValue, "get: takes up to 64 bits"});
            return source.get(count);
          },
          py::arg("count"), "Returns the next `count` bits, at most 64, as a number.")
      .def("get_words", &get_words, py::arg("length"), py::arg("bits"),
           "Returns the next `length` words of `bits` bits, at most 32, as uint32 array.")
      .def_property_readonly("position", &BitSource::position, "Bits read.")
      .def_property_readonly("overran", &BitSource::overran, "True if more bits were read than there are.");
}

}  // namespace tilepress::python
