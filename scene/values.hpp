#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "scene/document.hpp"
#include "scene/problems.hpp"

namespace drape {

/// The values that make sense for a number.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;

  [[nodiscard]] bool contains(double value) const {
    return (minimum_excluded ? value > minimum : value >= minimum) && value <= maximum;
  }
  /// "above 0 and at most 1"; empty where every number makes sense.
  [[nodiscard]] std::string text() const;
};

/// Energies and volumes are products of up to three lengths, a stiffness and the number of vertices [m].
inline constexpr double furthest_place = 1e90;

// Each of these reads a value of one kind, strictly: a number may be written as a whole one, and nothing else is
// converted; no number may be nan or infinite. What does not fit is added to `problems`, at its own place and under
// `name`, and nothing is returned.

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

/// Reads an array of three formulas; a number is one too.
/// @param problem see FormulaList
std::optional<std::array<std::string, 3>> read_formulas(
    const TomlValue& value, const std::string& name,
    const std::function<std::optional<std::string>(const std::string&)>& problem, Problems& problems);

/// Reads keyframes, an array of { time, NAME = [x, y, z] }, at least one, whose times increase from 0 on.
void read_keyframes(const TomlValue& value, const std::string& name, const KeyframeList& list, Problems& problems);

/// Reads the name of a file: relative to `folder`, the scene's, or else in the data folder's textures/. An empty string
/// stays empty: no file.
std::optional<std::filesystem::path> read_file_name(const TomlValue& value, const std::string& name,
                                                    const std::filesystem::path& folder, Problems& problems);

/// 'a', 'b' or 'c': which of several keys can be given.
std::string quoted_or(const std::string& first, const std::vector<std::string>& others);

}  // namespace drape
