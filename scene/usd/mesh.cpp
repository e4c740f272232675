#include "scene/usd/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "core/text.hpp"
#include "scene/mesh/builder.hpp"
#include "scene/usd/layer.hpp"
#include "scene/usd/xform.hpp"

namespace drape {
namespace {

using Uv = MeshBuilder::Uv;

/// Reads a Mesh prim.
class MeshPrim {
 public:
  MeshPrim(const SourceText& source, const UsdPrim& prim) : source_(source), prim_(prim) {}

  Mesh read(const Eigen::Affine3d& to_world) {
    const UsdValue& points = required("points", 3);
    const UsdValue& counts = required("faceVertexCounts", 1);
    const UsdValue& indices = required("faceVertexIndices", 1);
    point_count_ = points.numbers.size() / 3;
    add_points(points, to_world);
    read_sizes(counts, indices);
    const std::vector<Uv> uvs = corner_uvs(indices);

    const UsdAttribute* orientation = prim_.find("orientation");
    const UsdValue* side = orientation == nullptr ? nullptr : orientation->first();
    const bool left_handed = side != nullptr && !side->strings.empty() && side->strings[0] == "leftHanded";
    add_faces(indices, uvs, left_handed != (to_world.linear().determinant() < 0));
    if (builder_.triangle_count() == 0) source_.fail("there is no face in the file");
    return builder_.finish();
  }

 private:
  /// The first value of an array attribute of numbers.
  const UsdValue& required(std::string_view name, std::size_t components) const {
    const UsdAttribute* attribute = prim_.find(name);
    if (attribute == nullptr || attribute->first() == nullptr) {
      source_.fail(prim_.offset, fmt::format("the Mesh {} has no {}", in_quotes(prim_.name), name));
    }
    if (!attribute->is_array || attribute->components != components) {
      source_.fail(attribute->offset,
                   fmt::format("{}: expected an array of {}, found {}{}", name, components == 3 ? "point3f" : "int",
                               attribute->type, attribute->is_array ? "[]" : ""));
    }
    return *attribute->first();
  }

  /// The `place`-th number of a value as a whole number from `least` up to, but not including, `end`.
  int whole(const UsdValue& value, std::size_t place, double least, double end, std::string_view what) const {
    const double number = value.numbers[place];
    if (number != std::floor(number) || number < least || number >= end) {
      source_.fail(usd_value_offset(source_, value, place),
                   end <= least ? fmt::format("{}: found {}, but there are none", what, number)
                                : fmt::format("{}: expected a whole number from {} to {}, found {}", what, least,
                                              end - 1, number));
    }
    return static_cast<int>(number);
  }

  void add_points(const UsdValue& points, const Eigen::Affine3d& to_world) {
    for (std::size_t i = 0; i < points.numbers.size(); i += 3) {
      const Eigen::Vector3d local(points.numbers[i], points.numbers[i + 1], points.numbers[i + 2]);
      const Eigen::Vector3d position = to_world * local;
      if (!position.allFinite()) source_.fail(usd_value_offset(source_, points, i), "this point overflows in metres");
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
      source_.fail(counts.offset, fmt::format("the faceVertexCounts add up to {}, but there are {} faceVertexIndices",
                                              total, indices.numbers.size()));
    }
  }

  [[nodiscard]] const UsdAttribute* uv_primvar() const {
    const auto usable = [](const UsdAttribute* a) {
      return a != nullptr && a->is_array && a->components == 2 && a->first() != nullptr;
    };
    for (const char* name : {"primvars:st", "primvars:UVMap"}) {
      if (usable(prim_.find(name))) return prim_.find(name);
    }
    for (const UsdAttribute& attribute : prim_.attributes) {
      if (attribute.type.starts_with("texCoord2") && usable(&attribute)) return &attribute;
    }
    return nullptr;
  }

  /// One texture coordinate per entry of faceVertexIndices; empty if the mesh has none.
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

