#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "drape/core/rgb.hpp"
#include "drape/render/settings.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"
#include "render/overlay/diagrams.hpp"

namespace drape {

/// Maps numbers from 0 to a limit to the colours of viridis(). The default limit is the smallest 1, 2 or 5 times a
/// power of ten that 95 % of the vertices stay below in nine of ten frames. So neither the few vertices of a sharp fold
/// nor a short impact press all others into one colour.
class ColorScale {
 public:
  explicit ColorScale(std::optional<double> limit) : limit_(limit) {}

  /// Returns true if the whole motion must be surveyed before the first frame is coloured.
  [[nodiscard]] bool needs_motion() const { return !limit_; }
  /// Surveys the numbers of the next frame.
  void survey(Eigen::VectorXd values);

  /// Returns the value of the last colour.
  [[nodiscard]] double limit() const;
  [[nodiscard]] std::vector<Rgb> colors(const Eigen::VectorXd& values) const;
  /// Returns the marks of a colour bar, at positions from 0 to 1.
  /// @param factor factor of the labels' numbers: 100 for percent
  [[nodiscard]] std::vector<Tick> marks(double factor) const;

 private:
  std::optional<double> limit_;
  std::vector<double> seen_;  // 95 % quantile of each frame
};

/// Returns a colour of "viridis", from dark blue (0) to yellow (1). Equal steps look equal, and remain distinct with
/// any kind of colour vision and in grey (S. van der Walt and N. Smith 2015, https://bids.github.io/colormap, public
/// domain). Values beyond 0 and 1 get the colours of the ends.
Rgb viridis(double value);

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
