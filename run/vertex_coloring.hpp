#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "overlay/axis_ticks.hpp"
#include "render/settings.hpp"
#include "run/frame_sampler.hpp"
#include "sim/cloth.hpp"
#include "sim/vertex_curvature.hpp"
#include "sim/vertex_stretch.hpp"

namespace drape {

/// The colours of a cloth's vertices that show something about them, from 0 up to a limit: that of the scene, or else
/// the smallest of 1, 2 and 5 times a power of ten that 95 % of the vertices stay below in every frame of the motion.
/// So a few vertices in the sharpest fold do not leave all others in one colour.
class VertexColoring {
 public:
  VertexColoring(ColorBy what, std::optional<double> limit, const Cloth& cloth);

  /// What the frames must hold.
  [[nodiscard]] FrameContents contents() const;

  /// Whether the motion must be seen before the first frame is coloured.
  [[nodiscard]] bool needs_motion() const { return !limit_; }
  /// The next frame of the whole motion.
  void survey(const Frame& frame);

  /// n colours of viridis().
  [[nodiscard]] std::vector<Rgb> colors(const Frame& frame) const;

  /// What the colours stand for, with the unit: "speed [m/s]".
  [[nodiscard]] std::string title() const;
  /// The bar's marks, at places from 0 to 1.
  [[nodiscard]] std::vector<Tick> marks() const;

  /// What is shown, of each vertex: by how much it is stretched (0: not at all), its speed [m/s], its curvature [1/m].
  [[nodiscard]] Eigen::VectorXd values(const Frame& frame) const;
  /// The value of the last colour.
  [[nodiscard]] double limit() const;

 private:
  ColorBy what_;
  std::optional<double> limit_;
  double seen_ = 0;  // the largest of what 95 % of the vertices of a frame stay below
  VertexStretch stretch_;
  VertexCurvature curvature_;
};

}  // namespace drape
