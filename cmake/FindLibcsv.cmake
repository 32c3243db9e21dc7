# libcsv reads CSV as RFC 4180 has it. It comes without a file for pkg-config or CMake. The static
# library comes first, so that a program travels without it.
find_path(LIBCSV_INCLUDE csv.h)
find_library(LIBCSV_LIBRARY NAMES libcsv.a csv)
mark_as_advanced(LIBCSV_INCLUDE LIBCSV_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Libcsv REQUIRED_VARS LIBCSV_LIBRARY LIBCSV_INCLUDE
  REASON_FAILURE_MESSAGE "install libcsv-dev (Debian, Ubuntu) or libcsv-devel (Fedora)")
if(Libcsv_FOUND AND NOT TARGET Libcsv::Libcsv)
  add_library(Libcsv::Libcsv UNKNOWN IMPORTED)
  set_target_properties(Libcsv::Libcsv PROPERTIES IMPORTED_LOCATION ${LIBCSV_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LIBCSV_INCLUDE})
endif()
