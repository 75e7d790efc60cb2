# The Python package, the messages, and what other packages get from this one. catkin_package() also decides where libraries
# and programs go, so it comes before any target.

# The Python package, whose directory the messages share.
catkin_python_setup()

file(GLOB contact_path_messages RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/msg CONFIGURE_DEPENDS msg/*.msg)
add_message_files(FILES ${contact_path_messages})
add_service_files(FILES TracePath.srv)
add_action_files(FILES TracePath.action)
generate_messages(DEPENDENCIES actionlib_msgs std_msgs)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES contact_path_ros contact_path_mpec contact_path_core
  CATKIN_DEPENDS actionlib actionlib_msgs message_runtime rosbag roscpp std_msgs std_srvs
  DEPENDS EIGEN3
)
