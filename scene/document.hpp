#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drape {

/// Place of a value in the source. Places sort in reading order: through the file, then through the overrides.
struct Place {
  std::size_t override_number = 0;  ///< 0: in the file; n: in the n-th override, which has no line and column
  std::size_t line = 1;             ///< from 1; 0: no place in a text
  std::size_t column = 1;           ///< from 1, in characters
  auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): the 0 is the compiler's
};

struct TomlValue;
struct TomlEntry;

/// A TOML date or time. No key of a scene accepts one.
struct DateOrTime {};

using TomlArray = std::vector<TomlValue>;

struct TomlTable {
  std::vector<TomlEntry> entries;  ///< entries with unique names, unordered

  [[nodiscard]] const TomlValue* find(std::string_view name) const;
  [[nodiscard]] TomlValue* find(std::string_view name);
};

/// A node of a TOML document.
struct TomlValue {
  Place place;
  std::variant<bool, std::int64_t, double, std::string, DateOrTime, TomlArray, TomlTable> data;

  template <class T>
  [[nodiscard]] const T* as() const {
    return std::get_if<T>(&data);
  }
  template <class T>
  [[nodiscard]] T* as() {
    return std::get_if<T>(&data);
  }
  /// Returns the kind of value for messages: "a number", "a string", ….
  [[nodiscard]] std::string kind() const;
};

struct TomlEntry {
  std::string name;
  Place place;  ///< place of the name
  TomlValue value;
};

/// Largest number of names in a dotted key, far more than any scene needs.
inline constexpr std::size_t most_nested_names = 16;

/// Reads a TOML file into a table.
/// @throws UsageError if it cannot be read, is not TOML, or is nested too deeply; "file:line:col: message" for the
/// first syntax error
TomlValue read_document(const std::filesystem::path& file);

/// Reads the right side of an assignment, "[1, 2]" or "0.5"; every place in it is `place`.
/// @throws UsageError with the parser's message
TomlValue parse_value(std::string_view text, const Place& place);

}  // namespace drape
