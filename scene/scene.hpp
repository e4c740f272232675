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

/// A value that a text about a scene can name: "integrator.tolerance".
struct SceneField {
  std::string path;
  FieldValue value;
  bool operator==(const SceneField&) const = default;
};

/// The value of a key of a scene, as text.
struct SceneValue {
  std::string key, text;
};

/// How much time a film may take, in one word, see apply_quality().
enum class Quality { draft, film, print };

/// A scene: plain data, complete and checked.
struct Scene {
  std::filesystem::path file;
  std::string name;  ///< the file's name without its ending: "5" for scenes/homework/5.toml
  SimulationSettings simulation;
  double duration = 5;                    ///< [s]
  std::vector<std::array<float, 2>> uvs;  ///< of the cloth, per triangle corner, see Mesh::uvs
  Camera camera;
  Look look;
  Video video;
  CaptionSettings caption;
  OverlaySettings overlay;
  CheckSettings check;
  std::vector<std::filesystem::path> inputs;  ///< every file that it is read from: itself, meshes, tracks, the texture
  std::string texture_place;                  ///< where the texture is named, for messages: "scene.toml:9:11"
  std::vector<SceneField> fields;             ///< every key with its value
  std::string caption_place;                  ///< where the caption's text is, for messages
  /// A hash of what the file and the overrides say, except [check], [caption] and [overlay]: comments, the order of
  /// keys and the way in which a number is written do not change it. 16 hexadecimal digits.
  std::string digest;
  std::vector<SceneValue> tables;      ///< what the tables say on which the motion depends, see physics_values()
  PortableScene portable;              ///< all that it was read from
  std::vector<std::string> doubts;     ///< what may not be meant, though it can be simulated: "scene.toml:2:8: …"
  std::optional<MethodChoice> choice;  ///< of the method, where none is named
  std::optional<Quality> quality;      ///< that its numbers were changed for

  /// The number of steps that cover the duration: duration/step, rounded to the nearest whole number.
  [[nodiscard]] std::int64_t step_count() const;
};

/// How many cells a scene's grid has.
enum class Cells {
  of_quality,  ///< as written, or as a draft has them, see coarsen_grid()
  as_written,
  of_draft  ///< whatever the quality is
};

/// Reads a scene file.
/// @param overrides "key.path=value", applied in order as if the file said so, and checked like it; the value is any
///                  TOML value, or a bare word, which is a string
/// @throws UsageError whose message lists every problem of the file and the overrides, a line each:
///         "file:line:col: message", or "--set key.path=value: message"
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 Cells cells = Cells::of_quality);

/// Makes a scene of what a file would say.
/// @param document a table, whose places messages name; of line 0: the scene was made by a program, and has none
/// @param file     what messages call it; the files that it names are looked for in its folder
/// @throws UsageError as load_scene()
Scene make_scene(TomlValue document, const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 Cells cells = Cells::of_quality);

/// The data folder that holds textures/, shaders/ and scenes/: the one that use_data_folder() has named, else what was
/// installed with the program or the library (share/drape), else the source tree it was built from.
/// @throws UsageError if there is none
std::filesystem::path data_folder();

/// Makes data_folder() return this one from now on; an empty path has it searched for again. Not while another thread
/// reads scenes or draws.
/// @throws UsageError if there is no such folder
void use_data_folder(const std::filesystem::path& folder);

}  // namespace drape
