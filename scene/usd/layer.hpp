#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/mesh/source.hpp"
#include "scene/usd/parser.hpp"

namespace drape {

/// The value of an attribute: its numbers, with tuples and matrices flattened, or its strings.
struct UsdValue {
  SourcePlace place;  ///< start of the value
  std::vector<double> numbers;
  std::vector<std::string> strings;
  bool located = false;  ///< only the place is known, see UsdReading::located_points
};

/// A value of an attribute at a time.
struct UsdSample {
  double time = 0;  ///< [time codes]
  UsdValue value;
};

/// An attribute of a prim.
struct UsdAttribute {
  std::string name;            ///< with its namespaces: "primvars:st"
  std::string type;            ///< element type, without the brackets of an array: "point3f"
  std::size_t components = 0;  ///< numbers per element: 3 for point3f, 16 for matrix4d, 0 for strings and tokens
  bool is_array = false;
  SourcePlace place;  ///< place of the declaration
  std::string interpolation;
  std::size_t element_size = 1;    ///< elements per point, face, …
  std::optional<UsdValue> value;   ///< default value, independent of time
  std::vector<UsdSample> samples;  ///< time samples, in increasing order

  /// Returns the first sample, otherwise the default value; null if it has neither.
  [[nodiscard]] const UsdValue* first() const {
    return !samples.empty() ? &samples.front().value : value ? &*value : nullptr;
  }
};

/// A relationship of a prim to others.
struct UsdRelationship {
  std::string name;                  ///< "skel:skeleton"
  std::vector<std::string> targets;  ///< target paths: "/Model/Skel"
};

/// A composition arc: a reference from a prim or a file to other prims.
struct UsdArc {
  enum class Kind { inherits, reference, payload, specializes, sublayer };
  Kind kind = Kind::reference;
  std::string file;   ///< file as written; empty: the same file
  std::string path;   ///< path of a prim; empty: the defaultPrim of the file
  double offset = 0;  ///< added to its times after scaling [time codes]
  double scale = 1;   ///< factor of its times
  SourcePlace place;
};

struct UsdVariantSet;

/// The statements of one file about a prim, and its composition arcs.
struct UsdSpec {
  bool is_defined = false;  ///< declared by `def`; an `over` or a `class` alone does not add the prim to the scene
  std::string type;         ///< "Mesh"
  std::string name;
  SourcePlace place;
  std::vector<UsdAttribute> attributes;  ///< attributes of shape and motion, see parse_usd
  std::vector<UsdRelationship> relationships;
  std::vector<UsdArc> arcs;                                     ///< strongest first within each kind
  std::vector<std::pair<std::string, std::string>> selections;  ///< variant set and selected variant
  std::vector<UsdVariantSet> variant_sets;
  std::vector<UsdSpec> children;
};

/// The variants of a prim. Each is a UsdSpec with the variant's name and applies if it is selected.
struct UsdVariantSet {
  std::string name;
  std::vector<UsdSpec> variants;
};

/// A usda file. The defaults are those of the USD schema.
struct UsdLayer {
  bool z_up = false;
  double metres_per_unit = 0.01;
  double time_codes_per_second = 24;
  double start_time_code = 0;
  std::string default_prim;       ///< target of references that name no prim
  std::vector<UsdArc> sublayers;  ///< strongest first
  std::vector<UsdSpec> prims;
};

/// The parts of a file to keep; files may have hundreds of megabytes.
struct UsdReading {
  bool moving_points = false;   ///< keep every sample of every attribute; otherwise only of transforms
  bool located_points = false;  ///< keep the first sample of points and the places of the others;
                                ///< usd_numbers_at() reads them on request
  /// One primvar to keep besides texture coordinates and skin, without "primvars:". Of other primvars with one number
  /// per element only the names are kept.
  std::string primvar = {};
};

/// Parses an ASCII USD file; a source that stays in its file is read in pieces. The syntax is checked everywhere, but
/// only the data of meshes and their motion is kept: points, faceVertexCounts, faceVertexIndices, orientation, radius,
/// axis, xformOpOrder, xformOp:*, texture coordinates and skin from primvars:*, the data of Skeleton and SkelAnimation,
/// and composition arcs.
/// @param source must outlive the layer
/// @throws UsageError "file:line:column: message", also for binary USD, which is not supported
UsdLayer parse_usd(const SourceText& source, const UsdReading& reading);

/// Returns the place of the `index`-th number or string of a value, for a message.
SourcePlace usd_value_place(const UsdValue& value, std::size_t index);

/// Element type of a USD attribute.
struct UsdType {
  enum class Kind { number, text, other };
  Kind kind = Kind::other;
  std::size_t rows = 0, columns = 0;  ///< 1×1 for a number, 1×n for a tuple, n×n for a matrix

  [[nodiscard]] std::size_t components() const { return rows * columns; }
};

/// Returns the type of a name in a usda file, without the brackets of an array; `other` unless it consists of numbers
/// or text. The names: https://openusd.org/release/api/_usd__page__datatypes.html
UsdType usd_type(std::string_view name);

/// Parses a value of an attribute at the lexer's token and moves past it; returns nothing for None.
/// @param type type of the attribute, numbers or text
/// @throws UsageError unless it has the attribute's shape and finite numbers
std::optional<UsdValue> parse_usd_value(const SourceText& source, UsdLexer& lexer, const UsdAttribute& attribute,
                                        const UsdType& type);

/// Returns a value of an attribute; a located value is read from the file. @throws UsageError as parse_usd_value()
UsdValue usd_value_of(const UsdAttribute& attribute, const UsdValue& value);

/// Makes a rotation from real and imaginary parts; zeros give the identity.
Eigen::Quaterniond usd_quaternion(const double* wxyz);

/// Returns the numbers of an attribute at a time [time codes]; empty if it has no value. Samples are interpolated
/// linearly, quaternions along the shortest arc. Between samples of different lengths the earlier one holds; outside of
/// all samples the nearest one holds.
std::vector<double> usd_numbers_at(const UsdAttribute& attribute, double time);

}  // namespace drape
