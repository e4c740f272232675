#pragma once

#include <array>
#include <optional>
#include <vector>

#include "overlay/curve_band.hpp"
#include "overlay/pen.hpp"
#include "overlay/vertex_coloring.hpp"
#include "run/frame_sampler.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What a scene's film shows beside what the scene looks like: the caption, what the colours of its vertices mean, and
/// the curves of its energies. Made and used on the thread that draws, but for survey(), which comes before.
class Annotations {
 public:
  /// @throws OutputError where there is no font for its text
  explicit Annotations(const Scene& scene);

  /// Whether a scene asks for any.
  static bool wanted(const Scene& scene);
  /// The size of its film's pictures: bands stand below what is drawn [pixels].
  static Eigen::Vector2i film_size(const Scene& scene);
  /// What the renderer is to draw: a cloth that has its colours from its vertices has no texture.
  static Look look(const Scene& scene);

  /// What the frames must hold.
  [[nodiscard]] FrameContents contents() const;

  /// Whether the whole motion must be seen before the first frame is drawn.
  [[nodiscard]] bool needs_motion() const;
  /// The next frame of the whole motion.
  void survey(const Frame& frame);

  /// Of the frame's vertices; none: the cloth has its own.
  [[nodiscard]] std::vector<Rgb> colors(const Frame& frame) const;

  /// The film's picture of a frame.
  /// @param drawn as the renderer has drawn it
  [[nodiscard]] Image annotate(Image drawn, const Frame& frame);

 private:
  const Scene& scene_;
  Pen pen_;
  std::optional<VertexColoring> coloring_;
  std::vector<double> times_;        // of what was surveyed
  std::vector<Curve> energies_;      // likewise
  std::optional<CurveBand> curves_;  // made when the first frame is drawn
  std::optional<Image> bar_;         // likewise
};

}  // namespace drape
