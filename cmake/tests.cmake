# Tests of the core and of the command-line program: one for each x_test.cpp. They link the core alone.
#
# In a catkin build they are catkin's tests: built by the target `tests`, run by `run_tests` and by ctest. Otherwise they
# are built with everything else and run by ctest. Either way each leaves its results as XML, one file a test program, in
# test_results/ of the build directory. The label `long` marks what takes more than a few seconds; it can be left out.

option(CONTACT_PATH_LONG_TESTS "Build the tests that take more than a few seconds, too" ON)
find_program(CONTACT_PATH_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
if(CONTACT_PATH_ROS AND CATKIN_ENABLE_TESTING)
  set(contact_path_test_with_catkin ON)
  set(contact_path_test_results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME})
else()
  set(contact_path_test_with_catkin OFF)
  set(contact_path_test_results ${CMAKE_CURRENT_BINARY_DIR}/test_results/${PROJECT_NAME})
endif()

# Apart from the users' programs, which rosrun finds beside each other.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/tests)

add_library(contact_path_test_support STATIC EXCLUDE_FROM_ALL
  test/support/dense.cpp
  test/support/derivative_checker.cpp
  test/support/random_scene.cpp
  test/support/reference_cases.cpp
  test/support/same_request.cpp
  test/support/traced_path.cpp
  test/support/transformations.cpp
)
target_include_directories(contact_path_test_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/test)
target_compile_definitions(contact_path_test_support PUBLIC
  CONTACT_PATH_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes"
  CONTACT_PATH_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
# Tests are compiled for a quick build: hardly optimised, and what nearly all of them include is compiled once.
set(contact_path_test_options -O1 -g0)
target_compile_options(contact_path_test_support PRIVATE ${contact_path_test_options})
target_precompile_headers(contact_path_test_support PRIVATE <gtest/gtest.h> <Eigen/Core> <Eigen/SparseCore>
  <algorithm> <cmath> <functional> <map> <string> <vector>)
target_link_libraries(contact_path_test_support PUBLIC contact_path_core GTest::gtest PRIVATE contact_path_warnings)

# contact_path_add_test(<stage>/<name> [LONG]): test/<stage>/<name>.cpp, as the program <stage>_<name>.
function(contact_path_add_test source)
  cmake_parse_arguments(ARG "LONG" "" "" ${ARGN})
  if(ARG_LONG AND NOT CONTACT_PATH_LONG_TESTS)
    return()
  endif()
  string(REPLACE "/" "_" name ${source})
  if(contact_path_test_with_catkin)
    catkin_add_gtest(${name} test/${source}.cpp)
    set(test _ctest_${PROJECT_NAME}_gtest_${name})
  else()
    add_executable(${name} test/${source}.cpp)
    set(test ${name})
    add_test(NAME ${test} COMMAND ${name} --gtest_output=xml:${contact_path_test_results}/gtest-${name}.xml)
  endif()
  target_compile_options(${name} PRIVATE ${contact_path_test_options})
  target_precompile_headers(${name} REUSE_FROM contact_path_test_support)
  # Without a keyword, as catkin does.
  target_link_libraries(${name} GTest::gtest_main contact_path_test_support contact_path_core contact_path_warnings)
  set_property(TEST ${test} PROPERTY ENVIRONMENT OMP_NUM_THREADS=1)
  if(ARG_LONG)
    set_property(TEST ${test} PROPERTY LABELS long)
  endif()
endfunction()

set(contact_path_extremes
  test/extremes/contact_cases.cpp
  test/extremes/extreme_case.cpp
  test/extremes/friction_cases.cpp
  test/extremes/geometry_cases.cpp
  test/extremes/length_cases.cpp
  test/extremes/number_cases.cpp
  test/extremes/run_case.cpp)

# One for each header, but for those that only declare an interface: structure/element.h, mpec/nonlinear_program.h,
# path/path_method.h.
contact_path_add_test(support/derivative_checker_test)
contact_path_add_test(scene/lattice_test)
contact_path_add_test(scene/one_line_test)
contact_path_add_test(scene/read_scene_test)
contact_path_add_test(scene/scaling_test)
contact_path_add_test(scene/scene_test)
contact_path_add_test(scene/utf8_test)
contact_path_add_test(scene/validate_test)
contact_path_add_test(scene/write_scene_test)
contact_path_add_test(structure/bar_test)
contact_path_add_test(structure/structure_test)
contact_path_add_test(structure/superelement_test)
contact_path_add_test(linear/bordered_solver_test)
contact_path_add_test(linear/minimum_norm_test)
contact_path_add_test(linear/singular_vectors_test)
contact_path_add_test(contact/contact_pair_test)
contact_path_add_test(contact/contact_state_test)
contact_path_add_test(contact/rigid_pair_test)
contact_path_add_test(contact/scene_contacts_test)
contact_path_add_test(contact/surface_test)
contact_path_add_test(contact/path_point_test)
contact_path_add_test(equations/fixed_state_system_test)
contact_path_add_test(equations/nearest_point_test)
contact_path_add_test(mpec/increment_problem_test)
contact_path_add_test(mpec/increment_solver_test)
contact_path_add_test(mpec/ipopt_solver_test)
contact_path_add_test(mpec/short_increment_test)
contact_path_add_test(branch/polynomial_test)
contact_path_add_test(branch/rate_problem_test)
contact_path_add_test(branch/smooth_arc_test)
contact_path_add_test(branch/test_functions_test)
contact_path_add_test(branch/reaction_redistribution_test)
if(NOT CONTACT_PATH_SANITIZE)
  contact_path_add_test(branch/allocations_test)
endif()
contact_path_add_test(branch/branches_test LONG)
contact_path_add_test(verify/verify_path_test)
contact_path_add_test(cli/progress_test)
target_link_libraries(cli_progress_test contact_path_terminal)
# The whole branch method: closed forms and events of many kinds.
contact_path_add_test(branch/branch_method_test LONG)
contact_path_add_test(branch/branch_choices_test)
contact_path_add_test(branch/branch_events_test LONG)
# Random scenes, each traced in many ways: it lists every scene whose path depends on how it is traced.
contact_path_add_test(branch/random_paths_test LONG)
contact_path_add_test(check/residuals_test)
contact_path_add_test(path/csv_test)
contact_path_add_test(path/diagnosis_test)
contact_path_add_test(path/increment_test)
contact_path_add_test(path/model_test)
contact_path_add_test(path/redistribution_test)
contact_path_add_test(path/mpec_method_test LONG)
contact_path_add_test(path/path_summary_test)
contact_path_add_test(path/preload_test)
contact_path_add_test(path/program_test)
contact_path_add_test(path/progress_estimate_test)
contact_path_add_test(path/resume_test)
contact_path_add_test(path/stop_test)
contact_path_add_test(path/trace_test LONG)
contact_path_add_test(path/model_size_test)
contact_path_add_test(path/work_test)
# The whole tracer: the reference cases, what must not change a path, and what once went wrong.
contact_path_add_test(path/mpec_cases_test LONG)
contact_path_add_test(path/mpec_random_paths_test LONG)
contact_path_add_test(path/invariance_test LONG)
contact_path_add_test(path/hard_scenes_test)
contact_path_add_test(path/determinism_test)
contact_path_add_test(path/large_requests_test)
contact_path_add_test(extremes/extremes_test LONG)
if(CONTACT_PATH_LONG_TESTS)
  target_sources(extremes_extremes_test PRIVATE ${contact_path_extremes})
endif()
# What scripts/stress writes docs/extremes.md with.
add_executable(contact_path_extremes EXCLUDE_FROM_ALL test/extremes/extremes_table.cpp ${contact_path_extremes})
target_precompile_headers(contact_path_extremes REUSE_FROM contact_path_test_support)
target_compile_options(contact_path_extremes PRIVATE ${contact_path_test_options})
target_link_libraries(contact_path_extremes PRIVATE contact_path_test_support contact_path_core contact_path_warnings)

# contact_path_add_replay(<target> <library> <count> [source...]): runs test/fuzz/<target>_fuzz.cpp over its corpus, and over
# so many random changes of it.
function(contact_path_add_replay target library count)
  set(name fuzz_${target})
  set(sources test/fuzz/replay_test.cpp test/fuzz/${target}_fuzz.cpp ${ARGN})
  if(contact_path_test_with_catkin)
    catkin_add_gtest(${name} ${sources})
    set(test _ctest_${PROJECT_NAME}_gtest_${name})
  else()
    add_executable(${name} ${sources})
    set(test ${name})
    add_test(NAME ${test} COMMAND ${name} --gtest_output=xml:${contact_path_test_results}/gtest-${name}.xml)
  endif()
  target_compile_options(${name} PRIVATE ${contact_path_test_options})
  target_compile_definitions(${name} PRIVATE CONTACT_PATH_CHANGED=${count}
    CONTACT_PATH_CORPUS="${CMAKE_CURRENT_SOURCE_DIR}/test/fuzz/corpus/${target}")
  target_link_libraries(${name} GTest::gtest_main contact_path_test_support ${library} contact_path_warnings)
  set_property(TEST ${test} PROPERTY ENVIRONMENT OMP_NUM_THREADS=1)
endfunction()

contact_path_add_replay(read_scene contact_path_core 20000)
contact_path_add_replay(trace_scene contact_path_core 100 test/fuzz/varied_request.cpp)
if(CONTACT_PATH_ROS)
  contact_path_add_replay(convert_request contact_path_ros 20000)
endif()

# contact_path_add_python_test(<name> <file> DEPENDS target... VARIABLES NAME=VALUE...): unittests that run programs as
# their users do, told where these are by environment variables.
function(contact_path_add_python_test name file)
  cmake_parse_arguments(ARG "" "" "DEPENDS;VARIABLES" ${ARGN})
  set(command ${CONTACT_PATH_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/support/run_unittest.py
    ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${contact_path_test_results}/python-${name}.xml
    CONTACT_PATH_SCENES=${CMAKE_CURRENT_SOURCE_DIR}/scenes ${ARG_VARIABLES})
  if(contact_path_test_with_catkin)
    string(REPLACE ";" " " command "${command}")
    catkin_run_tests_target("python" ${name} python-${name}.xml COMMAND ${command} DEPENDENCIES ${ARG_DEPENDS})
  else()
    add_test(NAME ${name} COMMAND ${command})
  endif()
endfunction()

contact_path_add_python_test(cli_test test/cli/cli_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
contact_path_add_python_test(determinism_test test/cli/determinism_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
contact_path_add_python_test(plot_test test/cli/plot_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_PLOT=${CMAKE_CURRENT_SOURCE_DIR}/scripts/plot)
if(CONTACT_PATH_ROS)
  foreach(test resume_test verify_test)
    contact_path_add_python_test(${test} test/ros/${test}.py DEPENDS contact_path_trace contact_path_verify
      VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_VERIFY=$<TARGET_FILE:contact_path_verify>)
  endforeach()
  contact_path_add_python_test(plot_bag_test test/ros/plot_bag_test.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_PLOT=${contact_path_devel_programs}/plot)
  set(contact_path_all_programs contact_path_trace contact_path_lattice contact_path_node
    contact_path_markers contact_path_verify ${PROJECT_NAME}_generate_messages)
  contact_path_add_python_test(docs_test test/docs/docs_test.py DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_PROGRAMS=${contact_path_devel_programs}
      CONTACT_PATH_MODULES=${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
  contact_path_add_python_test(service_stress_test test/stress/service_stress_test.py
    DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR})
  if(contact_path_test_with_catkin)
    # It waits for nodes: nothing beside it.
    set_property(TEST _ctest_${PROJECT_NAME}_python_service_stress_test PROPERTY RUN_SERIAL ON)
  endif()
  contact_path_add_python_test(install_test test/install/install_test.py DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR})
endif()
