#pragma once

#include <string>
#include <vector>

#include "tests/support/scene_folder.hpp"

namespace drape::test {

inline const std::vector<std::string> osmesa_libraries{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
inline const std::vector<std::string> egl_libraries{"libEGL.so.1", "libEGL.so"};

/// Makes invalid files in the folder that the loader finds instead of these libraries.
/// @returns the assignment that makes the loader search there
inline std::string without_libraries(const SceneFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) folder.write("no/" + name, "");
  return "LD_LIBRARY_PATH='" + (folder.path() / "no").string() + "'";
}

inline std::string without_opengl(const SceneFolder& folder) {
  without_libraries(folder, egl_libraries);
  return without_libraries(folder, osmesa_libraries);
}

}  // namespace drape::test
