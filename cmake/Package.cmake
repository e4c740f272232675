# Package for find_package(drape) of other CMake projects, see docs/reference/library.md.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/drape)

# drape::sim, drape::scene, drape::render, and their common parts. They are static, so that a program keeps the bits of this
# build and no binary interface must stay stable.
set(parts core sim overlay scene codecs render)
set(targets ${parts})
list(TRANSFORM targets PREPEND drape_)
foreach(part ${parts})
  set_target_properties(drape_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()
install(TARGETS ${targets} EXPORT drape ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT drape NAMESPACE drape:: FILE drapeTargets.cmake DESTINATION ${package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/drapeConfig.cmake.in ${PROJECT_BINARY_DIR}/drapeConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/drapeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/drapeConfig.cmake ${PROJECT_BINARY_DIR}/drapeConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindCHOLMOD.cmake
        DESTINATION ${package_folder})

# Headers that begin with an example are public; the others are included by them.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/drape DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
