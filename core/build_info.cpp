#include "core/build_info.hpp"

#include "drape_revision.hpp"

namespace drape {

const BuildInfo& build_info() {
#ifdef __clang__
  static const BuildInfo info{DRAPE_VERSION, DRAPE_REVISION, DRAPE_DATE, "Clang " __clang_version__, DRAPE_BUILD_TYPE};
#else
  static const BuildInfo info{DRAPE_VERSION, DRAPE_REVISION, DRAPE_DATE, "GCC " __VERSION__, DRAPE_BUILD_TYPE};
#endif
  return info;
}

}  // namespace drape
