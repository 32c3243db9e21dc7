# What Debian asks of packages beside what an installation has (lintian): run by cpack before it packs
# the folder of each component.

# For all to read, whatever the umask.
set(for_all OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(share ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share)
  set(documents ${share}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  file(MAKE_DIRECTORY ${documents})
  file(REMOVE ${documents}/LICENSE ${documents}/CHANGELOG.md)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../LICENSE ${documents}/copyright
    COPYONLY FILE_PERMISSIONS ${for_all})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../CHANGELOG.md ${documents}/changelog
    COPYONLY FILE_PERMISSIONS ${for_all})
  file(GLOB pages ${share}/man/man1/*.1)
  execute_process(COMMAND gzip -n -9 -f ${documents}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  file(CHMOD_RECURSE ${CPACK_TEMPORARY_DIRECTORY}/${component} DIRECTORY_PERMISSIONS
    ${for_all} OWNER_EXECUTE GROUP_EXECUTE WORLD_EXECUTE)
endforeach()
