#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "scene/usd/stage.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// How a skeleton moves the points of a mesh: linear blend skinning as UsdSkel defines it, without blend shapes,
///   p' = W Σⱼ wⱼ Sⱼ Bⱼ⁻¹ G p / Σⱼ wⱼ,
/// where G is geomBindTransform, B the joint's bindTransform, S its place in the skeleton (of its parents' and its own
/// translation, rotation and scale in the SkelAnimation, or its restTransform where that does not move it), and W takes
/// the skeleton's coordinates to the world. The mesh's own transform plays no part.
/// See https://openusd.org/release/api/_usd_skel__schema_overview.html
class UsdSkin {
 public:
  /// Whether a mesh has one.
  static bool is_on(const UsdPath& mesh);

  /// The skin of a mesh; nothing if it has none. Skeleton, joints and weights may be its ancestors'.
  /// @throws UsageError "file:line:column: message"
  static std::optional<UsdSkin> of(const UsdStage& stage, const UsdPath& mesh);

  /// The times [time codes] at which something on the skeleton, its ancestors or its animation has a sample.
  [[nodiscard]] std::vector<double> times() const;

  /// From the skeleton's coordinates to the world's, after geomBindTransform: which side of the mesh is its front.
  [[nodiscard]] Eigen::Affine3d bound_to_world(double time) const;

  /// Writes where points are at a time [time codes], in the world [m].
  /// @param points x, y, z of each, in the mesh's own coordinates
  void pose(double time, const std::vector<double>& points, Vertices& x) const;

 private:
  struct Influence {
    std::size_t joint = 0;
    double weight = 0;
  };

  UsdSkin(const UsdStage& stage, UsdPath skeleton) : stage_(&stage), skeleton_(std::move(skeleton)) {}
  void read_skeleton();
  void read_animation();
  void read_influences(const UsdPath& mesh);
  [[nodiscard]] std::vector<Eigen::Affine3d> joints_at(double time) const;

  const UsdStage* stage_;
  UsdPath skeleton_;
  std::vector<std::string> joints_;
  std::vector<std::optional<std::size_t>> parents_;  // of each joint, which may stand behind it
  std::vector<Eigen::Affine3d> unbind_, rest_;       // of each joint: Bⱼ⁻¹, and its rest place beside its parent's
  const UsdPrim* animation_ = nullptr;
  std::vector<std::optional<std::size_t>> animated_;  // for each joint its place in the animation
  Eigen::Affine3d geometry_ = Eigen::Affine3d::Identity();
  bool rigid_ = false;  // all points have the influences of the first
  std::size_t per_point_ = 1;
  std::vector<Influence> influences_;  // per_point_ for each point
};

}  // namespace drape
