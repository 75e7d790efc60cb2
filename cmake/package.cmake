# The Debian package, which the target `package` makes: scripts/build package. Its files are where those of ROS are: below /usr with
# Debian's own ROS, below /opt/ros/noetic with that of ROS.
#catkin_lint: skip
if(EXISTS "/opt/ros/noetic")
  set(CPACK_PACKAGING_INSTALL_PREFIX /opt/ros/noetic)
  set(contact_path_ros_names actionlib actionlib-msgs message-runtime rosbag rosbash roslaunch rosmaster rosmsg rosnode rosout
    rospy rosservice rostopic std-msgs std-srvs visualization-msgs)
  list(TRANSFORM contact_path_ros_names PREPEND ros-noetic-)
  set(contact_path_build_names ros-noetic-catkin ros-noetic-roscpp)
else()
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(contact_path_ros_names actionlib actionlib-msgs rosbag roslaunch rosmaster rosmsg rosnode rospy rosservice rostopic
    std-msgs std-srvs visualization-msgs)
  list(TRANSFORM contact_path_ros_names PREPEND python3-)
  list(APPEND contact_path_ros_names ros-actionlib-msgs ros-std-msgs rosbash rosout)
  set(contact_path_build_names catkin libactionlib-dev libactionlib-msgs-dev librosbag-dev libroscpp-dev libstd-msgs-dev
    libstd-srvs-dev ros-message-runtime)
endif()
# What the Python package imports at once it depends on, and the libraries that the programs load. Plots, meshes, studies and the
# node want more, which apt installs unless it is told not to; whoever compiles with the library knows what for.
set(contact_path_recommended_names libopenblas0-serial python3-dask python3-distributed python3-matplotlib python3-meshio
  ${contact_path_ros_names})
list(APPEND contact_path_build_names libeigen3-dev)

string(REGEX MATCH "<maintainer email=\"([^\"]+)\">([^<]+)</maintainer>" contact_path_maintainer "${contact_path_package_xml}")
set(CPACK_PACKAGE_CONTACT "${CMAKE_MATCH_2} <${CMAKE_MATCH_1}>")
string(REGEX MATCH "<description>([^<]+)</description>" contact_path_description "${contact_path_package_xml}")
string(REGEX REPLACE "\n +" "\n" contact_path_description "${CMAKE_MATCH_1}")
string(STRIP "${contact_path_description}" CPACK_DEBIAN_PACKAGE_DESCRIPTION)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME contact-path)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "equilibrium paths of plane elastic structures with contact and friction")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy, python3-yaml")
string(REPLACE ";" ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS "${contact_path_recommended_names}")
string(REPLACE ";" ", " CPACK_DEBIAN_PACKAGE_SUGGESTS "${contact_path_build_names}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian/postinst
  ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian/prerm ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# What is built is taken as it is: CPack's own way runs make first, and leaves catkin's files the prefix of the build tree.
set(CPACK_INSTALL_CMAKE_PROJECTS "")
set(CPACK_INSTALL_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package_files.cmake)
set(CPACK_CONTACT_PATH_BUILD ${CMAKE_BINARY_DIR})
set(CPACK_CONTACT_PATH_BUILD_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_CONTACT_PATH_SOURCES ${CMAKE_CURRENT_SOURCE_DIR})
include(CPack)
