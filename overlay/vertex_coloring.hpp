#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "overlay/color_scale.hpp"
#include "render/settings.hpp"
#include "sim/cloth.hpp"
#include "sim/frame.hpp"
#include "sim/vertex_curvature.hpp"
#include "sim/vertex_stretch.hpp"

namespace drape {

/// What the colours of a cloth's vertices can show.
class VertexMeasure {
 public:
  VertexMeasure(ColorBy what, const Cloth& cloth);

  /// Whether the frames must have velocities.
  [[nodiscard]] bool needs_velocities() const { return what_ == ColorBy::speed; }
  /// Of each vertex: by how much it is stretched (0: not at all), its speed [m/s], its curvature [1/m].
  [[nodiscard]] Eigen::VectorXd operator()(const Frame& frame) const;
  /// With the unit: "speed [m/s]".
  [[nodiscard]] std::string title() const;
  /// Of a number in that unit to one of those above.
  [[nodiscard]] double factor() const { return what_ == ColorBy::stretch ? 100 : 1; }

 private:
  ColorBy what_;
  VertexStretch stretch_;
  VertexCurvature curvature_;
};

/// The colours of a cloth's vertices that show something about them.
class VertexColoring {
 public:
  VertexColoring(ColorBy what, std::optional<double> limit, const Cloth& cloth)
      : measure_(what, cloth), scale_(limit) {}

  [[nodiscard]] const VertexMeasure& measure() const { return measure_; }
  [[nodiscard]] const ColorScale& scale() const { return scale_; }

  /// The next frame of the whole motion, see ColorScale.
  void survey(const Frame& frame) { scale_.survey(measure_(frame)); }
  [[nodiscard]] std::vector<Rgb> colors(const Frame& frame) const { return scale_.colors(measure_(frame)); }
  /// The bar's marks.
  [[nodiscard]] std::vector<Tick> marks() const { return scale_.marks(measure_.factor()); }

 private:
  VertexMeasure measure_;
  ColorScale scale_;
};

}  // namespace drape
