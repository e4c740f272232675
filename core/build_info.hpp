#pragma once

#include <string>

namespace drape {

/// What this binary was built from.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string revision;  ///< git's: "3f2a…", with "-dirty" if files were changed; "unknown" outside a repository
  std::string compiler;  ///< "GCC 12.2.0"
  std::string type;      ///< CMake's build type: "Release"
};

const BuildInfo& build_info();

}  // namespace drape
