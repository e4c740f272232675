#pragma once

// Example:
//   const drape::Scene scene = drape::load_scene("scene.toml", {"cloth.stiffness=300"});
//   drape::Simulation simulation(scene.simulation);
//   while (simulation.state().step < scene.step_count()) simulation.step();

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "overlay/settings.hpp"
#include "render/settings.hpp"
#include "scene/check_settings.hpp"
#include "scene/portable.hpp"
#include "sim/schemes/method_choice.hpp"
#include "sim/settings.hpp"

namespace drape {

/// A named value for texts about a scene: "integrator.tolerance".
struct SceneField {
  std::string path;
  FieldValue value;
  bool operator==(const SceneField&) const = default;
};

/// A key of a scene and its value as text.
struct SceneValue {
  std::string key, text;
};

/// Trade-off between detail and drawing time, see apply_quality().
enum class Quality { draft, film, print };

/// A scene: plain data, complete and checked.
struct Scene {
  std::filesystem::path file;
  std::string name;  ///< the file's name without its ending: "5" for scenes/homework/5.toml
  SimulationSettings simulation;
  double duration = 5;                    ///< [s]
  std::vector<std::array<float, 2>> uvs;  ///< texture coordinates of the cloth per triangle corner, see Mesh::uvs
  Camera camera;
  Look look;
  Video video;
  CaptionSettings caption;
  OverlaySettings overlay;
  CheckSettings check;
  std::vector<std::filesystem::path> inputs;  ///< every file read: the scene itself, meshes, tracks, the texture
  std::string texture_location;               ///< place of the texture's name, for messages: "scene.toml:9:11"
  std::vector<SceneField> fields;             ///< every key with its value
  std::string caption_place;                  ///< place of the caption's text, for messages
  /// Hash of the file and the overrides, except [check], [caption] and [overlay]; 16 hexadecimal digits. Comments, the
  /// order of keys and the notation of numbers do not change it.
  std::string digest;
  std::vector<SceneValue> tables;      ///< values in the tables that affect the motion, see physics_values()
  PortableScene portable;              ///< the scene and all its input files
  std::vector<std::string> warnings;   ///< warnings about valid but unlikely values: "scene.toml:2:8: …"
  std::optional<MethodChoice> choice;  ///< automatic choice of a method if none is named
  std::optional<Quality> quality;      ///< quality that its numbers were adjusted for

  /// Returns the number of steps that cover the duration: duration/step, rounded to the nearest whole number.
  [[nodiscard]] std::int64_t step_count() const;
};

/// Cells of a scene's grid.
enum class Cells {
  of_quality,  ///< as written, or coarsened for a draft, see coarsen_grid()
  as_written,
  of_draft  ///< coarsened, whatever the quality is
};

/// Reads a scene file.
/// @param overrides "key.path=value", applied in order as if the file contained them, and checked like it; the value is
///                  any TOML value, or a bare word, which is a string
/// @throws UsageError whose message lists every problem of the file and the overrides, a line each:
///         "file:line:col: message", or "--set key.path=value: message"
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 Cells cells = Cells::of_quality);

/// Makes a scene from a parsed document.
/// @param document a table; messages name its places. Line 0: made by a program, without a text
/// @param file     file name for messages; files named in the scene are looked up in its folder
/// @throws UsageError as load_scene()
Scene make_scene(TomlValue document, const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 Cells cells = Cells::of_quality);

/// Returns the data folder, which holds textures/, shaders/ and scenes/: the one set by use_data_folder(), else the one
/// installed with the program or the library (share/drape), else the source tree of the build.
/// @throws UsageError if there is none
std::filesystem::path data_folder();

/// Sets the result of data_folder(); an empty path restores the search. Do not call it while another thread reads
/// scenes or draws.
/// @throws UsageError if there is no such folder
void use_data_folder(const std::filesystem::path& folder);

}  // namespace drape
