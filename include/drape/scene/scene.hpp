#pragma once

// Example:
//   const drape::LoadedScene scene = drape::load_scene("scene.toml", {"cloth.stiffness=300"});
//   drape::Simulation simulation(scene.simulation);
//   while (simulation.state().step < scene.step_count()) simulation.step();

// Example:
//   const auto scene = drape::load_scene("scene.toml");
//   std::puts(drape::step_method_name(scene.simulation.integrator.step_method()).c_str());  // "quasi-newton"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/render/overlay/caption.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/document.hpp"
#include "drape/sim/schemes/method_choice.hpp"
#include "drape/sim/settings.hpp"

namespace drape {

/// Largest difference between two pictures that still count as equal up to rounding. All limits must hold.
struct PictureLimits {
  int channel = 3;        ///< largest difference of a pixel in any channel, of 255
  double pixels = 0.005;  ///< largest fraction of pixels that differ at all
  double flip = 0.05;     ///< largest FLIP error of a pixel
};

/// A rectangle of golden pixels: left column, top row, width and height.
using PixelRectangle = std::array<int, 4>;

/// The [check] table of a scene: which golden frames and motion to compare, and with which tolerances.
struct CheckSettings {
  std::vector<int> frames;              ///< film frames to compare, ascending; empty: chosen automatically, where
                                        ///< something happens
  std::optional<Eigen::Vector2i> size;  ///< size of the golden pictures [pixels]; absent: film size
  double window_time = 0.4;             ///< interval between restarts of the motion from a golden state [s]
  double motion_tolerance = 1e-6;       ///< largest distance of a vertex from its golden position [m]
  PictureLimits limits;
  std::optional<double> time;          ///< largest ratio of the first steps' time to the golden's; absent: not measured
  std::vector<PixelRectangle> ignore;  ///< rectangles left out of the comparison in every picture
  std::vector<int> ignore_frames;      ///< frames whose pictures are not compared
};

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
  std::string name;  ///< file name without extension: "5" for scenes/homework/5.toml
  SimulationSettings simulation;
  double duration = 5;                    ///< [s]
  std::vector<std::array<float, 2>> uvs;  ///< texture coordinates of the cloth per triangle corner, see Mesh::uvs
  Camera camera;
  Look look;
  Video video;
  CaptionSettings caption;
  OverlaySettings overlay;
  CheckSettings check;
  std::optional<MethodChoice> choice;  ///< automatic choice of a method if none is named
  std::optional<Quality> quality;      ///< quality already applied to the settings, see apply_quality()

  /// Returns the number of steps that cover the duration: duration/step, rounded to the nearest whole number.
  [[nodiscard]] std::int64_t step_count() const;
};

/// A scene as one self-contained text and its files. The overrides are applied in the text, and the files have new
/// names in it: "file-1.obj". A folder with these files holds the whole scene except [check], whose goldens lie beside
/// the original file. Files referenced by a USD file keep their base names, so that UsdStage finds them.
struct PortableScene {
  struct File {
    std::string name;             ///< name in the text
    std::filesystem::path place;  ///< path on disk
  };
  std::string text;  ///< in TOML
  std::vector<File> files;
};

/// The origin of a scene, and the data that name, store and compare it.
struct SceneSource {
  std::filesystem::path file;
  std::vector<std::filesystem::path> inputs;  ///< every file read: the scene itself, meshes, tracks, the texture
  std::string texture_location;               ///< place of the texture's name, for messages: "scene.toml:9:11"
  std::string caption_place;                  ///< place of the caption's text, for messages
  std::vector<SceneField> fields;             ///< every key with its value
  /// Hash of the file and the overrides, except [check], [caption] and [overlay]; 16 hexadecimal digits. Comments, the
  /// order of keys and the notation of numbers do not change it.
  std::string digest;
  std::vector<SceneValue> tables;     ///< values in the tables that affect the motion, see physics_values()
  PortableScene portable;             ///< the scene and all its input files
  std::vector<std::string> warnings;  ///< warnings about valid but unlikely values: "scene.toml:2:8: …"
};

/// A scene with its source.
struct LoadedScene : Scene {
  SceneSource source;
};

/// Resolution of a scene's grid.
enum class Cells {
  of_quality,  ///< as written, or coarsened for a draft, see coarsen_grid()
  as_written,
  of_draft  ///< always coarsened, see coarsen_grid()
};

/// Reads a scene file.
/// @param overrides assignments "key.path=value", applied in order and checked like the file. A value is TOML or a bare
///                  word, read as a string.
/// @param override_folder a folder besides the scene's for textures that the overrides name
/// @throws UsageError whose message lists every problem of the file and the overrides, a line each:
///         "file:line:col: message", or "--set key.path=value: message"
LoadedScene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                       Cells cells = Cells::of_quality,
                       const std::optional<std::filesystem::path>& override_folder = {});

