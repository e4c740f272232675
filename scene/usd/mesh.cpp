#include "scene/usd/mesh.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "core/nearest.hpp"
#include "core/text.hpp"
#include "scene/usd/mesh_prim.hpp"
#include "scene/usd/xform.hpp"

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

}  // namespace drape
