# Libraries that others link as listric::NAME: from an installation (find_package(Listric)), or where
# this project is part of theirs (add_subdirectory, FetchContent).

include(GNUInstallDirs)
set(headers_folder ${CMAKE_INSTALL_INCLUDEDIR}/listric)
# Where an installed program finds its plug-ins, from its own folder.
set(plugin_folder ${CMAKE_INSTALL_LIBDIR}/listric)
cmake_path(RELATIVE_PATH plugin_folder BASE_DIRECTORY ${CMAKE_INSTALL_BINDIR}
  OUTPUT_VARIABLE plugins_from_program)

# What all of them hand on: the language, and flags without which inline functions of their headers
# would compute other bits.
add_library(listric_flags INTERFACE)
target_compile_features(listric_flags INTERFACE cxx_std_20)
target_compile_options(listric_flags INTERFACE ${floating_point_flags})

# Headers of the standard library that most sources include, for precompiled headers.
set(standard_headers <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string> <utility>
  <vector>)

# listric_balance(TARGET MOST): units of equal numbers of files, of MOST at most. In batches of one number the last unit
# may have a single file, and compile all headers and templates for it.
function(listric_balance target most)
  get_target_property(sources ${target} SOURCES)
  set(count 0)
  foreach(source ${sources})
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(NOT alone)
      math(EXPR count "${count} + 1")
    endif()
  endforeach()
  math(EXPR units "(${count} + ${most} - 1) / ${most}")
  if(units)
    math(EXPR batch "(${count} + ${units} - 1) / ${units}")
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

# listric_library(NAME SOURCES ... LINK ...): the static library listric_NAME. Headers include each
# other from the project's root.
function(listric_library name)
  cmake_parse_arguments(PARSE_ARGV 1 library "" "" "SOURCES;LINK")
  add_library(listric_${name} STATIC ${library_SOURCES})
  add_library(listric::${name} ALIAS listric_${name})
  listric_balance(listric_${name} 22)
  target_link_libraries(listric_${name} PUBLIC listric_flags ${library_LINK})
  target_include_directories(listric_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${headers_folder}>)
endfunction()

# listric_add_version(TARGET): gives it version.cpp, which is looked at in every build and written only when a value
# changed, so that a commit or an edit in dem recompiles this one file and not whatever includes version.hpp.
function(listric_add_version target)
  set(version_source ${CMAKE_CURRENT_BINARY_DIR}/version.cpp)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  list(JOIN floating_point_flags " " joined_flags)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${joined_flags}" build_flags)
  add_custom_target(listric_version
    COMMAND ${CMAKE_COMMAND}
      -D source=${PROJECT_SOURCE_DIR} -D output=${version_source}
      -D version=${PROJECT_VERSION} -D "compiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
      -D "build_flags=${build_flags}" -P ${PROJECT_SOURCE_DIR}/apps/support/version.cmake
    BYPRODUCTS ${version_source}
    COMMENT "Version"
    VERBATIM)
  set_source_files_properties(${version_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${version_source})
  add_dependencies(${target} listric_version)
endfunction()

# listric_install(NAME HEADERS...): installs the library and its public headers, paths below this
# folder. Those that it does not name are private.
function(listric_install name)
  set_target_properties(listric_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS listric_${name} EXPORT listric COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/listric)
  foreach(header ${ARGN})
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
      OUTPUT_VARIABLE folder)
    cmake_path(GET header PARENT_PATH below)
    install(FILES ${header} DESTINATION ${headers_folder}/${folder}/${below} COMPONENT development)
  endforeach()
endfunction()
listric_install(flags)
