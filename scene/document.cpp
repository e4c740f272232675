#include "scene/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <functional>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "scene/mesh/source.hpp"

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

/// Returns the last position of the string that begins at `begin`: its closing quote, or the end of its line or of the
/// text if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string three(3, quote);
  const bool multiline = text.substr(begin).starts_with(three);
  for (std::size_t i = begin + (multiline ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (!multiline && (text[i] == quote || text[i] == '\n')) {
      return i;
    } else if (multiline && text.substr(i).starts_with(three)) {
      // Up to two quotes may come right before the closing three.
      return std::min({text.find_first_not_of(quote, i), i + 5, text.size()}) - 1;
    }
  }
  return text.size();
}

/// Calls fail(offset, message) for a key or a value that is nested too deeply: toml++ and the table readers recurse
/// into it. Between separators a value has at most one dot, so more dots mean a key.
template <class Fail>
void refuse_depth(std::string_view text, const Fail& fail) {
  constexpr std::size_t most_open = 16;
  std::size_t dots = 0, open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      dots = 0;
    } else if (c == '.') {
      if (++dots == most_nested_names) {
        fail(i, fmt::format("expected a key of at most {} names, found more", most_nested_names));
      }
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      dots = 0;
      if (c == '[' || c == '{') ++open;
      if ((c == ']' || c == '}') && open > 0) --open;
      if (open > most_open) fail(i, fmt::format("expected values nested at most {} deep, found more", most_open));
    }
  }
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
  constexpr std::size_t most_bytes = 64'000'000;
  const SourceText source(file.string(), read_text(file, most_bytes));
  refuse_depth(source.text(), [&](std::size_t offset, const std::string& message) { source.fail(offset, message); });
  try {
    const toml::table table = toml::parse(source.text());
    return convert(table, [](const toml::source_region& region) {
      return Place{.line = region.begin.line, .column = region.begin.column};
    });
  } catch (const toml::parse_error& error) {
    const toml::source_position& at = error.source().begin;
    throw UsageError(
        fmt::format("{}:{}:{}: {}", shown(file), at.line, at.column, escape_controls(error.description())));
  }
}

TomlValue parse_value(std::string_view text, const Place& place) {
  refuse_depth(text, [](std::size_t, const std::string& message) { throw UsageError(message); });
  try {
    const toml::table table = toml::parse("value = " + std::string(text));
    if (table.size() != 1) throw UsageError("expected one value, found several lines");
    return convert(table.begin()->second, [&place](const toml::source_region&) { return place; });
  } catch (const toml::parse_error& error) {
    throw UsageError(std::string(error.description()));
  }
}

}  // namespace drape
