#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/usd/mesh.hpp"
#include "scene/usd/mesh_prim.hpp"
#include "scene/usd/skin.hpp"
#include "scene/usd/value.hpp"
#include "scene/usd/xform.hpp"

namespace drape {
namespace {

/// Time codes between samples are left out beyond this many of them, which no film has: the samples are far apart.
constexpr double most_between = 10'000;
/// Whole numbers up to it have their neighbours.
constexpr double last_time_code = 1e12;
/// A gigabyte.
constexpr double most_motion_numbers = 1 << 27;

/// A mesh whose points, transform or skeleton move it.
class MovingMesh {
 public:
  MovingMesh(const UsdStage& stage, UsdPath path)
      : stage_(stage), path_(std::move(path)), prim_(*path_.back()), skin_(UsdSkin::of(stage, path_)) {}

  MeshMotion read() {
    const double start = stage_.layer().start_time_code;
    const Eigen::Affine3d to_world = skin_ ? skin_->bound_to_world(start) : world_transform(stage_, path_, start);
    MeshMotion motion{.mesh = read_mesh_prim(prim_, to_world)};
    check_points(motion.mesh.positions.rows());
    const std::vector<double> codes = time_codes();
    if (static_cast<double>(codes.size()) * static_cast<double>(motion.mesh.positions.size()) > most_motion_numbers) {
      prim_.place.fail(fmt::format("{} samples of {} points take too much memory: export fewer of either", codes.size(),
                                   motion.mesh.positions.rows()));
    }
    for (const double code : codes) {
      motion.times.push_back((code - start) / stage_.layer().time_codes_per_second);
      motion.samples.push_back(points_at(code));
      const bool increases = motion.times.size() < 2 || motion.times.back() > motion.times.end()[-2];
      if (!std::isfinite(motion.times.back()) || !increases || !motion.samples.back().allFinite()) {
        prim_.place.fail(fmt::format("at time code {} its motion is beyond what can be computed", code));
      }
    }
    motion.mesh.positions = codes.empty() ? points_at(start) : motion.samples.front();
    if (!motion.mesh.positions.allFinite()) prim_.place.fail("its skeleton takes a point beyond what can be computed");
    if (codes.size() > 1) return motion;
    motion.times.clear();
    motion.samples.clear();
    return motion;
  }

 private:
  void check_points(Eigen::Index expected) const {
    for (const UsdSample& sample : prim_.find("points")->samples) {
      const auto found = static_cast<Eigen::Index>(sample.value.numbers.size() / 3);
      if (found == expected) continue;
      sample.value.place.fail(fmt::format(
          "points: expected {} as in the first sample, found {}: a mesh that moves keeps its points", expected, found));
    }
  }

  /// Those of the samples; where joints or transforms move it, every one in between, so that nothing turns far between
  /// two of them.
  [[nodiscard]] std::vector<double> time_codes() const {
    std::vector<double> codes = skin_ ? skin_->times() : transform_times(path_);
    const bool turns = !codes.empty();
    for (const UsdSample& sample : prim_.find("points")->samples) codes.push_back(sample.time);
    const auto sort = [&] {
      std::sort(codes.begin(), codes.end());
      codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    };
    sort();
    const bool few = turns && codes.front() > -last_time_code && codes.back() < last_time_code;
    if (!few || codes.back() - codes.front() > most_between) return codes;
    const std::size_t samples = codes.size();
    for (std::size_t i = 1; i < samples; ++i) {
      for (double code = std::floor(codes[i - 1]) + 1; code < codes[i]; ++code) codes.push_back(code);
    }
    sort();
    return codes;
  }

  [[nodiscard]] Vertices points_at(double code) const {
    const std::vector<double> points = usd_numbers_at(*prim_.find("points"), code);
    Vertices x;
    if (skin_) {
      skin_->pose(code, points, x);
      return x;
    }
    const Eigen::Affine3d to_world = world_transform(stage_, path_, code);
    x.resize(static_cast<Eigen::Index>(points.size() / 3), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      x.row(i) = (to_world * Eigen::Vector3d(&points[static_cast<std::size_t>(3 * i)])).transpose();
    }
    return x;
  }

  const UsdStage& stage_;
  const UsdPath path_;
  const UsdPrim& prim_;
  const std::optional<UsdSkin> skin_;
};

}  // namespace

MeshMotion read_usd_mesh_motion(const UsdStage& stage, const std::string& prim) {
  return MovingMesh(stage, choose_usd_mesh(stage, prim)).read();
}

MeshMotion read_usd_mesh_motion(const SourceText& source, const std::string& prim) {
  return read_usd_mesh_motion(UsdStage(source, {.moving_points = true}), prim);
}

}  // namespace drape
