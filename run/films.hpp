#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "render/encode/encoder.hpp"
#include "render/texture_image.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Which moments of a scene's motion a run of it shows.
/// @throws UsageError if the motion has no such frames
FilmExtent film_extent(const Scene& scene, const RunOptions& options);

/// What the outputs of a run are written to, and what will be written to them.
/// @throws UsageError as film_extent()
std::vector<OutputSpec> output_specs(const Scene& scene, const RunOptions& options);

/// Opens everything that a run would write, and leaves nothing of it.
/// @throws Error what the run would end with otherwise, perhaps after hours
void require_outputs(const Scene& scene, const RunOptions& options);

/// Looks whether the texture of a scene that is to be drawn can be, if it has one.
/// @param largest the most pixels that a texture may be wide or high
/// @throws UsageError that names the place in the scene
void require_texture(const Scene& scene, int largest = largest_texture);

/// The outputs of a run that is drawn. One that cannot be written is given up, and does not keep the others from being
/// completed.
class Films {
 public:
  /// @throws UsageError, OutputError as make_encoder()
  explicit Films(const std::vector<OutputSpec>& specs);

  /// Whether no output takes frames (any more).
  [[nodiscard]] bool none() const;

  void add(const Image& image);

  /// Completes what can be completed.
  /// @returns the files of each output that was, in their order
  std::vector<std::vector<OutputFile>> finish(Ending ending);

  /// A message for each output that was given up.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Film {
    std::string path;
    std::unique_ptr<Encoder> encoder;  ///< null once it was given up
  };
  void give_up(Film& film, const std::exception& error);

  std::vector<Film> films_;
  std::vector<std::string> problems_;
};

}  // namespace drape
