# The ROS side: library, node, launch tests. Needs the target contact_path_core and messages.cmake.

add_library(contact_path_ros
  src/ros/bag_reader.cpp
  src/ros/bag_recorder.cpp
  src/ros/convert.cpp
  src/ros/increment_publisher.cpp
  src/ros/limits.cpp
  src/ros/memory_share.cpp
  src/ros/node_parameters.cpp
  src/ros/trace_action.cpp
  src/ros/trace_service.cpp
)
add_dependencies(contact_path_ros ${PROJECT_NAME}_generate_messages_cpp)
target_include_directories(contact_path_ros PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
# The generated headers, and those of ROS that they include.
#catkin_lint: ignore_once external_directory external_interface_path
target_include_directories(contact_path_ros SYSTEM
  PUBLIC ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
target_precompile_headers(contact_path_ros PRIVATE <ros/ros.h> <algorithm> <memory> <string> <vector>)
contact_path_join_sources(contact_path_ros)
target_link_libraries(contact_path_ros
  PUBLIC contact_path_core ${catkin_LIBRARIES}
  PRIVATE contact_path_mpec contact_path_warnings)

add_executable(contact_path_node src/ros/contact_path_node.cpp)
target_link_libraries(contact_path_node PRIVATE contact_path_process contact_path_ros contact_path_warnings)

add_executable(contact_path_verify src/ros/verify.cpp)
set_target_properties(contact_path_verify PROPERTIES OUTPUT_NAME verify)
target_include_directories(contact_path_verify SYSTEM PRIVATE ${CLI11_INCLUDE_DIR})
target_link_libraries(contact_path_verify PRIVATE contact_path_ros contact_path_warnings)

# With ROS the command-line program can record bags.
target_compile_definitions(contact_path_trace PRIVATE CONTACT_PATH_WITH_ROS)
target_link_libraries(contact_path_trace PRIVATE contact_path_ros)

set(contact_path_programs contact_path_node contact_path_trace contact_path_outlines
  contact_path_expand contact_path_response contact_path_study_server contact_path_verify)

# Programs and libraries find the libraries beside them wherever the tree is put.
set_target_properties(contact_path_ros contact_path_mpec PROPERTIES INSTALL_RPATH "$ORIGIN")
set_target_properties(${contact_path_programs} PROPERTIES INSTALL_RPATH "$ORIGIN/..")

# Where programs are, for tests.
set(contact_path_devel_programs ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

install(TARGETS contact_path_ros contact_path_mpec contact_path_core
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(TARGETS ${contact_path_programs}
  RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
catkin_install_python(PROGRAMS scripts/contact_path_markers scripts/contact_path_mesh scripts/contact_path_study scripts/play
  scripts/plot scripts/watch DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY config launch scenes DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES CHANGELOG.rst CITATION.cff LICENSE README.md DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY docs DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} FILES_MATCHING PATTERN *.md PATTERN *.png)

if(CATKIN_ENABLE_TESTING)
  find_package(rostest REQUIRED)

  set(contact_path_programs_directory "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/tests)  # as those of the core (tests.cmake)
  catkin_add_gtest(contact_path_ros_test
    test/ros/bag_recorder_test.cpp
    test/ros/bounded_stream_test.cpp
    test/ros/convert_test.cpp
    test/ros/goal_id_test.cpp
    test/ros/limits_test.cpp
    test/ros/memory_share_test.cpp
    test/ros/ros_test_main.cpp
  )
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${contact_path_programs_directory}")
  # For a quick build, as those of the core (tests.cmake).
  target_compile_options(contact_path_ros_test PRIVATE -O0 -g0)
  contact_path_join_sources(contact_path_ros_test)
  target_link_libraries(contact_path_ros_test contact_path_ros contact_path_test_support contact_path_warnings)

  # catkin runs tests in a snapshot of the environment from before the messages were generated; this one is read when
  # the tests run.
  set(CATKIN_ENV ${CATKIN_DEVEL_PREFIX}/env.sh)
  foreach(test markers python_client shutdown streaming trace_action trace_service)
    add_rostest(test/ros/${test}.test DEPENDENCIES contact_path_node contact_path_trace)
    # They wait for nodes: one at a time, the first of all tests.
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_ros_${test}.test PROPERTIES RESOURCE_LOCK contact_path_nodes COST 100)
  endforeach()
  # It keeps two processors busy itself, and asks what is lost beside them.
  set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_ros_streaming.test PROPERTIES PROCESSORS 2)
  unset(CATKIN_ENV)
endif()
