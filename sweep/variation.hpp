#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// A key of a scene and its values in a sweep.
struct Variation {
  std::string key;                  ///< "integrator.tolerance"
  std::vector<std::string> values;  ///< values as for --set
};

/// Splits a list at commas outside of brackets, braces and quotes, and expands ranges. FROM..TO/COUNT is evenly spaced
/// with both ends, FROM..TO/COUNTlog has equal ratios.
/// @throws UsageError for a malformed range
std::vector<std::string> parse_values(const std::string& text);

/// Parses a --vary argument: "key.path=value,value…".
/// @throws UsageError
Variation parse_variation(const std::string& text);

/// Returns the combinations of all keys' values. The default is their product, the last key changing fastest; `zipped`
/// combines the i-th values of all keys. Without varied keys there is one empty combination.
/// @throws UsageError if zipped keys have different numbers of values, or for more than a hundred thousand combinations
std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& varied, bool zipped = false);

/// Returns a combination as overrides of a scene: "integrator.tolerance=0.01".
std::vector<std::string> overrides_of(const std::vector<Variation>& varied, const std::vector<std::string>& values);

/// Replaces --set by --vary in the lines of a message that concern these overrides of a scene or motion.
std::string as_varied(std::string_view message, const std::vector<std::string>& overrides);

}  // namespace drape
