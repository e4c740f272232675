#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// A key of a scene, and the values that it takes in turn.
struct Variation {
  std::string key;                  ///< "integrator.tolerance"
  std::vector<std::string> values;  ///< as --set takes them
};

/// Splits a list at its commas, but for those within brackets, braces or quotes, and puts in place of a range its
/// values: FROM..TO/COUNT, evenly spread, both ends among them, or FROM..TO/COUNTlog, of equal ratios.
/// @throws UsageError if what looks like a range is none
std::vector<std::string> parse_values(const std::string& text);

/// Reads what --vary says: "key.path=value,value…".
/// @throws UsageError
Variation parse_variation(const std::string& text);

/// The values of every key, in each combination: the product, in which the last key changes fastest, or, zipped, the
/// first values of all, the second, and so on. One combination, of nothing, where nothing varies.
/// @throws UsageError if keys have different numbers of values and are zipped, or there are more than a hundred
/// thousand
std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& varied, bool zipped = false);

/// A combination as overrides of a scene: "integrator.tolerance=0.01".
std::vector<std::string> overrides_of(const std::vector<Variation>& varied, const std::vector<std::string>& values);

/// A message about a scene or motion with such overrides, in which the lines about them name --vary and not --set.
std::string as_varied(std::string_view message, const std::vector<std::string>& overrides);

}  // namespace drape
