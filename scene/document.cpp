#include "drape/scene/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/mesh/source.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"
#include "scene/values/value_kind.hpp"

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

std::string Problems::text(const Place& place) const {
  if (place.override_number > 0) return fmt::format("--set {}", overrides_[place.override_number - 1]);
  if (place.line == 0) return shown(file_);
  return fmt::format("{}:{}:{}", shown(file_), place.line, place.column);
}

std::string Problems::text() const {
  // Longer lists are not useful to a reader.
  constexpr std::size_t most_told = 100;
  std::vector<const Problem*> sorted;
  for (const Problem& problem : found_) sorted.push_back(&problem);
  std::stable_sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->place < b->place; });
  std::string text;
  for (const Problem* problem : std::span(sorted).first(std::min(most_told, sorted.size()))) {
    const auto& [place, message] = *problem;
    if (!text.empty()) text += '\n';
    text += fmt::format("{}: {}", this->text(place), message);
  }
  if (sorted.size() > most_told) text += fmt::format("\nand {} more", sorted.size() - most_told);
  return escape_controls(text);
}

namespace {

struct Assignment {
  std::vector<std::string> path;
  TomlValue value;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Returns true for a string without quotes: free of characters that suggest a misspelt TOML value.
bool is_bare_word(std::string_view text) {
  return !text.empty() && text.find_first_of(" \t\r\n\"'[]{},=\\") == std::string_view::npos;
}

/// Returns true for a number in a notation that TOML rejects: 1e400, 007.
bool is_like_number(std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  return std::from_chars(text.data(), end, number).ptr == end;
}

/// Splits "cloth.mesh" into its names; empty if a name is missing or there are too many.
std::vector<std::string> split_path(std::string_view text) {
  std::vector<std::string> path;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    const std::string_view name = trimmed(text.substr(begin, end - begin));
    if (!is_bare_word(name)) return {};
    path.emplace_back(name);
    if (path.size() > most_nested_names) return {};
    begin = end + 1;
  }
  return path;
}

std::string joined(const std::vector<std::string>& path, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ".") + path[i];
  return text;
}

/// Parses "key.path=value". @throws UsageError with the reason
Assignment parse_assignment(std::string_view text, const Place& place) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) throw UsageError("expected key.path=value, found no '='");
  Assignment assignment{.path = split_path(text.substr(0, equals)), .value = {.place = place, .data = false}};
  if (assignment.path.empty()) throw UsageError("expected names with dots between them before the '='");

  const std::string_view value = trimmed(text.substr(equals + 1));
  if (value.empty()) throw UsageError("expected a value after the '='");
  try {
    assignment.value = parse_value(value, place);
  } catch (const UsageError& error) {
    if (!is_bare_word(value) || is_like_number(value)) {
      throw UsageError(fmt::format("expected a TOML value or a bare word after the '=': {}", error.what()));
    }
    assignment.value.data = std::string(value);
  }
  return assignment;
}

