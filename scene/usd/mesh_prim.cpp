#include "scene/usd/mesh_prim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "scene/mesh/builder.hpp"

namespace drape {
namespace {

using Uv = MeshBuilder::Uv;

/// Reader of a Mesh prim.
class MeshPrim {
 public:
  explicit MeshPrim(const UsdPrim& prim) : prim_(prim) {}

  Mesh read(const Eigen::Affine3d& to_world) {
    const UsdValue& points = usd_array(prim_, "points", 3);
    const UsdValue& counts = usd_array(prim_, "faceVertexCounts", 1);
    const UsdValue& indices = usd_array(prim_, "faceVertexIndices", 1);
    point_count_ = points.numbers.size() / 3;
    add_points(points, to_world);
    read_sizes(counts, indices);
    const std::vector<Uv> uvs = corner_uvs(indices);

    const UsdAttribute* orientation = prim_.find("orientation");
    const UsdValue* side = orientation == nullptr ? nullptr : orientation->first();
    const bool left_handed = side != nullptr && !side->strings.empty() && side->strings[0] == "leftHanded";
    add_faces(indices, uvs, left_handed != (to_world.linear().determinant() < 0));
    if (builder_.triangle_count() == 0) prim_.place.source->fail("there is no face in the file");
    return builder_.finish();
  }

 private:
  /// Returns the `place`-th number of a value as a whole number in [least, end).
  int whole(const UsdValue& value, std::size_t place, double least, double end, std::string_view what) const {
    const double number = value.numbers[place];
    if (number != std::floor(number) || number < least || number >= end) {
      usd_value_place(value, place)
          .fail(end <= least
                    ? fmt::format("{}: found {}, but there are none", what, number)
                    : fmt::format("{}: expected a whole number from {} to {}, found {}", what, least, end - 1, number));
    }
    return static_cast<int>(number);
  }

  void add_points(const UsdValue& points, const Eigen::Affine3d& to_world) {
    for (std::size_t i = 0; i < points.numbers.size(); i += 3) {
      const Eigen::Vector3d local(points.numbers[i], points.numbers[i + 1], points.numbers[i + 2]);
      const Eigen::Vector3d position = to_world * local;
      if (!position.allFinite()) usd_value_place(points, i).fail("this point overflows in metres");
      builder_.add_vertex(position);
    }
  }

  void read_sizes(const UsdValue& counts, const UsdValue& indices) {
    std::size_t total = 0;
    const double limit = static_cast<double>(std::numeric_limits<int>::max());
    for (std::size_t face = 0; face < counts.numbers.size(); ++face) {
      sizes_.push_back(static_cast<std::size_t>(whole(counts, face, 3, limit, "faceVertexCounts")));
      total += sizes_.back();
    }
    if (total != indices.numbers.size()) {
      counts.place.fail(fmt::format("the faceVertexCounts add up to {}, but there are {} faceVertexIndices", total,
                                    indices.numbers.size()));
    }
  }

  [[nodiscard]] const UsdAttribute* uv_primvar() const {
    const auto usable = [](const UsdAttribute* a) {
      return a != nullptr && a->is_array && a->components == 2 && a->first() != nullptr;
    };
    for (const char* name : {"primvars:st", "primvars:UVMap"}) {
      if (usable(prim_.find(name))) return prim_.find(name);
    }
    for (const UsdAttribute* attribute : prim_.attributes) {
      if (attribute->type.starts_with("texCoord2") && usable(attribute)) return attribute;
    }
    return nullptr;
  }

  /// Returns one texture coordinate per entry of faceVertexIndices; empty if the mesh has none.
  [[nodiscard]] std::vector<Uv> corner_uvs(const UsdValue& corners) const {
    const UsdAttribute* primvar = uv_primvar();
    if (primvar == nullptr) return {};
    const UsdValue& values = *primvar->first();
    const auto uv = [&](std::size_t i) {
      return Uv{static_cast<float>(values.numbers[2 * i]), static_cast<float>(values.numbers[2 * i + 1])};
    };
    std::vector<Uv> elements;
    const UsdAttribute* indices = prim_.find(primvar->name + ":indices");
    const std::size_t available = values.numbers.size() / 2;
    if (indices != nullptr && indices->is_array && indices->components == 1 && indices->first() != nullptr) {
      const UsdValue& list = *indices->first();
      for (std::size_t i = 0; i < list.numbers.size(); ++i) {
        const int index = whole(list, i, 0, static_cast<double>(available), indices->name);
        elements.push_back(uv(static_cast<std::size_t>(index)));
      }
    } else {
      for (std::size_t i = 0; i < available; ++i) elements.push_back(uv(i));
    }
    return spread(*primvar, elements, corners);
  }

