#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/core/rgb.hpp"
#include "drape/scene/document.hpp"

namespace drape {

/// The accepted range of a number.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;

  [[nodiscard]] bool contains(double value) const {
    return (minimum_excluded ? value > minimum : value >= minimum) && value <= maximum;
  }
  /// Returns for example "above 0 and at most 1"; empty if every number is accepted.
  [[nodiscard]] std::string text() const;
};

/// Largest coordinate [m]. Energies and volumes multiply up to three lengths, a stiffness and the number of vertices.
inline constexpr double furthest_place = 1e90;

// Each function reads a value of one kind. Whole numbers convert to numbers; nothing else is converted, and nan or
// infinite numbers are rejected. A wrong value is added to `problems` with its place and `name`; nothing is returned.

/// Returns the items of an array of the given size; null after a problem.
const TomlArray* read_array(const TomlValue& value, const std::string& name, std::size_t size, const char* what,
                            Problems& problems);

/// Returns "name[index]".
std::string item_name(const std::string& name, std::size_t index);

std::optional<bool> read_bool(const TomlValue& value, const std::string& name, Problems& problems);
std::optional<int> read_int(const TomlValue& value, const std::string& name, const Range& range, Problems& problems);
std::optional<double> read_number(const TomlValue& value, const std::string& name, const Range& range,
                                  Problems& problems);
std::optional<std::string> read_string(const TomlValue& value, const std::string& name, Problems& problems);

/// Reads an array of three numbers, each in the range.
std::optional<Eigen::Vector3d> read_vector(const TomlValue& value, const std::string& name, const Range& range,
                                           Problems& problems);

/// Reads an array of two numbers, each in the range.
std::optional<Eigen::Vector2d> read_pair(const TomlValue& value, const std::string& name, const Range& range,
                                         Problems& problems);

/// Reads an array of two whole numbers, each in the range.
std::optional<Eigen::Vector2i> read_int_pair(const TomlValue& value, const std::string& name, const Range& range,
                                             Problems& problems);

/// Reads an array of whole numbers, each in the range.
std::optional<std::vector<int>> read_ints(const TomlValue& value, const std::string& name, const Range& range,
                                          Problems& problems);

/// Reads a file name, relative to `folder` (of the scene), otherwise to textures/ of the data folder. An empty string
/// stays empty: no file.
std::optional<std::filesystem::path> read_file_name(const TomlValue& value, const std::string& name,
                                                    const std::filesystem::path& folder, Problems& problems);

/// Returns 'a', 'b' or 'c': a list of alternative keys.
std::string quoted_or(const std::string& first, const std::vector<std::string>& others);

/// Returns the names of all named colours: the sixteen basic colours of CSS, and orange.
std::span<const std::string> color_names();

/// Reads "#rrggbb", "#rgb" or one of color_names(). Returns nothing for other texts.
std::optional<Rgb> parse_color(std::string_view text);

/// Returns "#rrggbb"; each channel is rounded to the nearest of 0…255.
std::string color_text(const Rgb& color);

/// Returns a value of a document as TOML, on one line.
std::string toml_literal(const TomlValue& value);

/// Returns a string in TOML's quotes.
std::string toml_quoted(const std::string& text);

}  // namespace drape
