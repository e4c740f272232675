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

/// Which moments of a scene's motion a run of it shows.
/// @throws UsageError if the motion has no such frames
FilmExtent film_extent(const Scene& scene, const RunOptions& options);

/// The same without a range of frames: what the film of the whole motion shows.
FilmExtent whole_extent(const Scene& scene, RunOptions options);

/// What is known of a run's film before its first frame. Refers to the scene's cloth and look.
/// @param progress if given, shows how much of it is encoded when it ends
/// @throws UsageError as film_extent()
FilmInfo film_info(const Scene& scene, const RunOptions& options, Progress* progress = nullptr);

/// Whether any of a run's outputs must be drawn.
bool needs_drawing(const RunOptions& options);

/// Opens everything that a run would write, and leaves nothing of it.
/// @throws Error what the run would end with otherwise, perhaps after hours
void require_outputs(const Scene& scene, const RunOptions& options);

/// Looks whether the texture of a scene that is to be drawn can be, if it has one.
/// @param largest the most pixels that a texture may be wide or high
/// @throws UsageError that names the place in the scene
void require_texture(const Scene& scene, int largest = largest_texture);

/// A frame on its way to the outputs.
struct FilmFrame {
  Frame frame;
  std::optional<Image> image;  ///< absent: it was not drawn, since nobody needs it
};

/// The outputs of a run. One that cannot be written is given up, and does not keep the others from being completed.
class Outputs {
 public:
  /// @param poster whether each film that is drawn gets one
  /// @param start_at_poster whether films that repeat for ever begin with its frame; their pictures are kept until the
  /// end
  /// @throws UsageError, OutputError as make_sink()
  Outputs(const std::vector<std::string>& paths, const FilmInfo& film, bool poster = false,
          bool start_at_poster = false);

  /// Whether no output takes frames (any more).
  [[nodiscard]] bool none() const;

  /// Whether any (still) takes images.
  [[nodiscard]] bool drawn() const;

  /// Returns whether any needs the picture of the film's frame with this number, from 0. Asked from any thread, as it
  /// is known from the beginning.
  [[nodiscard]] bool needs_picture(int index) const;

  /// What the frames must hold for them.
  [[nodiscard]] FrameContents contents() const;

  /// @param frame with its image, if any output takes images
  void add(const FilmFrame& frame);

  /// Completes what can be completed.
  /// @returns the files of each output that was, in their order
  std::vector<std::vector<OutputFile>> finish(Ending ending);

  /// A message for each output that was given up.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Output {
    std::string path;
    std::optional<AnySink> sink;  ///< absent once it was given up
    bool held = false;            ///< whether it gets its pictures at the end, beginning with the poster's
  };
  template <class AnyOf>
  [[nodiscard]] bool any_is() const;
  template <class Work>
  void attempt(Output& output, Work work);

  void hold_loops(const FilmInfo& film);
  void release(Encoder& encoder) const;
  /// @returns what was written
  std::vector<OutputFile> write_poster(const std::string& file, Ending ending);

  std::vector<Output> outputs_;
  std::vector<bool> pictures_;  // of the film's frames, whether any output needs it
  std::optional<Poster> poster_;
  std::vector<std::string> poster_files_;
  std::vector<Image> held_;       // of the film
  std::size_t poster_place_ = 0;  // among them
  std::vector<std::string> problems_;
};

}  // namespace drape