  /// Hands the elements of a primvar to the corners of the faces.
  [[nodiscard]] std::vector<Uv> spread(const UsdAttribute& primvar, const std::vector<Uv>& elements,
                                       const UsdValue& corners) const {
    const std::string& interpolation = primvar.interpolation;
    const bool per_corner = interpolation == "faceVarying", per_face = interpolation == "uniform";
    const bool per_point = interpolation == "vertex" || interpolation == "varying";
    if (!per_corner && !per_face && !per_point && !interpolation.empty() && interpolation != "constant") {
      source_.fail(primvar.offset,
                   fmt::format("{}: expected the interpolation faceVarying, vertex, varying, uniform or "
                               "constant, found {}",
                               primvar.name, in_quotes(interpolation)));
    }
    const std::size_t expected = per_corner  ? corners.numbers.size()
                                 : per_point ? point_count_
                                 : per_face  ? sizes_.size()
                                             : 1;
    if (elements.size() != expected) {
      source_.fail(primvar.offset,
                   fmt::format("{}: expected {} texture coordinates (interpolation {}), found {}", primvar.name,
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
      if (flip) {  // the first corner stays the first
        std::reverse(corners.begin() + 1, corners.end());
        if (!face_uvs.empty()) std::reverse(face_uvs.begin() + 1, face_uvs.end());
      }
      if (!builder_.add_polygon(corners, face_uvs)) {
        source_.fail(usd_value_offset(source_, indices, first),
                     fmt::format("a concave face of {} corners: triangulate it before exporting", size));
      }
      first += size;
    }
  }

  const SourceText& source_;
  const UsdPrim& prim_;
  MeshBuilder builder_;
  std::size_t point_count_ = 0;
  std::vector<std::size_t> sizes_;
};

/// The first Mesh among these prims, or null. @param unused set to the prim that keeps it out of the scene, if one does
const UsdPrim* find_mesh(const std::vector<UsdPrim>& prims, const UsdPrim*& unused) {
  for (const UsdPrim& prim : prims) {
    const UsdPrim* before = unused;
    if (unused == nullptr && !prim.is_defined) unused = &prim;
    if (prim.type == "Mesh") return &prim;
    if (const UsdPrim* mesh = find_mesh(prim.children, unused)) return mesh;
    unused = before;
  }
  return nullptr;
}

/// Says why there is no mesh although one may stand in the file.
[[noreturn]] void fail_without_mesh(const SourceText& source, const UsdLayer& layer) {
  if (layer.mesh_in_variant) {
    source.fail(
        *layer.mesh_in_variant,
        "this Mesh is within a variant set, which is not read, and there is no other: export what is chosen there");
  }
  const UsdPrim* unused = nullptr;
  if (const UsdPrim* mesh = find_mesh(layer.prims, unused)) {
    source.fail(mesh->offset,
                fmt::format("the Mesh {} is not part of the scene: {} of line {} is an 'over' or 'class', not a 'def'",
                            in_quotes(mesh->name), in_quotes(unused->name), source.line(unused->offset)));
  }
  source.fail("there is no Mesh in the file");
}

[[noreturn]] void fail_with_several(const SourceText& source, const std::vector<UsdPath>& meshes) {
  constexpr std::size_t most_told = 20;
  std::string list;
  for (const UsdPath& path : std::span(meshes).first(std::min(most_told, meshes.size()))) {
    const UsdAttribute* points = path.back()->find("points");
    const std::size_t numbers = points == nullptr || points->first() == nullptr ? 0 : points->first()->numbers.size();
    list += fmt::format("{} {} ({} vertices)", list.empty() ? "" : ",", escape_controls(path_text(path)), numbers / 3);
  }
  if (meshes.size() > most_told) list += fmt::format(" and {} more", meshes.size() - most_told);
  source.fail(fmt::format("expected one Mesh in the file, found {}:{}; export the cloth alone", meshes.size(), list));
}

}  // namespace

Mesh read_usd_mesh(const SourceText& source) {
  const UsdLayer layer = parse_usd(source);
  const std::vector<UsdPath> meshes = find_prims(layer, {"Mesh"});
  if (meshes.empty()) fail_without_mesh(source, layer);
  if (meshes.size() > 1) fail_with_several(source, meshes);
  const UsdPath& path = meshes.front();
  return MeshPrim(source, *path.back()).read(world_transform(source, layer, path, layer.start_time_code));
}

}  // namespace drape
