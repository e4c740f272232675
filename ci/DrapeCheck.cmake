# drape_add_check(NAME SCENE [OPTION...]): adds a CTest test that passes if drape check finds the scene equal to its golden. The
# report is in drape-check/NAME below the build folder. The label is "drape". A relative scene is in the current source folder.
#
#   include(path/to/DrapeCheck.cmake)   # or find_package(drape), which includes it
#   enable_testing()
#   drape_add_check(flag scenes/flag.toml)
#   drape_add_check(drop scenes/drop.toml --motion-tolerance 1e-5)
#
# The program is named by the variable DRAPE_EXECUTABLE; otherwise it is drape on the PATH.
function(drape_add_check name scene)
  find_program(DRAPE_EXECUTABLE drape DOC "The program that checks scenes")
  if(NOT DRAPE_EXECUTABLE)
    message(FATAL_ERROR "drape_add_check(${name}): drape is not on the PATH; set DRAPE_EXECUTABLE")
  endif()
  get_filename_component(file "${scene}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "drape_add_check(${name}): no such scene: ${file}")
  endif()
  add_test(NAME ${name} COMMAND ${DRAPE_EXECUTABLE} check --update none ${ARGN}
           --report "${CMAKE_BINARY_DIR}/drape-check/${name}" -- "${file}")
  set_tests_properties(${name} PROPERTIES LABELS drape)
endfunction()
