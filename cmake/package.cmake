# cpack -G DEB: listric (the program), listric-elastic-base and listric-ranks (its plug-ins) and
# liblistric-dev.

set(CPACK_PACKAGE_NAME listric)
set(CPACK_PACKAGE_VENDOR "The Listric developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Numerical sandbox for halfgrabens")
set(LISTRIC_MAINTAINER "The Listric developers <listric@users.noreply.example>" CACHE STRING
  "Whom the Debian packages name: whoever makes them")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${LISTRIC_MAINTAINER}")
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET listric_fem) # else the package would be empty
  list(APPEND CPACK_COMPONENTS_ALL elastic_base)
endif()
if(TARGET listric_ranks)
  list(APPEND CPACK_COMPONENTS_ALL ranks)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_files.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME listric)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "A hanging wall of bonded discs on a listric or ramp-flat detachment, with faults and sediment.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libjs-dygraphs, python3, python3-numpy")
# Figures need it, and with it come 140 more packages; without it the program warns and runs.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-matplotlib, python3-h5py")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-gsd, python3-pandas")
set(CPACK_DEBIAN_ELASTIC_BASE_PACKAGE_NAME listric-elastic-base)
set(CPACK_DEBIAN_ELASTIC_BASE_PACKAGE_DEPENDS "listric (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_ELASTIC_BASE_DESCRIPTION
  "Finite elements for scenes whose footwall and basement bend and float.")
set(CPACK_DEBIAN_RANKS_PACKAGE_NAME listric-ranks)
set(CPACK_DEBIAN_RANKS_PACKAGE_DEPENDS "listric (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_COMPONENT_RANKS_DESCRIPTION "Runs over MPI: a hanging wall in shares, with the same bits.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblistric-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers, for CMake projects.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libfmt-dev, libtomlplusplus-dev, nlohmann-json3-dev, libpugixml-dev, libhdf5-dev, zlib1g-dev, pkg-config")
include(CPack)
