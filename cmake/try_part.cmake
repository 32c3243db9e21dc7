# listric_try_part(NAME RESULT): whether cmake/parts/NAME.cmake finds what the plug-in NAME needs and
# NAME.cpp compiles with it. In a project of its own, since a part that is installed by halves ends
# the configuration of whatever asks for it (Open MPI's compiler without its headers ends
# find_package(MPI)), and a plug-in that cannot be built is no reason to build nothing.
function(listric_try_part name result)
  set(source ${PROJECT_SOURCE_DIR}/cmake/parts)
  set(build ${PROJECT_BINARY_DIR}/parts/${name})
  # What led here leads there.
  set(settings "")
  foreach(variable CMAKE_MAKE_PROGRAM CMAKE_CXX_COMPILER CMAKE_TOOLCHAIN_FILE CMAKE_PREFIX_PATH
      CMAKE_FIND_ROOT_PATH CMAKE_CXX_COMPILER_LAUNCHER deal.II_DIR DEAL_II_DIR MPI_HOME MPI_CXX_COMPILER)
    if(${variable})
      string(APPEND settings "set(${variable} [==[${${variable}}]==] CACHE STRING \"\")\n")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${build}/settings.cmake CONTENT "${settings}" @ONLY)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -G ${CMAKE_GENERATOR} -S ${source} -B ${build} -C ${build}/settings.cmake
      -D part=${name}
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT failed)
    execute_process(COMMAND ${CMAKE_COMMAND} --build ${build}
      RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  endif()
  if(failed)
    file(REMOVE_RECURSE ${build}) # looked for afresh, once it is installed
    file(WRITE ${build}.log "${said}")
    set(${result} OFF PARENT_SCOPE)
  else()
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()
