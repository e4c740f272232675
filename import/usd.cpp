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

/// A file that is open: its text, and what it says beside the samples of points.
struct OpenStage {
  SourceText source;
  UsdStage stage;

  explicit OpenStage(const fs::path& file)
      : source(SourceText::read(file)), stage(source, {.moving_points = true, .located_points = true}) {}
};

/// A mesh whose points are read a sample at a time.
class UsdMotion final : public MotionSource {
 public:
  UsdMotion(std::string name, std::shared_ptr<const OpenStage> open, const std::string& prim)
      : name_(std::move(name)), open_(std::move(open)), moving_(open_->stage, prim) {
    require_finite(name_, moving_.mesh().positions);
  }

  std::vector<std::shared_ptr<MotionSource>> bodies;
  ImportedShapes spheres;

  [[nodiscard]] const std::string& name() const override { return name_; }
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
  [[nodiscard]] ImportedColliders colliders() override { return {.spheres = spheres, .grounds = {}, .bodies = bodies}; }

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
  const std::vector<double> times = motion->times();
  motion->spheres = spheres_of(stage, times.empty() ? std::vector<double>{0} : times);
  if (!prim.empty() || chosen.empty()) return motion;
  for (const UsdPath& mesh : meshes) {
    const std::string& path = mesh.back()->path;
    if (path != chosen) motion->bodies.push_back(std::make_shared<UsdMotion>(name, open, path));
  }
  return motion;
}

}  // namespace drape
