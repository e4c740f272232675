#include "python/values.hpp"

#include <fmt/format.h>

#include "scene/value_text.hpp"

namespace py = pybind11;

namespace drape::python {
namespace {

constexpr Place nowhere{.line = 0, .column = 0};

std::string key_text(const py::handle& key) {
  if (!py::isinstance<py::str>(key)) {
    throw py::type_error(fmt::format("expected names of keys, found {}", std::string(py::repr(key))));
  }
  return key.cast<std::string>();
}

TomlValue value_of(decltype(TomlValue::data) data) { return {.place = nowhere, .data = std::move(data)}; }

TomlValue to_table(const py::dict& dictionary, const std::string& name, int depth) {
  TomlTable table;
  for (const auto& [key, item] : dictionary) {
    const std::string text = key_text(key);
    table.entries.push_back({text, nowhere, to_toml(item, name.empty() ? text : name + "." + text, depth + 1)});
  }
  return value_of(std::move(table));
}

TomlValue to_array(const py::iterable& items, const std::string& name, int depth) {
  TomlArray array;
  for (const py::handle item : items)
    array.push_back(to_toml(item, fmt::format("{}.{}", name, array.size()), depth + 1));
  return value_of(std::move(array));
}

}  // namespace

TomlValue to_toml(const py::handle& value, const std::string& name, int depth) {
  if (depth > static_cast<int>(most_nested_names)) throw py::type_error(name + " is nested deeper than any scene");
  if (py::isinstance<py::bool_>(value)) return value_of(value.cast<bool>());
  if (py::isinstance<py::int_>(value)) return value_of(value.cast<std::int64_t>());
  if (py::isinstance<py::float_>(value)) return value_of(value.cast<double>());
  if (py::isinstance<py::str>(value)) return value_of(value.cast<std::string>());
  if (py::isinstance<py::dict>(value)) return to_table(value.cast<py::dict>(), name, depth);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    return to_array(value.cast<py::iterable>(), name, depth);
  }
  if (py::hasattr(value, "tolist")) return to_toml(value.attr("tolist")(), name, depth + 1);  // numpy values
  if (py::hasattr(value, "__fspath__")) return to_toml(value.attr("__fspath__")(), name, depth + 1);
  throw py::type_error(fmt::format("{}: expected a number, a string, a list or a dictionary, found {}",
                                   name.empty() ? "scene" : name, std::string(py::repr(value))));
}

std::vector<std::string> to_overrides(const py::dict& set) {
  std::vector<std::string> overrides;
  for (const auto& [key, value] : set) {
    const std::string name = key_text(key);
    overrides.push_back(name + "=" + toml_literal(to_toml(value, name)));
  }
  return overrides;
}

}  // namespace drape::python
