# Writes HEADER with DRAPE_VERSION (see Version.cmake), DRAPE_REVISION, git's name for the state of SOURCE or "unknown" outside
# a repository, and DRAPE_DATE, the date of its last commit.
include(${CMAKE_CURRENT_LIST_DIR}/Version.cmake)
drape_version(${SOURCE} ${FALLBACK} version)
execute_process(
  COMMAND git -C ${SOURCE} describe --always --exclude * --dirty --abbrev=12
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision unknown)
endif()
execute_process(
  COMMAND git -C ${SOURCE} log -1 --format=%cs
  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${HEADER} CONTENT
  "#define DRAPE_VERSION \"${version}\"\n#define DRAPE_REVISION \"${revision}\"\n#define DRAPE_DATE \"${date}\"\n")
