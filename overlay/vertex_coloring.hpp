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

/// A quantity of a cloth's vertices that colours can show.
class VertexMeasure {
 public:
  VertexMeasure(ColorBy what, const Cloth& cloth);

  /// Returns true if the frames must have velocities.
  [[nodiscard]] bool needs_velocities() const { return what_ == ColorBy::speed; }
  /// Returns each vertex's relative stretch (0: none), speed [m/s] or curvature [1/m].
  [[nodiscard]] Eigen::VectorXd operator()(const Frame& frame) const;
  /// Returns the name with its unit: "speed [m/s]".
  [[nodiscard]] std::string title() const;
  /// Returns the factor from values to numbers in that unit.
  [[nodiscard]] double factor() const { return what_ == ColorBy::stretch ? 100 : 1; }

 private:
  ColorBy what_;
  VertexStretch stretch_;
  VertexCurvature curvature_;
};

/// Colours of a cloth's vertices for one quantity.
class VertexColoring {
 public:
  VertexColoring(ColorBy what, std::optional<double> limit, const Cloth& cloth)
      : measure_(what, cloth), scale_(limit) {}

  [[nodiscard]] const VertexMeasure& measure() const { return measure_; }
  [[nodiscard]] const ColorScale& scale() const { return scale_; }

  /// Surveys the next frame of the whole motion, see ColorScale.
  void survey(const Frame& frame) { scale_.survey(measure_(frame)); }
  [[nodiscard]] std::vector<Rgb> colors(const Frame& frame) const { return scale_.colors(measure_(frame)); }
  /// Returns the marks of the colour bar.
  [[nodiscard]] std::vector<Tick> marks() const { return scale_.marks(measure_.factor()); }

 private:
  VertexMeasure measure_;
  ColorScale scale_;
};

}  // namespace drape