std::optional<std::size_t> item_number(std::string_view name) {
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

/// Returns the item of an array that path[depth] picks.
TomlValue& item(TomlArray& items, const std::vector<std::string>& path, std::size_t depth) {
  const std::string owner = joined(path, depth);
  if (const TomlValue* named = find_item(items, path[depth]))
    return items[static_cast<std::size_t>(named - items.data())];
  const std::optional<std::size_t> number = item_number(path[depth]);
  if (!number) throw UsageError(fmt::format("{} is an array of {}: say which, as in {}.0", owner, items.size(), owner));
  if (*number >= items.size()) {
    throw UsageError(items.empty() ? owner + " is an empty array"
                                   : fmt::format("{} has the items 0 to {}", owner, items.size() - 1));
  }
  return items[*number];
}

/// Returns true if `value` is an array of one table, and `name` refers to an entry of that table instead of an item
/// number.
bool passes_through(TomlValue& value, std::string_view name) {
  const TomlArray* items = value.as<TomlArray>();
  return items != nullptr && items->size() == 1 && items->front().as<TomlTable>() != nullptr && !item_number(name);
}

/// Calls `use` with a key of a table, "video" or "effects.wind", if it exists. The key's target has its default.
template <class Use>
void with_key(const std::string& table, const std::string& name, Use use) {
  for_each_table([&](const TableType& type) {
    for (const Key& key : type.keys.all()) {
      if (type.name == table && key.name == name) use(key);
    }
  });
}

/// Returns the value to add for a missing name path[depth]: its default if the path goes on to one of its items,
/// otherwise a table.
TomlValue value_on_the_way(const std::vector<std::string>& path, std::size_t depth, const Place& place) {
  TomlValue value{.place = place, .data = TomlTable{}};
  if (depth + 1 == path.size() || !item_number(path[depth + 1])) return value;
  const bool effect = path.front() == "effects" && depth > 1;  // effects may have a number in the path
  with_key(joined(path, effect ? 2 : depth), path[depth], [&](const Key& key) {
    const std::string initial = kind_of(key).text(key);
    if (key.required || !initial.starts_with('[')) {
      throw UsageError(
          fmt::format("{0} has no items until it is given: set all of it, {0}=…", joined(path, depth + 1)));
    }
    value = parse_value(initial, place);
  });
  return value;
}

void apply(TomlValue& document, Assignment assignment, const Place& place) {
  TomlValue* node = &document;
  const std::vector<std::string>& path = assignment.path;
  for (std::size_t depth = 0; depth < path.size(); ++depth) {
    const std::string& name = path[depth];
    if (passes_through(*node, name)) node = &node->as<TomlArray>()->front();
    if (TomlArray* items = node->as<TomlArray>()) {
      node = &item(*items, path, depth);
      continue;
    }
    TomlTable* table = node->as<TomlTable>();
    if (table == nullptr) {
      throw UsageError(fmt::format("{} is {}, not a table", joined(path, depth), node->kind()));
    }
    // An effect written as one table also accepts a number, like one of several.
    if (name == "0" && depth == 2 && path.front() == "effects") continue;
    node = table->find(name);
    if (node == nullptr) {
      table->entries.push_back({name, place, value_on_the_way(path, depth, place)});
      node = &table->entries.back().value;
    }
  }
  *node = std::move(assignment.value);
}

}  // namespace

void apply_overrides(TomlValue& document, const std::vector<std::string>& overrides, Problems& problems) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const Place place{.override_number = i + 1};
    try {
      apply(document, parse_assignment(overrides[i], place), place);
    } catch (const UsageError& error) {
      problems.add(place, error.what());
    }
  }
}

namespace {

/// Appends the canonical form of a value.
void write(const TomlValue& value, const std::vector<std::string>& ignored, std::string& text) {
  if (const TomlTable* table = value.as<TomlTable>()) {
    std::vector<const TomlEntry*> entries;
    for (const TomlEntry& entry : table->entries) {
      if (std::find(ignored.begin(), ignored.end(), entry.name) == ignored.end()) entries.push_back(&entry);
    }
    std::sort(entries.begin(), entries.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
    text += '{';
    for (const TomlEntry* entry : entries) {
      text += fmt::format("{}:{}=", entry->name.size(), entry->name);
      write(entry->value, {}, text);
    }
    text += '}';
  } else if (const TomlArray* array = value.as<TomlArray>()) {
    text += '[';
    for (const TomlValue& item : *array) write(item, {}, text);
    text += ']';
  } else if (const std::string* string = value.as<std::string>()) {
    text += fmt::format("{}:{};", string->size(), *string);
  } else if (const bool* flag = value.as<bool>()) {
    text += *flag ? "true;" : "false;";
  } else if (const std::int64_t* whole = value.as<std::int64_t>()) {
    text += fmt::format("{:.17g};", static_cast<double>(*whole));
  } else if (const double* number = value.as<double>()) {
    text += fmt::format("{:.17g};", *number);
  } else {
    text += "date;";
  }
}

}  // namespace

std::string digest(const TomlValue& document, const std::vector<std::string>& ignored) {
  std::string text;
  write(document, ignored, text);
  return checksum_of(text);
}

}  // namespace drape