  /// Assigns the elements of a primvar to the corners of the faces.
  [[nodiscard]] std::vector<Uv> spread(const UsdAttribute& primvar, const std::vector<Uv>& elements,
                                       const UsdValue& corners) const {
    const std::string& interpolation = primvar.interpolation;
    const bool per_corner = interpolation == "faceVarying", per_face = interpolation == "uniform";
    const bool per_point = interpolation == "vertex" || interpolation == "varying";
    if (!per_corner && !per_face && !per_point && !interpolation.empty() && interpolation != "constant") {
      primvar.place.fail(
          fmt::format("{}: expected the interpolation faceVarying, vertex, varying, uniform or "
                      "constant, found {}",
                      primvar.name, in_quotes(interpolation)));
    }
    const std::size_t expected = per_corner  ? corners.numbers.size()
                                 : per_point ? point_count_
                                 : per_face  ? sizes_.size()
                                             : 1;
    if (elements.size() != expected) {
      primvar.place.fail(fmt::format("{}: expected {} texture coordinates (interpolation {}), found {}", primvar.name,
                                     expected, interpolation.empty() ? "constant" : interpolation, elements.size()));
    }
    std::vector<Uv> result;
    result.reserve(corners.numbers.size());
    for (std::size_t face = 0, corner = 0; face < sizes_.size(); ++face) {
      for (std::size_t end = corner + sizes_[face]; corner < end; ++corner) {
        const std::size_t element = per_corner  ? corner
                                    : per_point ? static_cast<std::size_t>(vertex(corners, corner))
                                    : per_face  ? face
                                                : 0;
        result.push_back(elements[element]);
      }
    }
    return result;
  }

  [[nodiscard]] int vertex(const UsdValue& indices, std::size_t corner) const {
    return whole(indices, corner, 0, static_cast<double>(point_count_), "faceVertexIndices");
  }

  void add_faces(const UsdValue& indices, const std::vector<Uv>& uvs, bool flip) {
    std::vector<int> corners;
    std::vector<Uv> face_uvs;
    std::size_t first = 0;
    for (const std::size_t size : sizes_) {
      corners.clear();
      for (std::size_t i = first; i < first + size; ++i) {
        corners.push_back(vertex(indices, i));
      }
      face_uvs.clear();
      if (!uvs.empty()) {
        const auto begin = uvs.begin() + static_cast<std::ptrdiff_t>(first);
        face_uvs.assign(begin, begin + static_cast<std::ptrdiff_t>(size));
      }
      if (flip) {  // keep the first corner
        std::reverse(corners.begin() + 1, corners.end());
        if (!face_uvs.empty()) std::reverse(face_uvs.begin() + 1, face_uvs.end());
      }
      if (!builder_.add_polygon(corners, face_uvs)) {
        usd_value_place(indices, first)
            .fail(fmt::format("a concave face of {} corners: triangulate it before exporting", size));
      }
      first += size;
    }
  }

  const UsdPrim& prim_;
  MeshBuilder builder_;
  std::size_t point_count_ = 0;
  std::vector<std::size_t> sizes_;
};

}  // namespace

const UsdValue& usd_array(const UsdPrim& prim, std::string_view name, std::size_t components) {
  const UsdAttribute* attribute = prim.find(name);
  if (attribute == nullptr || attribute->first() == nullptr) {
    prim.place.fail(fmt::format("the {} {} has no {}", prim.type, in_quotes(prim.name), name));
  }
  if (!attribute->is_array || attribute->components != components) {
    attribute->place.fail(fmt::format("{}: expected an array of {}, found {}{}", name,
                                      components == 16  ? "matrix4d"
                                      : components == 4 ? "quatf"
                                      : components == 3 ? "point3f"
                                      : components == 1 ? "int"
                                                        : "token",
                                      attribute->type, attribute->is_array ? "[]" : ""));
  }
  return *attribute->first();
}

Mesh read_mesh_prim(const UsdPrim& prim, const Eigen::Affine3d& to_world) { return MeshPrim(prim).read(to_world); }

}  // namespace drape
