#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drape/core/error.hpp"

namespace drape {

/// Place of a value in the source. Places sort in reading order: through the file, then through the overrides.
struct Place {
  std::size_t override_number = 0;  ///< 0: in the file; n: in the n-th override, which has no line and column
  std::size_t line = 1;             ///< from 1; 0: value without source text
  std::size_t column = 1;           ///< from 1, in characters
  auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): compiler-generated 0
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

/// Parses an override's value, such as "[1, 2]" or "0.5". All its nodes get the place `place`.
/// @throws UsageError with the parser's message
TomlValue parse_value(std::string_view text, const Place& place);

/// A scene whose values are valid one by one but not together, for example steps too long for the method.
class SceneConflict : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Collector of a scene's problems, so that users see all of them at once.
class Problems {
 public:
  /// @param file            scene file name for messages
  /// @param overrides       "key.path=value", in order
  /// @param override_folder see override_folder()
  Problems(std::filesystem::path file, std::vector<std::string> overrides,
           std::optional<std::filesystem::path> override_folder = {})
      : file_(std::move(file)), overrides_(std::move(overrides)), override_folder_(std::move(override_folder)) {}

  /// Returns a folder besides the scene's for files that overrides name, if there is one.
  [[nodiscard]] const std::optional<std::filesystem::path>& override_folder() const { return override_folder_; }

  /// @param message a sentence without a full stop; further lines are shown below it
  void add(const Place& place, std::string message) { found_.push_back({place, std::move(message)}); }

  [[nodiscard]] std::size_t count() const { return found_.size(); }

  /// Returns "scene.toml:4:9" or "--set key.path=value"; the file alone for a place without a text.
  [[nodiscard]] std::string text(const Place& place) const;

  /// Lists the problems in the order of their places, a line each: at most a hundred, then the number of others.
  [[nodiscard]] std::string text() const;

  /// @throws Wrong with all problems, if there are any
  template <class Wrong = UsageError>
  void throw_if_any() const {
    if (!found_.empty()) throw Wrong(text());
  }

 private:
  struct Problem {
    Place place;
    std::string message;
  };
  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  std::optional<std::filesystem::path> override_folder_;
  std::vector<Problem> found_;
};

/// Applies assignments "key.path=value" to a document in order, as if the file contained them. The value is any TOML
/// value, or a bare word, which is a string. Missing tables on the path are added. A number on the path picks an item
/// of an array: effects.sphere.0.radius. The number may be omitted for an array of one table: effects.sphere.radius.
/// Assigning to an item of an absent array changes the array's default: video.size.0. Failed assignments are added to
/// `problems`.
void apply_overrides(TomlValue& document, const std::vector<std::string>& overrides, Problems& problems);

/// Computes a hash of a document's content, 16 hexadecimal digits. Comments, the order of keys and the notation of
/// numbers (1, 1.0, 1e0) do not change it.
/// @param ignored names of top-level tables to leave out
std::string digest(const TomlValue& document, const std::vector<std::string>& ignored = {});

}  // namespace drape
