#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "scene/color.hpp"
#include "scene/document.hpp"

namespace drape {
namespace {

struct WriteValue {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::string* value) const { return fmt::format("\"{}\"", *value); }
  std::string operator()(const std::filesystem::path* value) const { return value->string(); }
  std::string operator()(const Rgb* value) const { return fmt::format("\"{}\"", color_text(*value)); }
  std::string operator()(const Choice& choice) const {
    return choice.initial ? fmt::format("\"{}\"", choice.names[*choice.initial]) : "";
  }
  std::string operator()(const CustomValue&) const { return ""; }
  std::string operator()(const KeyframeList& list) const {
    std::string text;
    for (const Keyframe& keyframe : *list.keyframes) {
      text += fmt::format("{}{{ time = {}, {} = {} }}", text.empty() ? "[" : ", ", keyframe.time, list.names[list.name],
                          (*this)(&keyframe.value));
    }
    return text.empty() ? "" : text + "]";
  }
  std::string operator()(const FormulaList& list) const {
    return fmt::format("[\"{}\"]", fmt::join(*list.formulas, "\", \""));
  }
  std::string operator()(const VertexSelection& selection) const { return (*this)(selection.vertices); }
  std::string operator()(const Eigen::Vector2i* value) const {
    return fmt::format("[{}, {}]", (*value)[0], (*value)[1]);
  }
  std::string operator()(const Eigen::Vector3d* value) const {
    return fmt::format("[{}, {}, {}]", (*value)[0], (*value)[1], (*value)[2]);
  }
  std::string operator()(const std::vector<int>* value) const {
    return value->empty() ? "" : fmt::format("[{}]", fmt::join(*value, ", "));
  }
  template <class T>
  std::string operator()(const std::optional<T>* value) const {
    return *value ? (*this)(&**value) : "";
  }
};

std::string number_text(double number) {
  const std::string text = fmt::format("{}", number);
  // Add a point: otherwise TOML would read an integer, whose range is smaller.
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string toml_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

namespace {

/// Returns a name as TOML writes it: bare if possible.
std::string name_text(const std::string& name) {
  const auto bare = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && std::ranges::all_of(name, bare) ? name : toml_quoted(name);
}

}  // namespace

std::string toml_literal(const TomlValue& value) {
  std::string text;
  if (const TomlTable* table = value.as<TomlTable>()) {
    for (const TomlEntry& entry : table->entries) {
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ", name_text(entry.name), toml_literal(entry.value));
    }
    return text.empty() ? "{}" : text + " }";
  }
  if (const TomlArray* array = value.as<TomlArray>()) {
    for (const TomlValue& item : *array) text += (text.empty() ? "" : ", ") + toml_literal(item);
    return "[" + text + "]";
  }
  if (const std::string* string = value.as<std::string>()) return toml_quoted(*string);
  if (const bool* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const std::int64_t* whole = value.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (const double* number = value.as<double>()) return number_text(*number);
  return "1970-01-01";  // unused: no key accepts a date
}

std::string value_text(const Key::Target& target) { return std::visit(WriteValue{}, target); }

}  // namespace drape
