#include <fmt/format.h>

#include <algorithm>

#include "import/sources.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/mesh.hpp"
#include "scene/usd/motion.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// The spheres of a stage at the times of a motion. One keeps the radius that it has first.
ImportedShapes spheres_of(const UsdStage& stage, const std::vector<double>& times) {
  ImportedShapes spheres;
  std::vector<TransformTrack> tracks;
  for (const UsdPath& path : find_prims(stage, {"Sphere"})) tracks.push_back(read_usd_track(stage, path));
  if (tracks.empty()) return spheres;
  for (const double time : times) {
    auto& row = spheres.by_moment.emplace_back();
    for (const TransformTrack& track : tracks) {
      const SphereShape sphere = track.sphere_at(time);
      row.emplace_back(sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius);
    }
  }
  return spheres;
}

/// A mesh with samples of its points.
class UsdMotion final : public MotionSource {
 public:
  UsdMotion(std::string name, MeshMotion motion, double times_per_second)
      : name_(std::move(name)), motion_(std::move(motion)), rate_(times_per_second) {
    require_finite(name_, motion_.mesh.positions);
  }

  std::vector<std::shared_ptr<MotionSource>> bodies;
  ImportedShapes spheres;

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] const Mesh& mesh() const override { return motion_.mesh; }
  [[nodiscard]] std::size_t count() const override { return std::max<std::size_t>(1, motion_.samples.size()); }
  [[nodiscard]] std::vector<double> times() override { return motion_.times; }
  [[nodiscard]] std::optional<double> fps() override { return rate_; }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    if (motion_.samples.empty()) return {.x = motion_.mesh.positions};
    require_finite(fmt::format("{}: sample {}", name_, i), motion_.samples[i]);
    return {.x = motion_.samples[i]};
  }
  [[nodiscard]] ImportedColliders colliders() override { return {.spheres = spheres, .grounds = {}, .bodies = bodies}; }

 private:
  std::string name_;
  MeshMotion motion_;
  double rate_;
};

}  // namespace

std::unique_ptr<MotionSource> open_usd(const fs::path& file, const std::string& prim) {
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source, {.moving_points = true});
  const double rate = stage.layer().time_codes_per_second;
  const std::string name = file.string();
  std::vector<UsdPath> meshes = find_prims(stage, {"Mesh"});
  std::string chosen = prim;
  for (const UsdPath& mesh : meshes) {
    if (chosen.empty() && meshes.size() > 1 && mesh.back()->name == "Cloth") chosen = mesh.back()->path;
  }
  auto motion = std::make_unique<UsdMotion>(name, read_usd_mesh_motion(stage, chosen), rate);
  const std::vector<double> times = motion->times();
  motion->spheres = spheres_of(stage, times.empty() ? std::vector<double>{0} : times);
  if (!prim.empty() || chosen.empty()) return motion;
  for (const UsdPath& mesh : meshes) {
    const std::string& path = mesh.back()->path;
    if (path == chosen) continue;
    motion->bodies.push_back(std::make_shared<UsdMotion>(name, read_usd_mesh_motion(stage, path), rate));
  }
  return motion;
}

}  // namespace drape
