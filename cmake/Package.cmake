# Package for find_package(drape) of other CMake projects, see docs/library.md.
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

# The public headers, each with an example, and the headers that they include. Installed, they are drape/sim/simulation.hpp,
# and include each other by that name: folders named `core` or `run` would clash with others.
set(public_headers
  core/error.hpp
  sim/body_shape.hpp sim/cloth.hpp sim/state.hpp sim/state.hpp sim/cloth.hpp sim/state.hpp sim/settings.hpp sim/tracks.hpp
  sim/mesh.hpp sim/mesh.hpp sim/body_shape.hpp sim/settings.hpp sim/simulation.hpp sim/tracks.hpp sim/state.hpp sim/state.hpp sim/settings.hpp
  sim/effects/wind.hpp sim/effects/bending.hpp sim/effects/body.hpp sim/effects/damping.hpp sim/effects/effect.hpp sim/effects/field.hpp
  sim/effects/gravity.hpp sim/effects/ground.hpp sim/effects/moving_pins.hpp sim/effects/self_collision.hpp
  sim/effects/sphere.hpp sim/effects/strain_limit.hpp sim/effects/wind.hpp
  scene/scene.hpp scene/scene.hpp
  render/settings.hpp render/image.hpp render/renderer.hpp render/settings.hpp render/view.hpp)
set(included_headers
  core/rotation.hpp core/rgb.hpp render/overlay/fonts.hpp render/overlay/pen.hpp render/overlay/caption.hpp render/overlay/caption.hpp scene/scene.hpp
  scene/document.hpp scene/portable.hpp sim/effects/wind.hpp sim/schemes/method_choice.hpp sim/solvers/accuracy.hpp)
install(CODE "
  foreach(header ${public_headers} ${included_headers})
    file(READ \"${PROJECT_SOURCE_DIR}/\${header}\" text)
    string(REGEX REPLACE \"#include \\\"([a-z])\" \"#include \\\"drape/\\\\1\" text \"\${text}\")
    set(place \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/drape/\${header}\")
    file(WRITE \"\$ENV{DESTDIR}\${place}\" \"\${text}\")
    list(APPEND CMAKE_INSTALL_MANIFEST_FILES \"\${place}\")
  endforeach()")
