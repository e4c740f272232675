#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drape/scene/document.hpp"

namespace drape {

/// A scene as one self-contained text and its files. The overrides are applied in the text, and the files have new
/// names in it: "file-1.obj". One folder with all of them holds the whole scene, except [check], whose goldens lie
/// beside the original file. Files that a USD file refers to keep their names without folders; UsdStage finds them
/// there.
struct PortableScene {
  struct File {
    std::string name;             ///< name in the text
    std::filesystem::path place;  ///< path on disk
  };
  std::string text;  ///< in TOML
  std::vector<File> files;
};

/// @param document document after overrides
/// @param folder   folder of the scene
/// @param inputs   every file read for the scene
PortableScene make_portable(TomlValue document, const std::filesystem::path& folder,
                            const std::vector<std::filesystem::path>& inputs);

}  // namespace drape
