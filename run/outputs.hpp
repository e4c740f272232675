#pragma once

#include <array>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drape/render/image.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/render/renderer.hpp"
#include "drape/scene/scene.hpp"
#include "output/png_encoder.hpp"
#include "output/registry.hpp"
#include "render/camera_path.hpp"
#include "render/overlay/color_scale.hpp"
#include "render/overlay/diagrams.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Returns the properties of a scene's film that its camera needs.
/// @param size  of the pictures [pixels]
/// @param count number of frames
/// @param pass  see KnownFilm::pass; called only if the camera needs the motion
inline KnownFilm known_film(const Scene& scene, const Eigen::Vector2i& size, int count,
                            decltype(KnownFilm::pass) pass) {
  return {.aspect = static_cast<double>(size.x()) / size.y(),
          .fps = scene.video.fps,
          .count = count,
          .triangles = scene.simulation.cloth.triangles,
          .start = scene.simulation.cloth.positions,
          .look = scene.look,
          .pass = std::move(pass)};
}

/// A film's additions to the rendered image: the caption, the colour bar, and the energy curves. Lives
/// on the drawing thread; survey() is called earlier, by the thread that simulates.
class Annotations {
 public:
  /// @throws OutputError if no font for the text is installed
  explicit Annotations(const LoadedScene& scene);

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

/// A film's poster: the picture of its PosterFrame.
class Poster {
 public:
  explicit Poster(const FilmInfo& film) : frames_(film.triangles()) {}

  void see(const Frame& frame, const Image& image);

  /// Returns the poster; absent until the first frame was seen.
  [[nodiscard]] const std::optional<Image>& image() const { return image_; }
  [[nodiscard]] int frame() const { return frame_; }

 private:
  PosterFrame frames_;
  std::optional<Image> image_;
  int frame_ = 0;
};

/// Returns the names of the posters of these outputs: "film.poster.png" beside each film that is drawn.
std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film);

/// Returns the times of the frames that a run of a scene shows.
/// @throws UsageError if the motion has no such frames
FilmExtent film_extent(const Scene& scene, const RunOptions& options);

/// Returns the same for the whole motion, ignoring a range of frames.
FilmExtent whole_extent(const Scene& scene, RunOptions options);

/// Returns the properties of a run's film known before its first frame. Refers to the scene's cloth and look.
/// @param progress if not null, shows the progress of encoding at the end
/// @throws UsageError as film_extent()
FilmInfo film_info(const Scene& scene, const RunOptions& options, Progress* progress = nullptr);

/// Returns true if any of a run's outputs needs rendering.
bool needs_drawing(const RunOptions& options);

/// Checks that all outputs of a run can be opened, and leaves no file behind.
/// @throws Error the same error as the run would, perhaps after hours
void require_outputs(const Scene& scene, const RunOptions& options);

/// Checks the texture of a scene that is to be drawn, if it has one.
/// @param largest the largest width and height of a texture [pixels]
/// @throws UsageError that names the place in the scene
void require_texture(const LoadedScene& scene, int largest = largest_texture);

/// A frame on its way to the outputs.
struct FilmFrame {
  Frame frame;
  std::optional<Image> image;  ///< absent if no output needs the rendered image
};

/// The outputs of a run. A failed output is given up; the others continue.
class Outputs {
 public:
  /// @param poster true to add a poster to each film that is drawn
  /// @param start_at_poster true to begin looping films with the poster's frame; their pictures stay in memory until
  /// the end
  /// @throws UsageError, OutputError as make_sink()
  Outputs(const std::vector<std::string>& paths, const FilmInfo& film, bool poster = false,
          bool start_at_poster = false);

  /// Returns true if no output takes frames (any more).
  [[nodiscard]] bool none() const;

  /// Returns true if any output (still) takes images.
  [[nodiscard]] bool drawn() const;

  /// Returns true if any output needs the image of this frame (counted from 0 in the film). The
  /// answer never changes; any thread may ask.
  [[nodiscard]] bool needs_picture(int index) const;

  /// Returns the frame data that the outputs need.
  [[nodiscard]] FrameContents contents() const;

  /// @param frame with its image, if any output takes images
  void add(const FilmFrame& frame);

  /// Completes all outputs that did not fail.
  /// @returns the files of each completed output, in order
  std::vector<std::vector<OutputFile>> finish(Ending ending);

  /// Returns a message for each output that was given up.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Output {
    std::string path;
    std::optional<AnySink> sink;  ///< absent if it was given up
    bool held = false;            ///< true: gets its pictures at the end, beginning with the poster's
  };
  template <class AnyOf>
  [[nodiscard]] bool any_is() const;
  template <class Work>
  void attempt(Output& output, Work work);

  void hold_loops(const FilmInfo& film);
  void release(Encoder& encoder) const;
  /// @returns the files written
  std::vector<OutputFile> write_poster(const std::string& file, Ending ending);

  std::vector<Output> outputs_;
  std::vector<bool> pictures_;  // for each frame of the film: true if any output needs its image
  std::optional<Poster> poster_;
  std::vector<std::string> poster_files_;
  std::vector<Image> held_;       // the film's images
  std::size_t poster_place_ = 0;  // index of the poster among them
  std::vector<std::string> problems_;
};

/// Painter of a film's pictures, with the scene's annotations. Lives on the thread that owns the OpenGL context.
class FilmPainter {
 public:
  /// @param annotations absent if the scene asks for none
  FilmPainter(const Scene& scene, const CameraPath& path, std::optional<Annotations>& annotations, GlBackend backend)
      : path_(path),
        annotations_(annotations),
        renderer_(data_folder(), scene.video.size, path.at(0), Annotations::look(scene),
                  scene.simulation.cloth.vertex_count(), scene.simulation.cloth.triangles, scene.uvs, backend) {
    renderer_.set_weave(scene.simulation.cloth.rest, scene.uvs);
  }

  [[nodiscard]] std::string description() const { return renderer_.description(); }

  /// Starts painting a frame; returns the one before it with its picture, if that is not finished.
  std::optional<FilmFrame> start(Frame frame) {
    renderer_.look_from(path_.at(frame.index));
    const std::vector<Rgb> colors = annotations_ ? annotations_->colors(frame) : std::vector<Rgb>();
    std::optional<Image> drawn = colors.empty() ? renderer_.start(frame) : renderer_.start(frame, colors);
    std::optional<Frame> previous = std::exchange(started_, std::move(frame));
    return annotated(std::move(previous), std::move(drawn));
  }

  /// Returns the frame started last with its picture, if it is not finished.
  std::optional<FilmFrame> finish() { return annotated(std::exchange(started_, {}), renderer_.finish()); }

 private:
  std::optional<FilmFrame> annotated(std::optional<Frame> frame, std::optional<Image> drawn) {
    if (!frame || !drawn) return std::nullopt;
    Image image = annotations_ ? annotations_->annotate(std::move(*drawn), *frame) : std::move(*drawn);
    return FilmFrame{std::move(*frame), std::move(image)};
  }

  const CameraPath& path_;
  std::optional<Annotations>& annotations_;
  Renderer renderer_;
  std::optional<Frame> started_;  // not finished
};

}  // namespace drape
