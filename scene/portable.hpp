#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/document.hpp"

namespace drape {

/// A scene as one text, in which its overrides are said as if the file did, and the files that it names, under names
/// of their own, by which the text calls them: "file-1.obj". Whoever puts all of that into one folder has the scene,
/// but for [check], which is about goldens beside the scene's own file. Files that a USD file refers to keep their
/// names, without their folders: they are looked for beside it, too (see UsdStage).
struct PortableScene {
  struct File {
    std::string name;             ///< in the text
    std::filesystem::path place;  ///< where it is
  };
  std::string text;  ///< TOML
  std::vector<File> files;
};

/// @param document with its overrides
/// @param folder   the scene's
/// @param inputs   every file that was read for it
PortableScene make_portable(TomlValue document, const std::filesystem::path& folder,
                            const std::vector<std::filesystem::path>& inputs);

}  // namespace drape
