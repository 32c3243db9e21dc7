# What is installed beside the libraries: the program, what it reads, and what find_package reads.

include(CMakePackageConfigHelpers)

install(TARGETS listric RUNTIME COMPONENT program)
set(share ${CMAKE_INSTALL_DATADIR}/listric)
install(DIRECTORY apps/scenes apps/materials DESTINATION ${share} COMPONENT program)
install(DIRECTORY apps/studies/ DESTINATION ${share}/studies COMPONENT program
  FILES_MATCHING PATTERN *.toml)
install(DIRECTORY apps/records DESTINATION ${share} COMPONENT program FILES_MATCHING PATTERN *.csv)
# Where Debian's Python looks below /usr; elsewhere PYTHONPATH names the folder (docs/guides/python.md).
set(LISTRIC_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package goes, below the prefix")
# Made by the program from its own options: here, since what is built may be for another machine.
set(own_names --unset=LISTRIC_SHARE --unset=LISTRIC_SCENES --unset=LISTRIC_MATERIALS)
set(declarations ${PROJECT_BINARY_DIR}/declarations)
set(own "COMMAND \"${CMAKE_COMMAND}\" -E env ${own_names} LISTRIC_CALL=listric \"$<TARGET_FILE:listric>\"")
install(CODE "
  foreach(shell bash zsh fish)
    execute_process(${own} completion \${shell} OUTPUT_FILE \"${PROJECT_BINARY_DIR}/listric.\${shell}\"
      COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  execute_process(${own} manual OUTPUT_FILE \"${PROJECT_BINARY_DIR}/listric.1\"
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND \"${CMAKE_COMMAND}\" -D \"program=$<TARGET_FILE:listric>\"
    -D \"folder=${declarations}\" -P \"${PROJECT_SOURCE_DIR}/apps/declarations.cmake\" COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT program)
install(DIRECTORY ${declarations}/ DESTINATION ${share} COMPONENT program FILES_MATCHING PATTERN *.schema.json)
install(FILES ${declarations}/dictionary.json DESTINATION ${LISTRIC_PYTHON_FOLDER}/listric COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/listric.bash RENAME listric COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${PROJECT_BINARY_DIR}/listric.zsh RENAME _listric COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${PROJECT_BINARY_DIR}/listric.fish COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${PROJECT_BINARY_DIR}/listric.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
  COMPONENT program)
install(DIRECTORY apps/figures/python DESTINATION ${share}/figures COMPONENT program
  FILES_MATCHING PATTERN *.py)
install(DIRECTORY apps/figures/report apps/figures/draw DESTINATION ${share}/figures COMPONENT program)
install(DIRECTORY apps/page DESTINATION ${share} COMPONENT program
  FILES_MATCHING PATTERN module.js PATTERN worker.js PATTERN listric.wasm.gz)
install(FILES apps/figures/vocabulary.json DESTINATION ${share}/figures COMPONENT program)
install(FILES docs/reference/measures.md DESTINATION ${share} COMPONENT program)
install(DIRECTORY apps/python/listric DESTINATION ${LISTRIC_PYTHON_FOLDER} COMPONENT program
  FILES_MATCHING PATTERN *.py PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(TARGET listric_fem)
  install(TARGETS listric_fem LIBRARY DESTINATION ${plugin_folder} COMPONENT elastic_base)
endif()
if(TARGET listric_ranks)
  install(TARGETS listric_ranks LIBRARY DESTINATION ${plugin_folder} COMPONENT ranks)
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Listric)
install(DIRECTORY include/listric DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT listric NAMESPACE listric:: FILE ListricTargets.cmake DESTINATION ${package}
  COMPONENT development)
configure_package_config_file(cmake/ListricConfig.cmake.in ListricConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS share)
write_basic_package_version_file(ListricConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ListricConfig.cmake
  ${PROJECT_BINARY_DIR}/ListricConfigVersion.cmake DESTINATION ${package} COMPONENT development)

# Folders are made under the umask, and CMake cannot set another (debian_files.cmake mends packages).
install(CODE [[
  execute_process(COMMAND sh -c umask OUTPUT_VARIABLE umask OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT umask MATCHES "[02][02]$" AND NOT "$ENV{DESTDIR}" MATCHES "/_CPack_Packages/")
    message(WARNING "umask is ${umask}: new folders are closed to other users; where these shall run the "
      "program: chmod -R a+rX '$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}'")
  endif()]] ALL_COMPONENTS)

include(cmake/package.cmake)
