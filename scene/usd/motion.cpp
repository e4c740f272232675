#include "scene/usd/motion.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.hpp"
#include "scene/usd/skin.hpp"
#include "scene/usd/stage.hpp"
#include "scene/usd/xform.hpp"
#include "sim/between.hpp"

namespace drape {
namespace {

UsdPath moving_prim(const UsdStage& stage) {
  const std::vector<UsdPath> shapes = find_prims(stage, {"Mesh", "Sphere"});
  for (const UsdPath& path : shapes) {
    if (!transform_times(path).empty()) return path;
  }
  if (!shapes.empty()) return shapes.front();
  for (const UsdPath& path : find_prims(stage, {})) {
    if (!transform_times(path).empty()) return path;
  }
  stage.source().fail("there is neither a Mesh nor a Sphere nor a moving prim in the file");
}

void bound_points(const UsdAttribute& points, TransformTrack& track) {
  if (points.components != 3 || !points.is_array || points.first() == nullptr) {
    points.place.fail("points: expected an array of point3f, found " + points.type);
  }
  const std::vector<double>& numbers = points.first()->numbers;
  if (numbers.empty()) return;
  const Eigen::Map<const Eigen::Matrix3Xd> positions(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
  const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
  track.center = low / 2 + high / 2;
  track.radius = (positions.colwise() - track.center).colwise().stableNorm().maxCoeff();
}

void bound_sphere(const UsdPrim& prim, TransformTrack& track) {
  track.radius = 1;  // default of a Sphere in the USD schema
  const UsdAttribute* radius = prim.find("radius");
  if (radius == nullptr || radius->first() == nullptr) return;
  if (radius->components != 1 || radius->is_array) radius->place.fail("radius: expected one number");
  track.radius = radius->first()->numbers[0];
  if (track.radius <= 0) radius->first()->place.fail("radius: expected a positive number");
}

class UsdSphereTrack final : public SphereTrack {
 public:
  explicit UsdSphereTrack(TransformTrack track) : track_(std::move(track)) {}
  [[nodiscard]] SphereShape at(double time) const override { return track_.sphere_at(time); }

 private:
  TransformTrack track_;
};

}  // namespace

Eigen::Affine3d TransformTrack::at(double time) const {
  const auto [before, after, share] = between(times, time);
  Eigen::Affine3d result = transforms[before];
  if (before != after) result.matrix() += share * (transforms[after].matrix() - transforms[before].matrix());
  return result;
}

SphereShape TransformTrack::sphere_at(double time) const {
  const Eigen::Affine3d transform = at(time);
  const double stretch = Eigen::JacobiSVD<Eigen::Matrix3d>(transform.linear()).singularValues()[0];
  return {transform * center, stretch * radius};
}

TransformTrack read_usd_track(const UsdStage& stage, const UsdPath& path) {
  const UsdLayer& layer = stage.layer();
  const UsdPrim& prim = *path.back();

  TransformTrack track;
  std::vector<double> time_codes = transform_times(path);
  if (time_codes.empty()) time_codes.push_back(layer.start_time_code);
  for (const double code : time_codes) {
    track.times.push_back((code - layer.start_time_code) / layer.time_codes_per_second);
    if (!std::isfinite(track.times.back())) prim.place.fail("the times of its samples overflow in seconds");
    track.transforms.push_back(world_transform(stage, path, code));
  }
  if (prim.type == "Mesh" && prim.find("points") != nullptr) bound_points(*prim.find("points"), track);
  if (prim.type == "Sphere") bound_sphere(prim, track);
  return track;
}

namespace {

/// Returns true for a Mesh that its skeleton or its points move.
bool deforms(const UsdPath& path) {
  if (path.back()->type != "Mesh") return false;
  const UsdAttribute* points = path.back()->find("points");
  return (points != nullptr && points->samples.size() > 1) || UsdSkin::is_on(path);
}

}  // namespace

TransformTrack read_usd_motion(const SourceText& source) {
  const UsdStage stage(source);
  return read_usd_track(stage, moving_prim(stage));
}

TransformTrack read_usd_motion(const std::filesystem::path& file) { return read_usd_motion(SourceText::read(file)); }

std::shared_ptr<const SphereTrack> read_sphere_track(const std::filesystem::path& file) {
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source, {.moving_points = true});
  const UsdPath path = moving_prim(stage);
  const std::vector<UsdPath> shapes = find_prims(stage, {"Mesh"});
  const auto deforming = std::ranges::find_if(shapes, deforms);
  if (deforms(path) || (transform_times(path).empty() && deforming != shapes.end())) {
    const UsdPrim& mesh = deforms(path) ? *path.back() : *deforming->back();
    mesh.place.fail(
        fmt::format("a track moves a sphere, but the Mesh {} changes its shape: use [[effects.body]] with "
                    "file and prim = \"{}\"",
                    in_quotes(mesh.name), escape_controls(mesh.path)));
  }
  TransformTrack track = read_usd_track(stage, path);
  if (track.times.size() < 2) {
    source.fail("nothing moves in the file: expected a Mesh, a Sphere or an Xform with time samples of its transform");
  }
  return std::make_shared<UsdSphereTrack>(std::move(track));
}

}  // namespace drape
