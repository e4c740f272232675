#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A motion that a scene refers to, with options for reading it. Paths are relative to the working folder.
struct NamedMotion {
  std::string motion;               ///< a file, or a sequence: "meshes/{frame:04}.obj"
  std::vector<std::string> bodies;  ///< files or sequences of the bodies
  std::string mesh, prim;           ///< mesh of a .pc2; prim of a .usda; empty: not given
  std::optional<double> fps;        ///< frames per second
  double scale = 1;                 ///< metres per unit of the files
  bool y_up = false;
};

/// A scene whose [cloth] motion refers to a motion that is read, not computed. `look` gives camera, look, film,
/// captions and [check]; its cloth and physics are placeholders.
struct SceneOfMotion {
  NamedMotion named;
  LoadedScene look;
};

/// Reads a scene of a motion.
/// @returns nothing for a scene without [cloth] motion
/// @throws UsageError as load_scene(); also if the scene has keys of physics, which have no meaning here
std::optional<SceneOfMotion> load_scene_of_motion(const std::filesystem::path& file,
                                                  const std::vector<std::string>& overrides = {});

/// Makes a scene of a motion from a parsed document, likewise.
std::optional<SceneOfMotion> load_scene_of_motion(TomlValue document, const std::filesystem::path& file,
                                                  const std::vector<std::string>& overrides);

/// Returns the table [cloth] of such a scene; its keys write to `motion`.
/// @param body a string, or an array of strings
TableType named_motion_table(NamedMotion& motion, const TomlValue*& body);

/// Returns the digest of a scene of either kind.
/// @throws UsageError as load_scene()
std::string digest_of_file(const std::filesystem::path& file);

/// Digest of a motion that is drawn without a scene.
inline constexpr const char* no_scene_digest = "0000000000000000";

}  // namespace drape
