# What Debian asks of a package beside what an installation has (lintian): run by cpack on the folder of
# each component.

file(GLOB_RECURSE pages ${CPACK_TEMPORARY_DIRECTORY}/*/share/man/*.1)
file(GLOB_RECURSE changelogs ${CPACK_TEMPORARY_DIRECTORY}/*/share/doc/listric/CHANGELOG.md)
foreach(file ${changelogs})
  cmake_path(GET file PARENT_PATH folder)
  file(RENAME ${file} ${folder}/changelog)
  file(RENAME ${folder}/LICENSE ${folder}/copyright)
  list(APPEND pages ${folder}/changelog)
endforeach()
if(pages)
  execute_process(COMMAND gzip -n -9 -f ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()
