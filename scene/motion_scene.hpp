#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A motion that a scene names, and how its files are read. Paths are relative to the working folder.
struct NamedMotion {
  std::string motion;               ///< a file, or a sequence: "meshes/{frame:04}.obj"
  std::vector<std::string> bodies;  ///< likewise
  std::string mesh, prim;           ///< of a .pc2, of a .usda; empty: not said
  std::optional<double> fps;        ///< frames per second
  double scale = 1;                 ///< metres of a unit of the files
  bool y_up = false;
};

/// A scene of which [cloth] motion names a motion that is read, not computed: its camera, look, film, captions and
/// [check]. Its cloth and its physics stand for nothing.
struct SceneOfMotion {
  NamedMotion named;
  Scene look;
};

/// Reads a scene of a motion.
/// @returns nothing for a scene without [cloth] motion
/// @throws UsageError as load_scene(); also if it has keys of physics, which mean nothing here
std::optional<SceneOfMotion> load_scene_of_motion(const std::filesystem::path& file,
                                                  const std::vector<std::string>& overrides = {});

/// The table [cloth] of such a scene, whose keys write to `motion`.
/// @param body a string, or an array of strings
TableType named_motion_table(NamedMotion& motion, const TomlValue*& body);

/// Returns the digest of a scene of either kind.
/// @throws UsageError as load_scene()
std::string digest_of_file(const std::filesystem::path& file);

/// The digest of a motion that is drawn without a scene.
inline constexpr const char* no_scene_digest = "0000000000000000";

}  // namespace drape
