#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "output/make_sink.hpp"
#include "render/texture_image.hpp"
#include "run/poster.hpp"
#include "run/run_scene.hpp"

namespace drape {

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
void require_texture(const Scene& scene, int largest = largest_texture);

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

}  // namespace drape
