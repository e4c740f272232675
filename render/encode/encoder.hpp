#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "render/image.hpp"

namespace drape {

/// A file that is complete.
struct OutputFile {
  std::filesystem::path path;
  std::uintmax_t size = 0;  ///< [bytes]
};

/// What to write the frames of a film to.
struct OutputSpec {
  /// Where to, and by the extension in which form:
  ///   .gif                    an animation that repeats for ever
  ///   .mp4 .webm .avi         a video
  ///   .png with {frame}       one picture per frame, as in frames/{frame:04}.png, where 04 pads with zeros to 4
  ///   digits;
  ///                           {frame} alone pads so that names sort. Files of an earlier, longer sequence stay.
  ///   .png                    one picture: the last frame added
  /// {scene} stands for the scene's name; "{{" and "}}" for a brace.
  std::string path;
  std::string scene;            ///< name of the scene
  double fps = 25;              ///< frames per second
  int first_frame = 0;          ///< number of the first frame added
  int expected_frames = 0;      ///< how many will be added; fewer is no error
  int width = 64, height = 64;  ///< of the frames, to try beforehand what can be tried [pixels]

  /// Called in Encoder::finish() while it has frames left to encode: how many are done, and of how many.
  std::function<void(int done, int total)> progress;
};

/// Takes the frames of a film, one after the other, and makes files of them. A file appears under its name only when it
/// is complete, in place of an older one; an encoder that is destroyed without finish() leaves nothing behind, but for
/// the pictures of a sequence, of which each is complete in itself. Use it from one thread at a time.
class Encoder {
 public:
  virtual ~Encoder() = default;

  /// The next frame.
  /// @throws OutputError           if it cannot be stored
  /// @throws std::invalid_argument if it has another size than the first one
  virtual void add(const Image& image) = 0;

  /// Completes the files with the frames added up to now. Call it once, as the last thing.
  /// @param ending  early: frames are missing, so that the film goes to its partial_name(); the pictures of a sequence
  ///                keep theirs
  /// @returns what was written: nothing if there was no frame
  /// @throws OutputError
  virtual std::vector<OutputFile> finish(Ending ending) = 0;
  std::vector<OutputFile> finish() { return finish(Ending::complete); }
};

/// The names of all files that the frames of a spec go to.
/// @throws UsageError if the path has an unknown placeholder
std::vector<std::string> output_files(const OutputSpec& spec);

/// Makes the encoder for a path, and the folders it needs. What can fail because of the path fails here, before the
/// first frame is drawn.
/// @throws UsageError  if the path has an unknown extension or placeholder, or fps is out of the format's range
/// @throws OutputError if the folder cannot be written to, or there is no codec
std::unique_ptr<Encoder> make_encoder(const OutputSpec& spec);

}  // namespace drape
