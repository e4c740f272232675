# Debian package of all files that cmake --install installs; script/package builds it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME drape)
set(CPACK_PACKAGE_VENDOR "The drape project")
set(CPACK_PACKAGE_CONTACT "The drape project <drape@packages.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulates cloth and renders it into GIF, PNG and MP4")
set(CPACK_PACKAGE_DESCRIPTION "drape simulates mass-spring cloth from a scene file and renders it
without a display into animations, videos and pictures, or writes its
motion for other programs. It compares methods, measures what accuracy
costs, and checks films against golden ones.")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # the tests need not be built

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Libraries loaded at first use, which dpkg-shlibdeps cannot see (tests/cli/manual_test.cpp checks for it).
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, libfreetype6, libfontconfig1, fonts-dejavu-core,\
 fonts-droid-fallback, librsvg2-2, libcairo2, libglib2.0-0, libopenblas0-serial, python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "man-db, bash-completion")

set(CPACK_DRAPE_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_DRAPE_VERSION ${PROJECT_VERSION})
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/PackageVersion.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/DebianFiles.cmake)
include(CPack)
