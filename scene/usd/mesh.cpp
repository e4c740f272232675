#include "scene/usd/mesh.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>

#include "core/text.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/layer.hpp"

namespace drape {
namespace {

constexpr std::size_t most_told = 20;

/// Describes a mesh: "/World/cloth (25 vertices, 32 triangles, 2 × 2 × 0 m)"
std::string described(const UsdStage& stage, const UsdPath& path) {
  const UsdPrim& prim = *path.back();
  const auto numbers = [&](const char* name) {
    const UsdAttribute* attribute = prim.find(name);
    return attribute == nullptr || attribute->first() == nullptr ? std::span<const double>()
                                                                 : std::span(attribute->first()->numbers);
  };
  const std::span<const double> points = numbers("points");
  double triangles = 0;
  for (const double corners : numbers("faceVertexCounts")) triangles += std::max(0.0, corners - 2);
  std::string extent;
  if (points.size() >= 3) {
    const Eigen::Affine3d to_world = world_transform(stage, path, stage.layer().start_time_code);
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i + 3 <= points.size(); i += 3) box.extend(to_world * Eigen::Vector3d(&points[i]));
    const Eigen::Vector3d size = box.sizes();
    extent = fmt::format(", {:.3g} × {:.3g} × {:.3g} m", size.x(), size.y(), size.z());
  }
  return fmt::format("{} ({} vertices, {:.0f} triangles{})", escape_controls(prim.path), points.size() / 3, triangles,
                     extent);
}

std::string list_of(const UsdStage& stage, const std::vector<UsdPath>& meshes) {
  std::string list;
  for (const UsdPath& path : std::span(meshes).first(std::min(most_told, meshes.size()))) {
    list += (list.empty() ? "" : ", ") + described(stage, path);
  }
  if (meshes.size() > most_told) list += fmt::format(" and {} more", meshes.size() - most_told);
  return list;
}

/// Returns the meshes at or below a path.
std::vector<UsdPath> within(const std::vector<UsdPath>& meshes, const UsdPath& path) {
  std::vector<UsdPath> found;
  std::ranges::copy_if(meshes, std::back_inserter(found), [&](const UsdPath& mesh) {
    return mesh.size() >= path.size() && mesh[path.size() - 1] == path.back();
  });
  return found;
}

[[noreturn]] void fail_without_mesh(const UsdStage& stage) {
  if (stage.gaps().empty()) stage.source().fail("there is no Mesh in the file");
  const UnresolvedReference& gap = stage.gaps().front();
  gap.place.fail("there is no Mesh in the file, and what this refers to is not read: " + gap.reason);
}

[[noreturn]] void fail_without(const UsdStage& stage, const std::string& prim, const std::vector<UsdPath>& meshes) {
  std::vector<std::string> names;
  for (const UsdPath& path : meshes) names.push_back(escape_controls(path.back()->path));
  const std::string nearest = nearest_name(prim, names);
  stage.source().fail(
      fmt::format("there is no prim {} in the file; {}", in_quotes(prim),
                  nearest.empty() ? "it has " + list_of(stage, meshes) : fmt::format("did you mean '{}'?", nearest)));
}

[[noreturn]] void fail_without_primvar(const UsdPrim& mesh, const std::string& primvar) {
  constexpr std::string_view prefix = "primvars:";
  std::vector<std::string> names;
  for (const UsdAttribute* attribute : mesh.attributes) {
    const std::string_view name = attribute->name;
    if (!name.starts_with(prefix) || !attribute->is_array || attribute->components != 1) continue;
    const std::string bare = escape_controls(name.substr(prefix.size()));
    if (bare.starts_with("skel:") || bare.ends_with(":indices") || bare == primvar) continue;
    if (std::ranges::find(names, bare) == names.end()) names.push_back(bare);
  }
  mesh.place.fail(fmt::format("the {} {} has no primvars:{}{}", mesh.type, in_quotes(mesh.name), primvar,
                              did_you_mean(primvar, names, "its primvars of one number are")));
}

}  // namespace

