#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/differences.hpp"
#include "compare/vertex_matches.hpp"
#include "overlay/color_scale.hpp"
#include "overlay/pen.hpp"
#include "overlay/vertex_coloring.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What the vertices' colours show in all panels of a comparison, on one scale: their distance to the first scene's, or
/// what the first scene's look says; nothing where it says nothing.
class PanelColors {
 public:
  PanelColors(const std::vector<Scene>& scenes, const std::vector<std::string>& labels, bool difference);

  [[nodiscard]] bool wanted() const { return scale_.has_value(); }
  [[nodiscard]] bool needs_motion() const { return scale_ && scale_->needs_motion(); }
  /// The next moment of all motions.
  void survey(const std::vector<const Frame*>& frames);
  /// Of a panel's vertices; none: the cloth looks as its scene says.
  [[nodiscard]] std::vector<Rgb> colors(const std::vector<const Frame*>& frames, std::size_t panel) const;
  /// The bar below all panels.
  [[nodiscard]] Image bar(Pen& pen, int width, int size) const;

 private:
  [[nodiscard]] Eigen::VectorXd values(const std::vector<const Frame*>& frames, std::size_t panel) const;

  bool difference_;
  std::string first_;                    // the first scene's label
  std::vector<VertexMeasure> measures_;  // by scene; empty where distances are shown
  std::vector<VertexMatch> matches_;     // by scene, where distances are shown
  std::optional<ColorScale> scale_;
};

/// How panels stand in a picture, and what stands with them.
class PanelLayout {
 public:
  /// @param columns of the grid; 0: what suits the number of panels
  /// @param extra   lines in each head beside its label
  /// @throws UsageError if the grid is too small
  PanelLayout(Pen& pen, const std::vector<std::string>& labels, const Eigen::Vector2i& panel, int columns, int rows,
              int extra, bool bar);

  /// Of the whole picture [pixels].
  [[nodiscard]] Eigen::Vector2i size() const;
  [[nodiscard]] int text_size() const { return text_; }

  /// Puts pictures of the panels' size under their heads, and what belongs to all of them below.
  /// @param extra for each panel a line more for its head, or none at all
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

/// How far vertices are from where another frame has them [m].
/// @param order the numbers that they have there; empty: the same
Eigen::VectorXd distances(const Frame& frame, const Frame& other, const VertexOrder& order = {});

}  // namespace drape
