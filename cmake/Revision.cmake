# Writes HEADER, which defines DRAPE_REVISION: git's name for the state of SOURCE, or "unknown" outside a repository.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define DRAPE_REVISION \"${revision}\"\n")