UsdPath choose_usd_mesh(const UsdStage& stage, const std::string& prim) {
  const std::vector<UsdPath> all = find_prims(stage, {"Mesh"}, true);
  if (all.empty()) fail_without_mesh(stage);
  std::vector<UsdPath> meshes = find_prims(stage, {"Mesh"});
  if (meshes.empty()) meshes = all;
  if (!prim.empty()) {
    const UsdPath path = stage.find(prim);
    if (path.empty()) fail_without(stage, prim, all);
    meshes = within(all, path);
    if (meshes.empty()) {
      path.back()->place.fail(
          fmt::format("{} is no Mesh and has none below it; the file has {}", in_quotes(prim), list_of(stage, all)));
    }
    if (meshes.front().back() == path.back()) meshes.resize(1);
  }
  if (meshes.size() > 1) {
    stage.source().fail(
        fmt::format("expected one Mesh{}, found {}: {}; choose one by its name: {{ file = …, prim = "
                    "\"{}\" }}",
                    prim.empty() ? " in the file" : " below " + in_quotes(prim), meshes.size(), list_of(stage, meshes),
                    escape_controls(meshes.front().back()->path)));
  }
  return meshes.front();
}

Mesh read_usd_mesh(const UsdStage& stage, const std::string& prim) {
  const UsdPath path = choose_usd_mesh(stage, prim);
  return read_mesh_prim(*path.back(), world_transform(stage, path, stage.layer().start_time_code));
}

std::vector<int> read_usd_primvar(const UsdStage& stage, const std::string& prim, const std::string& primvar) {
  const UsdPath path = choose_usd_mesh(stage, prim);
  const std::size_t points = usd_array(*path.back(), "points", 3).numbers.size() / 3;
  const UsdAttribute* attribute = path.back()->find("primvars:" + primvar);
  if (attribute == nullptr || attribute->first() == nullptr) fail_without_primvar(*path.back(), primvar);
  const UsdValue& value = usd_array(*path.back(), attribute->name, 1);
  if (value.numbers.size() != points) {
    value.place.fail(fmt::format("primvars:{}: expected a number for each of the {} points, found {}", primvar, points,
                                 value.numbers.size()));
  }
  std::vector<int> found;
  for (std::size_t i = 0; i < points; ++i) {
    if (value.numbers[i] != 0) found.push_back(static_cast<int>(i));
  }
  return found;
}

Mesh read_usd_mesh(const SourceText& source, const std::string& prim) { return read_usd_mesh(UsdStage(source), prim); }

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

namespace {

constexpr std::string_view reset_stack = "!resetXformStack!";
constexpr std::string_view invert_prefix = "!invert!";
constexpr std::string_view operation_prefix = "xformOp:";

Eigen::Affine3d rotation(std::string_view axes, const std::vector<double>& degrees) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (const char axis : axes) {
    // The first axis named acts first. Angles are ordered x, y, z for any order of axes; a single axis has one angle.
    const auto index = static_cast<std::size_t>(axis - 'X');
    const double angle = degrees[axes.size() == 1 ? 0 : index] * std::numbers::pi / 180;
    result = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis - 'X')) * result;
  }
  return result;
}

const UsdValue* operation_order(const UsdPrim& prim) {
  const UsdAttribute* order = prim.find("xformOpOrder");
  return order == nullptr || !order->value ? nullptr : &*order->value;
}

/// A transform operation of a prim, such as xformOp:rotateXYZ.
class Operation {
 public:
  /// @param name the `index`-th of xformOpOrder, without !invert!
  Operation(const UsdPrim& prim, std::string_view name, std::size_t index) : attribute_(prim.find(name)) {
    const std::string_view after = name.substr(std::min(name.size(), operation_prefix.size()));
    kind_ = after.substr(0, after.find(':'));
    if (!name.starts_with(operation_prefix) || attribute_ == nullptr) {
      usd_value_place(*operation_order(prim), index)
          .fail(fmt::format("the prim {} has no operation {}", in_quotes(prim.name), in_quotes(name)));
    }
    const std::size_t components = expected_components();
    if (components == 0) {
      attribute_->place.fail(
          fmt::format("unknown operation {}: expected xformOp:translate, scale, rotateX, rotateY, rotateZ, "
                      "rotateXYZ or another order of these, orient or transform",
                      in_quotes(name)));
    }
    if (attribute_->is_array || attribute_->components != components) {
      attribute_->place.fail(fmt::format("{}: expected a type of {} numbers, found {}{}", name, components,
                                         attribute_->type, attribute_->is_array ? "[]" : ""));
    }
  }

