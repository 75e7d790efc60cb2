# Run by CPack: lays the files of the Debian package out below CPACK_TEMPORARY_DIRECTORY, which CPack empties and packs.
if(NOT IS_DIRECTORY "${CPACK_TEMPORARY_DIRECTORY}")
  message(FATAL_ERROR "${CMAKE_CURRENT_LIST_FILE} is for CPack")
endif()
set(packed ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX})

# installed/ is as `cmake --install` leaves it, below the prefix of the build tree.
set(installed ${CPACK_TEMPORARY_DIRECTORY}-installed)
file(REMOVE_RECURSE ${installed})
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env DESTDIR=${installed} ${CMAKE_COMMAND} --install ${CPACK_CONTACT_PATH_BUILD} --strip
  RESULT_VARIABLE failed OUTPUT_VARIABLE told ERROR_VARIABLE told)
if(failed)
  message(FATAL_ERROR "${told}")
endif()
# The files that a user's mask has hidden are for all who use the package.
execute_process(COMMAND chmod -R u=rwX,go=rX ${installed})

# Without catkin's set-up files, of which ROS has its own, and without Python's caches, which the package makes where it is installed.
set(tree ${installed}${CPACK_CONTACT_PATH_BUILD_PREFIX})
file(COPY ${tree}/include ${tree}/lib ${tree}/share DESTINATION ${packed} PATTERN __pycache__ EXCLUDE)
file(REMOVE_RECURSE ${installed})

foreach(file share/contact_path/cmake/contact_pathConfig.cmake lib/pkgconfig/contact_path.pc)
  file(READ ${packed}/${file} text)
  string(REPLACE "${CPACK_CONTACT_PATH_BUILD_PREFIX}" "${CPACK_PACKAGING_INSTALL_PREFIX}" text "${text}")
  file(WRITE ${packed}/${file} "${text}")
endforeach()

# Programs that need no ROS are found without rosrun, too. Other packages may want the names `plot` and `verify`.
file(MAKE_DIRECTORY ${packed}/bin)
foreach(program contact_path_expand contact_path_mesh contact_path_outlines contact_path_response
    contact_path_study contact_path_trace)
  file(CREATE_LINK ../lib/contact_path/${program} ${packed}/bin/${program} SYMBOLIC)
endforeach()
foreach(program plot verify)
  file(CREATE_LINK ../lib/contact_path/${program} ${packed}/bin/contact_path_${program} SYMBOLIC)
endforeach()

# Debian has the licences of all packages in one place, whatever their prefix.
configure_file(${CPACK_CONTACT_PATH_SOURCES}/LICENSE ${CPACK_TEMPORARY_DIRECTORY}/usr/share/doc/${CPACK_PACKAGE_NAME}/copyright
  COPYONLY)
