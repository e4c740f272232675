# cmake -P cmake/PrintVersion.cmake: prints the version of the sources, as used in packages.
include(${CMAKE_CURRENT_LIST_DIR}/Version.cmake)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../CMakeLists.txt project REGEX "^project\\(drape VERSION ")
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" number "${project}")
drape_version(${CMAKE_CURRENT_LIST_DIR}/.. ${number} version)
execute_process(COMMAND ${CMAKE_COMMAND} -E echo ${version})
