# listric_plugin(NAME ENTRY FUNCTION HEADERS ... SOURCES ... LINK ...): the plug-in listric_NAME. It is built where
# cmake/parts/NAME.cmake finds what it needs, unless the option LISTRIC_NAME is off. listric_loader() tells the one
# source that loads it where it is; no other is told, or each would be compiled anew for every folder.
function(listric_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 plugin "" "ENTRY" "HEADERS;SOURCES;LINK")
  string(TOUPPER "LISTRIC_${name}" prefix)
  # Program and plug-in meet only if both are of one interface.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${plugin_HEADERS})
  set(interface "")
  foreach(header ${plugin_HEADERS})
    file(SHA256 ${header} hash)
    string(APPEND interface ${hash})
  endforeach()
  string(SHA256 interface "${interface}")
  string(SUBSTRING ${interface} 0 12 interface)
  set(entry ${plugin_ENTRY}_${interface})
  set_property(GLOBAL PROPERTY ${prefix}_PLACE ${prefix}_ENTRY="${entry}"
    ${prefix}_INSTALLED="${plugins_from_program}/liblistric_${name}.so")

  if(${prefix})
    listric_try_part(${name} found)
  endif()
  if(NOT found)
    message(STATUS "No plug-in ${name}: ${prefix} is off, or see parts/${name}.log in the build folder")
    return()
  endif()
  include(${PROJECT_SOURCE_DIR}/cmake/parts/${name}.cmake)
  add_library(listric_${name} MODULE ${plugin_SOURCES})
  target_include_directories(listric_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(listric_${name} PRIVATE ${prefix}_ENTRY=${entry})
  set_target_properties(listric_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(listric_${name} PRIVATE ${plugin_LINK})
  use_part(listric_${name})
  set_property(GLOBAL APPEND PROPERTY ${prefix}_PLACE ${prefix}_PLUGIN="$<TARGET_FILE:listric_${name}>")
endfunction()

function(listric_loader name source)
  string(TOUPPER "LISTRIC_${name}_PLACE" place)
  get_property(definitions GLOBAL PROPERTY ${place})
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS ${definitions})
endfunction()
