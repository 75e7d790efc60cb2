# Install rules without ROS: the library with its headers, the command-line programs, the scenes.
include(GNUInstallDirs)
install(TARGETS contact_path_core contact_path_mpec contact_path_trace contact_path_outlines contact_path_expand contact_path_response contact_path_study_server
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/${PROJECT_NAME} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} PATTERN ros EXCLUDE)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})
