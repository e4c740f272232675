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

/// A film's additions to the rendered image: the caption, the colour bar, and the energy curves. Lives
/// on the drawing thread; survey() is called earlier, by the thread that simulates.
class Annotations {
 public:
  /// @throws OutputError if no font for the text is installed
  explicit Annotations(const Scene& scene);

  /// Returns true if the scene asks for any annotation.
  static bool wanted(const Scene& scene);
  /// Returns the size of the film's pictures, with the bands below the drawing [pixels].
  static Eigen::Vector2i film_size(const Scene& scene);
  /// Returns the scene's look for the renderer: a cloth coloured by vertex gets no texture.
  static Look look(const Scene& scene);

  /// Returns the frame data that the annotations need.
  [[nodiscard]] FrameContents contents() const;

  /// Returns true if the whole motion must be surveyed before the first frame is drawn.
  [[nodiscard]] bool needs_motion() const;
  /// Adds the next frame of the whole motion to the survey.
  void survey(const Frame& frame);

  /// Returns one colour per vertex of the frame; empty if the cloth keeps its own colour.
  [[nodiscard]] std::vector<Rgb> colors(const Frame& frame) const;

  /// Returns the film's picture of a frame.
  /// @param drawn the renderer's image
  [[nodiscard]] Image annotate(Image drawn, const Frame& frame);

 private:
  const Scene& scene_;
  Pen pen_;
  std::optional<VertexColoring> coloring_;
  std::vector<double> times_;        // times of the surveyed frames [s]
  std::vector<Curve> energies_;      // energies of the surveyed frames [J]
  std::optional<CurveBand> curves_;  // made when the first frame is drawn
  std::optional<Image> bar_;         // made when the first frame is drawn
};

}  // namespace drape
