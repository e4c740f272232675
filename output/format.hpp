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

/// Marks a format of all steps instead of frames, written by the run itself, see run/motion_recorder.hpp.
struct OfSteps {};

/// An output format. The command line, its messages, `drape doctor` and docs/outputs.md take their texts from it.
struct OutputFormat {
  std::string extension;  ///< ".gif"
  std::string help;       ///< description of a file: "an animation that repeats for ever"
  std::string made_by;    ///< library that writes it, with its version; empty: drape itself
  std::string packages;   ///< Debian packages to install if it fails, separated by spaces
  std::variant<FilmMaker<Image>, FrameMaker<Image>, FilmMaker<Frame>, FrameMaker<Frame>, OfSteps> make;
  std::vector<const char*> beside = {};  ///< possible companion files of NAME.EXT: ".obj" is NAME.obj, see beside.hpp

  /// Returns true if it takes images, so that frames must be drawn.
  [[nodiscard]] bool drawn() const;
  /// Returns true if it holds every step; no sink can be made for it.
  [[nodiscard]] bool of_steps() const { return std::holds_alternative<OfSteps>(make); }
  /// Returns true if a file holds one frame. Then a path with {frame} gives a file per frame, and one without gives a
  /// file of the last frame. Otherwise {frame} is not allowed.
  [[nodiscard]] bool file_per_frame() const;
};

}  // namespace drape
