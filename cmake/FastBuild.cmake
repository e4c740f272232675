# Speeds up builds without changing their results: a cache of compiled objects and a fast linker if they are installed, and
# several files compiled as one (CMAKE_UNITY_BUILD, see CMakePresets.json).
find_program(DRAPE_CCACHE ccache)
if(DRAPE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Finds precompiled headers by their contents, as ccache's manual requires.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${DRAPE_CCACHE})
endif()

include(CheckLinkerFlag)
foreach(linker mold lld)
  check_linker_flag(CXX -fuse-ld=${linker} DRAPE_HAS_${linker})
  if(DRAPE_HAS_${linker})
    add_link_options(-fuse-ld=${linker})
    break()
  endif()
endforeach()
