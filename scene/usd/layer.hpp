#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/mesh/source.hpp"

namespace drape {

/// The value of an attribute: its numbers, with tuples and matrices laid out flat, or its strings.
struct UsdValue {
  SourcePlace place;  ///< where it begins
  std::vector<double> numbers;
  std::vector<std::string> strings;
  bool located = false;  ///< only its place is known, see UsdReading::located_points
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
  SourcePlace place;  ///< where it is declared
  std::string interpolation;
  std::size_t element_size = 1;    ///< how many elements belong to each point, face, …
  std::optional<UsdValue> value;   ///< the one outside of time
  std::vector<UsdSample> samples;  ///< by increasing time

  /// Its first sample, else its value; null if it has neither.
  [[nodiscard]] const UsdValue* first() const {
    return !samples.empty() ? &samples.front().value : value ? &*value : nullptr;
  }
};

/// A relationship of a prim to others.
struct UsdRelationship {
  std::string name;                  ///< "skel:skeleton"
  std::vector<std::string> targets;  ///< paths: "/Model/Skel"
};

/// What a prim, or a whole file, is made of beside what it says itself.
struct UsdArc {
  enum class Kind { inherits, reference, payload, specializes, sublayer };
  Kind kind = Kind::reference;
  std::string file;   ///< as the file has it; empty: the prim stands in the same file
  std::string path;   ///< of a prim; empty: the file's defaultPrim
  double offset = 0;  ///< added to its times, which are stretched before [time codes]
  double scale = 1;   ///< by which its times are stretched
  SourcePlace place;
};

struct UsdVariantSet;

/// What one file says about a prim: its own statements, and where others are to be found.
struct UsdSpec {
  bool is_defined = false;  ///< by `def`; an `over` or a `class` is not part of the scene by itself
  std::string type;         ///< "Mesh"
  std::string name;
  SourcePlace place;
  std::vector<UsdAttribute> attributes;  ///< those that say how a mesh looks and moves, see parse_usd
  std::vector<UsdRelationship> relationships;
  std::vector<UsdArc> arcs;                                     ///< the strongest of each kind first
  std::vector<std::pair<std::string, std::string>> selections;  ///< variant set and variant
  std::vector<UsdVariantSet> variant_sets;
  std::vector<UsdSpec> children;
};

/// What is said about a prim if a variant is selected: each is a UsdSpec with the variant's name.
struct UsdVariantSet {
  std::string name;
  std::vector<UsdSpec> variants;
};

/// A usda file. The defaults are those the USD schema gives a file that does not say.
struct UsdLayer {
  bool z_up = false;
  double metres_per_unit = 0.01;
  double time_codes_per_second = 24;
  double start_time_code = 0;
  std::string default_prim;       ///< what a reference to the file means that names no prim
  std::vector<UsdArc> sublayers;  ///< the strongest first
  std::vector<UsdSpec> prims;
};

/// What to keep of a file, which may be hundreds of megabytes.
struct UsdReading {
  bool moving_points = false;   ///< every sample of every attribute; otherwise only transforms have more than the first
  bool located_points = false;  ///< of the samples of points only the first is kept, and of the others the places:
                                ///< usd_numbers_at() reads one when it is asked for
  /// One to keep beside the texture coordinates and the skin, without "primvars:"; of others that have a number for
  /// each element the names are kept.
  std::string primvar = {};
};

/// Parses an ASCII USD file, of one that stays in its file a piece at a time. The syntax of all of it is checked, but
/// only what a mesh and its motion need is kept: points, faceVertexCounts, faceVertexIndices, orientation, radius,
/// axis, xformOpOrder, xformOp:*, the texture coordinates and the skin among primvars:*, what a Skeleton and a
/// SkelAnimation have, and where other specs of a prim stand.
/// @param source must outlive the layer
/// @throws UsageError "file:line:column: message", also for the binary form of USD, which is not read
UsdLayer parse_usd(const SourceText& source, const UsdReading& reading);

/// The place of the `index`-th number or string of a value, for a message.
SourcePlace usd_value_place(const UsdValue& value, std::size_t index);

}  // namespace drape
