#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "check/golden.hpp"
#include "check/report.hpp"
#include "drape/render/renderer.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "output/gif_encoder.hpp"
#include "reports/players.hpp"
#include "run/progress.hpp"

namespace drape {

/// Properties of a film's frame for the choice of compared frames.
struct FrameProperties {
  std::uint64_t touched = 0;        ///< bit k: the cloth is within the contact range of body k
  std::size_t pins = 0;             ///< number of pinned vertices
  double kinetic = 0, elastic = 0;  ///< energies [J]
  double area = 0;    ///< area of the triangles projected towards the camera, without perspective or occlusion [m²]
  double change = 0;  ///< summed vertex movement across the picture since the previous frame [m]
};

/// Properties of all frames of a film.
struct FilmFacts {
  std::vector<std::string> bodies;      ///< "the sphere", "ground 2"
  std::vector<FrameProperties> frames;  ///< from frame 0
};

/// A frame to compare, with the reason.
struct ChosenFrame {
  int frame = 0;
  std::string why;  ///< "first contact with the sphere"
};

/// Chooses the significant frames of a film: start, first contact with each body, releases of pins, largest change of
/// the picture, extremes of energy and screen area. An event close to a chosen frame is added to its reason. At most
/// twelve, ascending.
std::vector<ChosenFrame> choose_frames(const FilmFacts& film);

/// Renderer of moments of a scene's motion, as in its film. Create and use it on one thread.
class DrawFrames {
 public:
  /// @throws UsageError, OutputError as Renderer
  DrawFrames(const Scene& scene, const Eigen::Vector2i& size, GlBackend backend);

  /// Returns a description of the renderer.
  [[nodiscard]] std::string renderer() const { return renderer_.description(); }

  /// Draws one picture.
  Image draw(const View& view, int frame, double time, const Vertices& positions);

  /// Draws a picture of each frame; fewer if stopped.
  std::vector<Png> draw(const std::vector<GoldenFrame>& frames, const std::stop_token& stop, Progress& progress);

  /// Draws frames and compares each with its golden picture.
  /// @param frames of the golden or of a new motion, each with the hash of its golden picture
  /// @param folder of the golden
  /// @returns a result for each frame; fewer if stopped
  /// @throws UsageError if a golden picture is missing or modified
  std::vector<FrameResult> compare(const std::vector<GoldenFrame>& frames, const std::filesystem::path& folder,
                                   const CheckSettings& settings, const std::stop_token& stop, Progress& progress);

 private:
  Simulation simulation_;  // gives the positions of colliders
  Renderer renderer_;
};

class PlayedMotion;

/// A film of a difference; without bytes if there is none.
struct DifferenceAnimation {
  PageFilm film;
  html::PlayedMotion expected, actual;  ///< states of a changed motion, for interactive viewing
};

/// Makes a looping GIF with expected picture, actual picture and difference side by side. For a changed motion it shows
/// the compared steps of the first changed windows, otherwise the compared frames around the first changed picture.
/// @param folder  of the report; the file is NAME/difference.gif
/// @throws OutputError
DifferenceAnimation difference_animation(const Scene& scene, const Golden& golden, const SceneResult& result,
                                         PlayedMotion* recorded, GlBackend backend,
                                         const std::filesystem::path& folder);

}  // namespace drape
