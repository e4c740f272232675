#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "output/sink.hpp"
#include "render/settings.hpp"
#include "sim/cloth.hpp"

namespace drape {

/// How many pictures a contact sheet has in a row, and how many rows.
struct SheetGrid {
  int columns = 1, rows = 1;
  bool labelled = true;  ///< the time stands below each picture
};

/// What a film that must become smaller keeps as it is, if anything: the size of its pictures, or their rate.
enum class FilmKeeps { nothing, size, rate };

/// How many bytes a file may have.
struct FileLimit {
  std::uint64_t bytes = 0;
  FilmKeeps keeps = FilmKeeps::nothing;
};

/// What is known of a film before its first frame.
struct FilmInfo {
  std::string scene;                ///< the scene's name
  double fps = 25;                  ///< frames per second, as it is played
  double seconds_per_frame = 0.04;  ///< of the scene's time
  int first_frame = 0;              ///< number of the first frame added
  int expected_frames = 0;          ///< how many will be added; fewer is no error
  int width = 64, height = 64;      ///< of the pictures, to try beforehand what can be tried [pixels]
  int bands = 0;                    ///< rows at the bottom of each picture that hold legend and curves

  std::optional<FileLimit> largest_file =
      {};  ///< of a film that is drawn; it becomes smaller for it, see SizeLimitedEncoder

  /// The cloth before the first step, its texture coordinates as in Mesh, and what things look like. They outlive the
  /// sinks.
  const Cloth* cloth = nullptr;  ///< null: there is none
  const std::vector<std::array<float, 2>>* uvs = nullptr;
  const Look* look = nullptr;
  const Camera* camera = nullptr;  ///< likewise; null: the usual direction

  /// Where one picture is asked for, it is a contact sheet of several moments instead; absent: it is the last.
  std::optional<SheetGrid> sheet = {};

  /// Called in Sink::finish() while it has frames left to encode: how many are done, and of how many.
  std::function<void(int done, int total)> progress = {};

  /// Of the cloth; empty where there is none.
  [[nodiscard]] const std::vector<Triangle>& triangles() const;
  [[nodiscard]] const std::vector<std::array<float, 2>>& texture_coordinates() const;
};

/// Makes the sink of a format of which one file holds the whole film.
template <class Item>
using FilmMaker = std::function<std::unique_ptr<Sink<Item>>(const std::filesystem::path& file, const FilmInfo& film)>;

/// Makes what gives the bytes of a frame's file, for a format of which one file holds one frame.
template <class Item>
using FrameMaker = std::function<std::function<std::string(const Item&)>(const FilmInfo& film)>;

/// Of a format that holds every step rather than frames: the run itself writes it, see run/motion_recorder.hpp.
struct OfSteps {};

/// A form in which frames are written. What the command line, its messages, `drape doctor` and docs/outputs.md say of
/// it comes from here.
struct OutputFormat {
  std::string extension;  ///< ".gif"
  std::string help;       ///< what a file is: "an animation that repeats for ever"
  std::string made_by;    ///< the library that makes it, with its version; empty: drape itself
  std::string packages;   ///< of Debian, separated by spaces: what to install where it does not work
  std::variant<FilmMaker<Image>, FrameMaker<Image>, FilmMaker<Frame>, FrameMaker<Frame>, OfSteps> make;
  std::vector<const char*> beside =
      {};  ///< what may be written beside a file NAME.EXT: ".obj" is NAME.obj, see beside.hpp

  /// Whether it takes images, so that somebody has to draw them.
  [[nodiscard]] bool drawn() const;
  /// Whether it holds every step, so that no sink can be made for it.
  [[nodiscard]] bool of_steps() const { return std::holds_alternative<OfSteps>(make); }
  /// Whether a file holds one frame. Then a path with {frame} means a file for each frame, and one without means one
  /// for the last frame. Otherwise a path has no {frame}.
  [[nodiscard]] bool file_per_frame() const;
};

}  // namespace drape
