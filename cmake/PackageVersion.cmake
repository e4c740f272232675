# Read by cpack: the package's version is that of the sources it is made of, not of when they were configured.
include(${CPACK_DRAPE_SOURCE}/cmake/Version.cmake)
drape_version(${CPACK_DRAPE_SOURCE} ${CPACK_DRAPE_VERSION} CPACK_PACKAGE_VERSION)
