#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/compare_scenes.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/render/renderer.hpp"
#include "drape/scene/scene.hpp"
#include "render/overlay/color_scale.hpp"

namespace drape {

/// Vertex colours in all panels of a comparison, on a common scale. They show distances to the first scene's vertices,
/// or the first scene's Look::color_by. Otherwise there are none.
///
/// Distances have a logarithmic scale of three decades, so that small ones are visible. The scale ends at the smallest
/// 1, 2 or 5 times 10ⁿ that exceeds 95 % of the cloth's distances in 90 % of the frames.
class PanelColors {
 public:
  /// @param difference true to show distances
  /// @param limit      distance at the end of the scale [m]; absent: automatic
  PanelColors(const std::vector<LoadedScene>& scenes, const std::vector<std::string>& labels, bool difference,
              std::optional<double> limit);

  [[nodiscard]] bool wanted() const { return scale_.has_value(); }
  [[nodiscard]] bool needs_motion() const { return scale_ && scale_->needs_motion(); }
  /// Adds the next frame of all motions to the data that set the scale's limit.
  void survey(const std::vector<const Frame*>& frames);
  /// Returns the colours of a panel's vertices; empty: the scene's own look.
  [[nodiscard]] std::vector<Rgb> colors(const std::vector<const Frame*>& frames, std::size_t panel) const;
  /// Draws the colour bar below all panels.
  [[nodiscard]] Image bar(Pen& pen, int width, int size) const;

 private:
  [[nodiscard]] Eigen::VectorXd values(const std::vector<const Frame*>& frames, std::size_t panel) const;
  [[nodiscard]] Image distance_bar(Pen& pen, int width, int size) const;

  bool difference_;
  std::string first_;                    // label of the first scene
  std::vector<VertexMeasure> measures_;  // measures by scene; empty if distances are shown
  std::vector<VertexMatch> matches_;     // matches by scene, if distances are shown
  std::optional<ColorScale> scale_;
};

/// The layout of panels in a picture, with their headings, the time and the colour bar.
class PanelLayout {
 public:
  /// @param columns of the grid; 0: automatic
  /// @param extra   lines in each heading below its label
  /// @throws UsageError if the grid is too small
  PanelLayout(Pen& pen, const std::vector<std::string>& labels, const Eigen::Vector2i& panel, int columns, int rows,
              int extra, bool bar);

  /// Returns the size of the whole picture [pixels].
  [[nodiscard]] Eigen::Vector2i size() const;
  [[nodiscard]] int text_size() const { return text_; }

  /// Composes panel pictures with headings above, time and colour bar below.
  /// @param extra an additional heading line for each panel, or empty
  [[nodiscard]] Image compose(Pen& pen, const std::vector<Image>& panels, const std::vector<std::string>& extra,
                              const std::string& time, const std::optional<Image>& bar) const;

 private:
  [[nodiscard]] Image under_head(Pen& pen, const Image& panel, const std::vector<std::string>& lines) const;
  [[nodiscard]] int head_height() const;
  [[nodiscard]] int foot_height() const;

  std::vector<std::vector<std::string>> heads_;  // lines of the labels
  Eigen::Vector2i panel_;
  int columns_, rows_, text_, lines_ = 0;
  bool bar_;
};

/// Returns the distances of vertices from those of another frame [m].
/// @param order indices of the vertices in the other frame; empty: equal indices
Eigen::VectorXd distances(const Frame& frame, const Frame& other, const VertexOrder& order = {});

}  // namespace drape
