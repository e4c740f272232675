#pragma once

#include <string>

namespace drape {

/// Origin of this binary.
struct BuildInfo {
  std::string version;  ///< "0.2.0", or "0.2.0+15.g3f2a": 15 commits after it
  std::string revision;  ///< Git revision: "3f2a…", with "-dirty" if files were changed; "unknown" outside a repository
  std::string date;      ///< date of the revision, "2026-11-22"; empty outside a repository
  std::string compiler;  ///< "GCC 12.2.0"
  std::string type;      ///< CMake's build type: "Release"
};

const BuildInfo& build_info();

}  // namespace drape
