# The fuzz targets as libFuzzer programs; scripts/stress runs them. With CONTACT_PATH_SANITIZE they find more.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "CONTACT_PATH_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++")
endif()

# contact_path_add_fuzz_target(<target> <library> [source...]): test/fuzz/<target>_fuzz.cpp as fuzz_<target>.
function(contact_path_add_fuzz_target target library)
  add_executable(fuzz_${target} test/fuzz/${target}_fuzz.cpp ${ARGN})
  target_include_directories(fuzz_${target} PRIVATE test)
  target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
  target_link_libraries(fuzz_${target} PRIVATE ${library} contact_path_warnings)
endfunction()

contact_path_add_fuzz_target(read_scene contact_path_core test/support/same_request.cpp)
contact_path_add_fuzz_target(trace_scene contact_path_mpec test/fuzz/varied_request.cpp test/support/curved_obstacles.cpp test/support/random_bodies.cpp test/support/random_scene.cpp
  test/support/traced_path.cpp test/support/transformations.cpp)
target_link_libraries(fuzz_trace_scene PRIVATE GTest::gtest)
target_compile_definitions(fuzz_trace_scene PRIVATE CONTACT_PATH_QUICK_SCENES CONTACT_PATH_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes"
  CONTACT_PATH_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
if(CONTACT_PATH_ROS)
  # Of the ROS side only what it runs: the rest takes minutes to compile.
  contact_path_add_fuzz_target(convert_request contact_path_core src/ros/convert.cpp src/ros/limits.cpp src/ros/memory_share.cpp
    test/support/same_request.cpp)
  add_dependencies(fuzz_convert_request ${PROJECT_NAME}_generate_messages_cpp)
  #catkin_lint: ignore_once external_directory external_interface_path
  target_include_directories(fuzz_convert_request SYSTEM
    PRIVATE ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
  target_link_libraries(fuzz_convert_request PRIVATE ${catkin_LIBRARIES})
endif()