  [[nodiscard]] Eigen::Affine3d at(double time) const {
    const std::vector<double> v = usd_numbers_at(*attribute_, time);
    if (v.empty()) return Eigen::Affine3d::Identity();
    if (kind_ == "translate") return Eigen::Affine3d(Eigen::Translation3d(v[0], v[1], v[2]));
    if (kind_ == "scale") return Eigen::Affine3d(Eigen::Scaling(v[0], v[1], v[2]));
    if (kind_ == "orient") return Eigen::Affine3d(usd_quaternion(v.data()));
    if (kind_ != "transform") return rotation(kind_.substr(6), v);
    return usd_affine(v.data(), place());
  }

  [[nodiscard]] SourcePlace place() const {
    return attribute_->first() != nullptr ? attribute_->first()->place : attribute_->place;
  }

 private:
  [[nodiscard]] std::size_t expected_components() const {
    if (kind_ == "transform") return 16;
    if (kind_ == "orient") return 4;
    if (kind_ == "translate" || kind_ == "scale") return 3;
    if (!kind_.starts_with("rotate")) return 0;
    std::string axes(kind_.substr(6));
    if (axes == "X" || axes == "Y" || axes == "Z") return 1;
    std::sort(axes.begin(), axes.end());
    return axes == "XYZ" ? 3 : 0;
  }

  const UsdAttribute* attribute_;
  std::string_view kind_;
};

bool resets_stack(const UsdPrim& prim) {
  const UsdValue* order = operation_order(prim);
  return order != nullptr &&
         std::find(order->strings.begin(), order->strings.end(), reset_stack) != order->strings.end();
}

/// Returns the transform from prim to parent coordinates. The last operation of the order acts first.
Eigen::Affine3d local_transform(const UsdPrim& prim, double time) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  const UsdValue* order = operation_order(prim);
  if (order == nullptr) return result;
  for (std::size_t i = 0; i < order->strings.size(); ++i) {
    std::string_view name = order->strings[i];
    if (name == reset_stack) continue;
    const bool inverted = name.starts_with(invert_prefix);
    if (inverted) name.remove_prefix(invert_prefix.size());
    const Operation operation(prim, name, i);
    const Eigen::Affine3d matrix = operation.at(time);
    if (inverted && !(std::abs(matrix.linear().determinant()) > 0)) {
      operation.place().fail(fmt::format("{} cannot be inverted", name));
    }
    result = result * (inverted ? matrix.inverse() : matrix);
  }
  return result;
}

}  // namespace

Eigen::Affine3d usd_affine(const double* m, const SourcePlace& place) {
  Eigen::Affine3d result;
  result.matrix() = Eigen::Map<const Eigen::Matrix4d>(m);  // rows of USD's matrix become columns
  if (result.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    place.fail("the matrix is not affine: its last column must be 0, 0, 0, 1");
  }
  return result;
}

Eigen::Affine3d world_transform(const UsdStage& stage, const UsdPath& path, double time) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    result = local_transform(**prim, time) * result;
    if (resets_stack(**prim)) break;
  }
  if (!stage.layer().z_up) {
    // Exactly (x, y, z) → (x, −z, y): a rotation by π/2 would add rounding errors to every coordinate.
    Eigen::Matrix3d to_z_up;
    to_z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    result = Eigen::Affine3d(to_z_up) * result;
  }
  result = Eigen::Scaling(stage.layer().metres_per_unit) * result;
  if (!result.matrix().allFinite()) {
    path.back()->place.fail(fmt::format("the transform of {} overflows", in_quotes(path.back()->name)));
  }
  return result;
}

std::vector<double> transform_times(const UsdPath& path) {
  std::vector<double> times;
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    if (const UsdValue* order = operation_order(**prim)) {
      for (std::string_view name : order->strings) {
        if (name.starts_with(invert_prefix)) name.remove_prefix(invert_prefix.size());
        const UsdAttribute* attribute = (*prim)->find(name);
        if (attribute == nullptr) continue;
        for (const UsdSample& sample : attribute->samples) times.push_back(sample.time);
      }
    }
    if (resets_stack(**prim)) break;
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace drape