/// Returns overrides for each scene that give all scenes with an automatic method the same method, see shared_method().
/// All are empty if the methods already agree or no method suits all.
/// @param choices see Scene::choice
std::vector<std::vector<std::string>> shared_method_overrides(const std::vector<std::optional<MethodChoice>>& choices);

/// Makes a scene from a parsed document.
/// @param document table whose places appear in messages; places of documents without a text have line 0
/// @param file     file name for messages; files named in the scene are looked up in its folder
/// @throws UsageError as load_scene()
LoadedScene make_scene(TomlValue document, const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {}, Cells cells = Cells::of_quality,
                       const std::optional<std::filesystem::path>& override_folder = {});

/// Returns the portable form of a scene.
/// @param document document after overrides
/// @param folder   folder of the scene
/// @param inputs   every file read for the scene
PortableScene make_portable(TomlValue document, const std::filesystem::path& folder,
                            const std::vector<std::filesystem::path>& inputs);

/// Returns the data folder, which holds textures/, shaders/ and scenes/. It is the first that exists of:
/// 1. the folder set by use_data_folder();
/// 2. share/drape below a folder of installation_roots();
/// 3. the source tree of the build;
/// 4. share/drape below configured_prefix().
/// @throws UsageError if there is none
std::filesystem::path data_folder();

/// Sets the result of data_folder(); an empty path restores the search. Do not call it while another thread reads
/// scenes or draws.
/// @throws UsageError if there is no such folder
void use_data_folder(const std::filesystem::path& folder);

/// Names of the methods in scenes, in the order of the enumeration.
inline constexpr auto method_names = [] {
  std::array<std::string_view, method_count + 1> names;
  for (std::size_t i = 0; i < method_count; ++i) names[i] = method_traits[i].name;
  names.back() = "auto";
  return names;
}();

inline std::string method_name(Method method) { return std::string(method_names[static_cast<std::size_t>(method)]); }

/// Names of the schemes in scenes, in the order of the enumeration.
inline constexpr auto scheme_names = [] {
  std::array<std::string_view, scheme_traits.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = scheme_traits[i].name;
  return names;
}();

inline std::string scheme_name(TimeScheme scheme) { return std::string(traits_of(scheme).name); }

/// Returns for example "verlet", "liu13", "liu13-sdirk2".
inline std::string step_method_name(StepMethod how) {
  return method_name(how.method) + (how.scheme == TimeScheme{} ? "" : "-" + scheme_name(how.scheme));
}

/// Names of the stopping rules in scenes, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> stopping_rule_names{"change", "gradient", "error"};

inline std::string stopping_rule_name(StoppingRule rule) {
  return std::string(stopping_rule_names[static_cast<std::size_t>(rule)]);
}

/// Returns true if a document's quality is draft.
bool says_draft(const TomlValue& document);

/// Halves the columns and rows of a draft's grid of more than 400 cells. Grids with pins by number or position keep
/// their size. Pins at corners, edges or borders exist on every grid. A grid from the command line keeps its size too.
/// @param document document of a scene, after overrides
void coarsen_grid(TomlValue& document);

/// Returns the grid resolution with which another scene must be loaded to draw this scene's motion.
inline Cells cells_of(const Scene& scene) {
  return scene.quality == Quality::draft ? Cells::of_draft : Cells::as_written;
}

/// Scales the settings that trade time for detail according to the scene's quality.
///   draft  half the size, at least 16 pixels, at most 12.5 frames per second, without ambient occlusion, ten times the
///          given tolerance
///   print  twice the size, at most 8192 pixels, four samples, textures filtered 16-fold
/// Captions and mesh lines are scaled with the picture, by one factor. A tolerance derived from an accuracy stays.
/// Values from the command line stay.
/// @param given returns true if the command line gives a key, "video.size"
void apply_quality(Scene& scene, const std::function<bool(const char*)>& given);

/// Returns every value of a scene that affects the motion, key by key. A key that is left out equals its default.
/// Camera, look, film and duration are not included. Long values (a mesh, a track) are hashed.
std::vector<SceneValue> physics_values(const LoadedScene& scene);

/// Computes a hash of physics_values(): 16 hexadecimal digits.
std::string physics_hash(const std::vector<SceneValue>& values);

/// Describes the differences, a line for each key: "cloth.mass: 1, and 2 in look.toml".
/// @param name name of the source of `b`
std::string physics_difference(const std::vector<SceneValue>& a, const std::vector<SceneValue>& b,
                               const std::string& name);

}  // namespace drape
