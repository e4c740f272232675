#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/source.hpp"

namespace drape {

/// The value of an attribute: its numbers, with tuples and matrices laid out flat, or its strings.
struct UsdValue {
  std::size_t offset = 0;  ///< where it begins in the file
  std::vector<double> numbers;
  std::vector<std::string> strings;
};

/// A value at a time.
struct UsdSample {
  double time = 0;  ///< [time codes]
  UsdValue value;
};

/// An attribute of a prim.
struct UsdAttribute {
  std::string name;            ///< with its namespaces: "primvars:st"
  std::string type;            ///< "point3f", without the brackets of an array
  std::size_t components = 0;  ///< numbers per element: 3 for point3f, 16 for matrix4d, 0 for strings and tokens
  bool is_array = false;
  std::size_t offset = 0;  ///< where it is declared
  std::string interpolation;
  std::optional<UsdValue> value;   ///< the one outside of time
  std::vector<UsdSample> samples;  ///< by increasing time

  /// Its first sample, else its value; null if it has neither.
  [[nodiscard]] const UsdValue* first() const {
    return !samples.empty() ? &samples.front().value : value ? &*value : nullptr;
  }
};

/// A prim of the scene tree.
struct UsdPrim {
  bool is_defined = false;  ///< by `def`; an `over` or a `class` is not part of the scene by itself
  std::string type;         ///< "Mesh"
  std::string name;
  std::size_t offset = 0;
  std::vector<UsdAttribute> attributes;  ///< those that say how a mesh looks and moves, see parse_usd
  std::vector<UsdPrim> children;

  [[nodiscard]] const UsdAttribute* find(std::string_view attribute) const;
};

/// A usda file. The defaults are those the USD schema gives a file that does not say.
struct UsdLayer {
  bool z_up = false;
  double metres_per_unit = 0.01;
  double time_codes_per_second = 24;
  double start_time_code = 0;
  std::vector<UsdPrim> prims;
  std::optional<std::size_t> mesh_in_variant;  ///< where the first Mesh within a variant set is, which is passed over
};

/// Parses an ASCII USD file. The syntax of all of it is checked, but only what a mesh and its motion need is kept: the
/// attributes points, faceVertexCounts, faceVertexIndices, orientation, radius, xformOpOrder, xformOp:* and the texture
/// coordinates among primvars:*. References to other files, variants and payloads are passed over.
/// @throws UsageError "file:line:column: message", also for the binary form of USD, which is not read
UsdLayer parse_usd(const SourceText& source);

/// The place of the `index`-th number or string of a value, for a message.
std::size_t usd_value_offset(const SourceText& source, const UsdValue& value, std::size_t index);

}  // namespace drape
