#include "scene/document.hpp"

#include <toml++/toml.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <system_error>

#include "core/error.hpp"

namespace drape {
namespace {

using Locate = std::function<Place(const toml::source_region&)>;

TomlValue convert(const toml::node& node, const Locate& locate) {
  TomlValue value{.place = locate(node.source()), .data = DateOrTime{}};
  if (const toml::table* table = node.as_table()) {
    TomlTable& to = value.data.emplace<TomlTable>();
    for (const auto& [key, item] : *table) {
      to.entries.push_back({std::string(key.str()), locate(key.source()), convert(item, locate)});
    }
  } else if (const toml::array* array = node.as_array()) {
    TomlArray& to = value.data.emplace<TomlArray>();
    for (const toml::node& item : *array) to.push_back(convert(item, locate));
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* whole = node.as_integer()) {
    value.data = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.data = flag->get();
  }
  return value;
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw UsageError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status))
    throw UsageError(file.string() + ": expected a scene file, found a folder");
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw UsageError(file.string() + ": cannot be read");
  return text;
}

}  // namespace

const TomlValue* TomlTable::find(std::string_view name) const {
  for (const TomlEntry& entry : entries) {
    if (entry.name == name) return &entry.value;
  }
  return nullptr;
}

TomlValue* TomlTable::find(std::string_view name) { return const_cast<TomlValue*>(std::as_const(*this).find(name)); }

std::string TomlValue::kind() const {
  static constexpr const char* kinds[] = {"true or false",  "a whole number", "a number", "a string",
                                          "a date or time", "an array",       "a table"};
  return kinds[data.index()];
}

TomlValue read_document(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  try {
    const toml::table table = toml::parse(text);
    return convert(table, [](const toml::source_region& source) {
      return Place{.line = source.begin.line, .column = source.begin.column};
    });
  } catch (const toml::parse_error& error) {
    const toml::source_position& at = error.source().begin;
    throw UsageError(file.string() + ':' + std::to_string(at.line) + ':' + std::to_string(at.column) + ": " +
                     std::string(error.description()));
  }
}

TomlValue parse_value(std::string_view text, const Place& place) {
  try {
    const toml::table table = toml::parse("value = " + std::string(text));
    if (table.size() != 1) throw UsageError("expected one value, found several lines");
    return convert(table.begin()->second, [&place](const toml::source_region&) { return place; });
  } catch (const toml::parse_error& error) {
    throw UsageError(std::string(error.description()));
  }
}

}  // namespace drape
