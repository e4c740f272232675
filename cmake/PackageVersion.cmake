# Read by cpack: takes the package's version from the sources, not from the time of configuration.
include(${CPACK_DRAPE_SOURCE}/cmake/Version.cmake)
drape_version(${CPACK_DRAPE_SOURCE} ${CPACK_DRAPE_VERSION} CPACK_PACKAGE_VERSION)
