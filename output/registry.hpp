#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/sim/cloth.hpp"
#include "output/sink.hpp"

namespace drape {

/// Layout of a contact sheet.
struct SheetGrid {
  int columns = 1, rows = 1;
  bool labelled = true;  ///< writes the time below each picture
};

/// Property that a film keeps when it must become smaller: the size of its pictures, or their rate.
enum class FilmKeeps { nothing, size, rate };

/// Greatest size of a file [bytes].
struct FileLimit {
  std::uint64_t bytes = 0;
  FilmKeeps keeps = FilmKeeps::nothing;
};

/// Properties of a film known before its first frame.
struct FilmInfo {
  std::string scene;                ///< the scene's name
  double fps = 25;                  ///< frames per second of playback
  double seconds_per_frame = 0.04;  ///< in the scene's time
  int first_frame = 0;              ///< number of the first frame added
  int expected_frames = 0;          ///< number of frames to be added; fewer are allowed
  int width = 64, height = 64;      ///< of the pictures, for early checks [pixels]
  int bands = 0;                    ///< rows for legend and curves at the bottom of each picture

  std::optional<FileLimit> largest_file = {};  ///< limit of a drawn film, which shrinks to fit, see SizeLimitedEncoder

  /// The cloth before the first step, its texture coordinates as in Mesh, and the look. They outlive the sinks.
  const Cloth* cloth = nullptr;  ///< null: no cloth
  const std::vector<std::array<float, 2>>* uvs = nullptr;
  const Look* look = nullptr;
  const Camera* camera = nullptr;  ///< outlives the sinks; null: default direction

  /// Makes a single picture a contact sheet of several moments; absent: it shows the last one.
  std::optional<SheetGrid> sheet = {};

  /// True if the look's textures are in a temporary folder: a file that refers to one needs a copy.
  bool temporary_textures = false;

  /// Called while Sink::finish() still encodes frames, with the number done and the total.
  std::function<void(int done, int total)> progress = {};

  /// Triangles of the cloth; empty without one.
  [[nodiscard]] const std::vector<Triangle>& triangles() const;
  [[nodiscard]] const std::vector<std::array<float, 2>>& texture_coordinates() const;
};

/// Makes the sink of a format with one file for the whole film.
template <class Item>
using FilmMaker = std::function<std::unique_ptr<Sink<Item>>(const std::filesystem::path& file, const FilmInfo& film)>;

/// Makes the function that returns the bytes of a frame's file, for a format with one file per frame.
template <class Item>
using FrameMaker = std::function<std::function<std::string(const Item&)>(const FilmInfo& film)>;

/// Marks a format of all steps instead of frames, written by the run itself, see run/records.hpp.
struct OfSteps {};

/// An output format. The command line, its messages, `drape doctor` and docs/reference/outputs.md take their texts from
/// it.
struct OutputFormat {
  std::string extension;  ///< ".gif"
  std::string help;       ///< description of a file: "an animation that repeats for ever"
  std::string made_by;    ///< library that writes it, with its version; empty: drape itself
  std::string packages;   ///< Debian packages to install if it fails, separated by spaces
  std::variant<FilmMaker<Image>, FrameMaker<Image>, FilmMaker<Frame>, FrameMaker<Frame>, OfSteps> make;
  std::vector<const char*> beside = {};  ///< possible companion files of NAME.EXT: ".obj" is NAME.obj

  /// Returns true if it takes images, so that frames must be drawn.
  [[nodiscard]] bool drawn() const;
  /// Returns true if it holds every step; no sink can be made for it.
  [[nodiscard]] bool of_steps() const { return std::holds_alternative<OfSteps>(make); }
  /// Returns true if a file holds one frame. Then a path with {frame} gives a file per frame, and one without gives a
  /// file of the last frame. Otherwise {frame} is not allowed.
  [[nodiscard]] bool file_per_frame() const;
};

/// Returns all formats.
const std::vector<OutputFormat>& output_formats();

/// Returns the format of a path by its extension in lower or upper case; null if there is none.
const OutputFormat* find_format(std::string_view path);

/// Returns the format of a path.
/// @throws UsageError that names the nearest extension and all valid ones
const OutputFormat& format_of(std::string_view path);

enum class FormatKinds { all, drawn, undrawn };

/// Returns the help for -o, one line per format of these kinds.
std::string output_help(FormatKinds kinds);

/// Returns the table of docs/reference/outputs.md.
std::string output_reference();

using AnySink = std::variant<std::unique_ptr<Encoder>, std::unique_ptr<MotionWriter>>;

/// Returns the names of all files of a film.
/// @param path as in make_sink()
/// @throws UsageError if the path has an unknown placeholder
std::vector<std::string> output_files(const std::string& path, const FilmInfo& film);

/// Makes the sink of a film, and the folders it needs. Errors of the path are reported here, before the first frame is
/// drawn.
/// @param path destination; its extension selects the format, see output_formats(). Placeholders: {scene} is the
///             scene's name; {frame:04} a frame's number, padded with zeros to 4 digits; {frame} one padded so that
///             names sort; "{{" and "}}" a brace. Files of an earlier, longer sequence stay.
/// @throws UsageError  if the path has an unknown extension or placeholder, or fps is out of the format's range
/// @throws OutputError if the folder cannot be written to, or there is no codec
AnySink make_sink(const std::string& path, const FilmInfo& film);

/// Makes the sink of a film for one file, whose name is taken literally.
/// @throws the same errors
AnySink make_sink(const OutputFormat& format, const std::filesystem::path& file, const FilmInfo& film);

/// Writes two small frames in a format to a file; writes nothing for a format of steps.
/// @param file name, taken literally
/// @returns codec and library: "H.264, by OpenCV 4.6.0"
/// @throws Error with the reason if the format fails
std::string try_format(const OutputFormat& format, const std::filesystem::path& file);

/// An output path with placeholders: {scene}, {frame}, {frame:04}; "{{" and "}}" stand for a brace.
class PathTemplate {
 public:
  /// @throws UsageError that names the valid placeholders if it has an unknown one
  explicit PathTemplate(std::string_view text);

  /// Returns true if the path contains {frame}, so that each frame has its own file.
  [[nodiscard]] bool has_frame() const;

  /// @param default_width digits of a {frame} without a width; larger numbers get as many as they need
  /// @throws UsageError if the scene's name leads out of a folder, see name_in_folder()
  [[nodiscard]] std::string path(std::string_view scene, int frame, int default_width) const;

 private:
  struct Piece {
    enum class Kind { text, scene, frame } kind;
    std::string text;
    int width = 0;  // digits of a frame's number; 0: the default
  };

  Piece placeholder(std::string_view inside) const;

  std::string text_;
  std::vector<Piece> pieces_;
};

}  // namespace drape
