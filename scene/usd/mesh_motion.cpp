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

/// Largest span of samples [time codes] that is filled with codes in between; no film is longer.
constexpr double most_between = 10'000;
/// Below this every whole number is exact as a double.
constexpr double last_time_code = 1e12;
/// A gigabyte.
constexpr double most_motion_numbers = 1 << 27;

}  // namespace

/// Reader of a mesh moved by its points, transform or skeleton.
class UsdMovingMesh::Reader {
 public:
  Reader(const UsdStage& stage, UsdPath path)
      : stage_(stage), path_(std::move(path)), prim_(*path_.back()), skin_(UsdSkin::of(stage, path_)) {
    const double start = stage_.layer().start_time_code;
    const Eigen::Affine3d to_world = skin_ ? skin_->bound_to_world(start) : world_transform(stage_, path_, start);
    mesh_ = read_mesh_prim(prim_, to_world);
    check_points();
    codes_ = time_codes();
    for (const double code : codes_) {
      times_.push_back((code - start) / stage_.layer().time_codes_per_second);
      if (std::isfinite(times_.back()) && (times_.size() < 2 || times_.back() > times_.end()[-2])) continue;
      fail_beyond(code);
    }
    mesh_.positions = codes_.empty() ? points_at(start) : points(0);
    if (!mesh_.positions.allFinite()) prim_.place.fail("its skeleton takes a point beyond what can be computed");
    if (codes_.size() < 2) times_.clear();
  }

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] Vertices points(std::size_t i) const {
    Vertices x = points_at(codes_[i]);
    if (!x.allFinite()) fail_beyond(codes_[i]);
    return x;
  }

  /// Returns the whole motion.
  [[nodiscard]] MeshMotion read() const {
    if (static_cast<double>(times_.size()) * static_cast<double>(mesh_.positions.size()) > most_motion_numbers) {
      prim_.place.fail(fmt::format("{} samples of {} points take too much memory: export fewer of either",
                                   times_.size(), mesh_.positions.rows()));
    }
    MeshMotion motion{.mesh = mesh_, .times = times_};
    for (std::size_t i = 0; i < times_.size(); ++i) motion.samples.push_back(points(i));
    return motion;
  }

 private:
  /// Checks the number of points of all samples that are read.
  void check_points() const {
    for (const UsdSample& sample : prim_.find("points")->samples) {
      if (!sample.value.located) check_count(sample, sample.value.numbers.size());
    }
  }

  void check_count(const UsdSample& sample, std::size_t numbers) const {
    const auto found = static_cast<Eigen::Index>(numbers / 3);
    if (found == mesh_.positions.rows()) return;
    sample.value.place.fail(
        fmt::format("points: expected {} as in the first sample, found {}: a mesh that moves keeps its points",
                    mesh_.positions.rows(), found));
  }

  /// Checks the number of points of a located sample: the last one up to a time.
  void check_count_at(double code, std::size_t numbers) const {
    if (static_cast<Eigen::Index>(numbers / 3) == mesh_.positions.rows()) return;
    const UsdSample* found = nullptr;
    for (const UsdSample& sample : prim_.find("points")->samples) {
      if (found == nullptr || sample.time <= code) found = &sample;
    }
    if (found != nullptr) check_count(*found, numbers);
  }

  [[noreturn]] void fail_beyond(double code) const {
    prim_.place.fail(fmt::format("at time code {} its motion is beyond what can be computed", code));
  }

  /// Returns the samples' time codes. Where joints or transforms rotate the mesh, every whole code in between is added,
  /// so that rotations between two samples stay small.
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
    check_count_at(code, points.size());
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
  Mesh mesh_;
  std::vector<double> codes_, times_;  // times of the samples [time codes], [s]
};

UsdMovingMesh::UsdMovingMesh(const UsdStage& stage, const std::string& prim)
    : reader_(std::make_unique<Reader>(stage, choose_usd_mesh(stage, prim))) {}
UsdMovingMesh::~UsdMovingMesh() = default;

const Mesh& UsdMovingMesh::mesh() const { return reader_->mesh(); }
const std::vector<double>& UsdMovingMesh::times() const { return reader_->times(); }
Vertices UsdMovingMesh::points(std::size_t i) const { return reader_->points(i); }

MeshMotion UsdMovingMesh::read() const { return reader_->read(); }

MeshMotion read_usd_mesh_motion(const UsdStage& stage, const std::string& prim) {
  return UsdMovingMesh(stage, prim).read();
}

MeshMotion read_usd_mesh_motion(const SourceText& source, const std::string& prim) {
  return read_usd_mesh_motion(UsdStage(source, {.moving_points = true}), prim);
}

}  // namespace drape
