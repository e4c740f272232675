#include <fmt/format.h>
#include <algorithm>

#include "motion/import/import_motion.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/mesh.hpp"
#include "scene/usd/motion.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// Returns the shapes of all prims of a type at the given times.
template <class Row>
ImportedShapes shapes_of(const UsdStage& stage, const char* type, const std::vector<double>& times, Row row_of) {
  ImportedShapes shapes;
  std::vector<std::pair<UsdPath, TransformTrack>> tracks;
  for (const UsdPath& path : find_prims(stage, {type})) tracks.emplace_back(path, read_usd_track(stage, path));
  if (tracks.empty()) return shapes;
  for (const double time : times) {
    auto& row = shapes.by_moment.emplace_back();
    for (const auto& [path, track] : tracks) row.push_back(row_of(*path.back(), track, time));
  }
  return shapes;
}

/// Returns the spheres of a stage.
ImportedShapes spheres_of(const UsdStage& stage, const std::vector<double>& times) {
  return shapes_of(stage, "Sphere", times, [](const UsdPrim&, const TransformTrack& track, double time) {
    const SphereShape sphere = track.sphere_at(time);
    return Eigen::Vector4d(sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius);
  });
}

/// Returns the axis of its own that a Plane is perpendicular to.
Eigen::Vector3d axis_of(const UsdPrim& plane) {
  const UsdAttribute* axis = plane.find("axis");
  if (axis == nullptr || axis->first() == nullptr) return Eigen::Vector3d::UnitZ();
  const std::vector<std::string>& names = axis->first()->strings;
  for (int i = 0; i < 3; ++i) {
    if (names.size() == 1 && names[0] == std::string(1, "XYZ"[i])) return Eigen::Vector3d::Unit(i);
  }
  axis->first()->place.fail("axis: expected \"X\", \"Y\" or \"Z\"");
}

/// Returns the planes of a stage as infinite grounds, as rigid-body simulators treat them.
ImportedShapes grounds_of(const UsdStage& stage, const std::vector<double>& times) {
  return shapes_of(stage, "Plane", times, [](const UsdPrim& plane, const TransformTrack& track, double time) {
    const Eigen::Affine3d to_world = track.at(time);
    // Normals transform by the inverse transpose.
    const Eigen::Vector3d normal = (to_world.linear().inverse().transpose() * axis_of(plane)).normalized();
    if (!normal.allFinite()) plane.place.fail("its transform leaves no plane of it");
    return Eigen::Vector4d(normal.x(), normal.y(), normal.z(), normal.dot(to_world.translation()));
  });
}

/// An open file, without its point samples, which stay on disk.
struct OpenStage {
  SourceText source;
  UsdStage stage;

  explicit OpenStage(const fs::path& file)
      : source(SourceText::open(file)), stage(source, {.moving_points = true, .located_points = true}) {}
};

/// A mesh whose points are read one sample at a time.
class UsdMotion final : public MotionSource {
 public:
  UsdMotion(std::string name, std::shared_ptr<const OpenStage> open, const std::string& prim)
      : name_(std::move(name)), open_(std::move(open)), moving_(open_->stage, prim) {
    require_finite(name_, moving_.mesh().positions);
  }

  std::vector<std::shared_ptr<MotionSource>> bodies;
  ImportedShapes spheres, grounds;

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<fs::path> files() const override {
    std::vector<fs::path> all = open_->stage.referenced_files();
    all.emplace_back(name_);
    return all;
  }
  [[nodiscard]] const Mesh& mesh() const override { return moving_.mesh(); }
  [[nodiscard]] std::size_t count() const override { return std::max<std::size_t>(1, moving_.times().size()); }
  [[nodiscard]] std::vector<double> times() override { return moving_.times(); }
  [[nodiscard]] std::optional<double> fps() override { return open_->stage.layer().time_codes_per_second; }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    if (moving_.times().empty()) return {.x = mesh().positions};
    ImportedMoment moment{.x = moving_.points(i)};
    require_finite(fmt::format("{}: sample {}", name_, i), moment.x);
    return moment;
  }
  [[nodiscard]] ImportedColliders colliders() override {
    return {.spheres = spheres, .grounds = grounds, .bodies = bodies};
  }

 private:
  std::string name_;
  std::shared_ptr<const OpenStage> open_;
  UsdMovingMesh moving_;
};

}  // namespace

std::unique_ptr<MotionSource> open_usd(const fs::path& file, const std::string& prim) {
  const auto open = std::make_shared<const OpenStage>(file);
  const UsdStage& stage = open->stage;
  const std::string name = file.string();
  const std::vector<UsdPath> meshes = find_prims(stage, {"Mesh"});
  std::string chosen = prim;
  for (const UsdPath& mesh : meshes) {
    if (chosen.empty() && meshes.size() > 1 && mesh.back()->name == "Cloth") chosen = mesh.back()->path;
  }
  auto motion = std::make_unique<UsdMotion>(name, open, chosen);
  std::vector<double> times = motion->times();
  if (times.empty()) times.push_back(0);
  motion->spheres = spheres_of(stage, times);
  motion->grounds = grounds_of(stage, times);
  if (!prim.empty() || chosen.empty()) return motion;
  for (const UsdPath& mesh : meshes) {
    const std::string& path = mesh.back()->path;
    if (path != chosen) motion->bodies.push_back(std::make_shared<UsdMotion>(name, open, path));
  }
  return motion;
}

}  // namespace drape
