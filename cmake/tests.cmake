# Tests of the core and of the command-line program: one program a stage, and one for each long test. They link the core alone.
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
  test/support/curved_obstacles.cpp
  test/support/random_bodies.cpp
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
if(CONTACT_PATH_SANITIZE MATCHES address)
  # What they call is watched, they themselves are not, which halves the time that they take to compile.
  set(contact_path_test_options -O0 -g0 -fno-sanitize=all)
endif()
target_compile_options(contact_path_test_support PRIVATE ${contact_path_test_options})
target_precompile_headers(contact_path_test_support PRIVATE <gtest/gtest.h> <Eigen/Core> <Eigen/SparseCore>
  <algorithm> <cmath> <functional> <map> <string> <vector>)
target_link_libraries(contact_path_test_support PUBLIC contact_path_core GTest::gtest PRIVATE contact_path_warnings)

# contact_path_add_gtest(<name> <source>...): one test program.
function(contact_path_add_gtest name)
  if(contact_path_test_with_catkin)
    catkin_add_gtest(${name} ${ARGN})
    set(test _ctest_${PROJECT_NAME}_gtest_${name})
  else()
    add_executable(${name} ${ARGN})
    set(test ${name})
    add_test(NAME ${test} COMMAND ${name} --gtest_output=xml:${contact_path_test_results}/gtest-${name}.xml)
  endif()
  target_compile_options(${name} PRIVATE ${contact_path_test_options})
  target_precompile_headers(${name} REUSE_FROM contact_path_test_support)
  # Without a keyword, as catkin does.
  target_link_libraries(${name} GTest::gtest_main contact_path_test_support contact_path_core contact_path_warnings)
  set_property(TEST ${test} PROPERTY ENVIRONMENT OMP_NUM_THREADS=1)
endfunction()

# contact_path_add_stage(<stage> <name>...): the short tests test/<stage>/<name>.cpp of a stage, as one program <stage>_tests.
function(contact_path_add_stage stage)
  list(TRANSFORM ARGN REPLACE "(.+)" "test/${stage}/\\1.cpp" OUTPUT_VARIABLE sources)
  contact_path_add_gtest(${stage}_tests ${sources})
endfunction()

# contact_path_add_long_test(<stage> <name> [<source>...]): test/<stage>/<name>.cpp, which takes more than a few seconds, as a
# program of its own, so that long tests run side by side.
function(contact_path_add_long_test stage name)
  if(NOT CONTACT_PATH_LONG_TESTS)
    return()
  endif()
  contact_path_add_gtest(${stage}_${name} test/${stage}/${name}.cpp ${ARGN})
  if(contact_path_test_with_catkin)
    set_property(TEST _ctest_${PROJECT_NAME}_gtest_${stage}_${name} PROPERTY LABELS long)
  else()
    set_property(TEST ${stage}_${name} PROPERTY LABELS long)
  endif()
endfunction()

set(contact_path_extremes
  test/extremes/contact_cases.cpp
  test/extremes/curve_cases.cpp
  test/extremes/deformable_cases.cpp
  test/extremes/extreme_case.cpp
  test/extremes/frame_cases.cpp
  test/extremes/friction_cases.cpp
  test/extremes/geometry_cases.cpp
  test/extremes/length_cases.cpp
  test/extremes/number_cases.cpp
  test/extremes/run_case.cpp
  test/extremes/solid_cases.cpp)

# A file for each header, except headers that only declare an interface (structure/element.h, mpec/nonlinear_program.h,
# path/path_method.h), and files that trace whole paths.
contact_path_add_stage(support derivative_checker_test)
contact_path_add_stage(geometry admissible_patches_test curve_test capsule_tree_test nodal_spline_test outline_test polyline_test projection_test spline_test surface_test)
contact_path_add_stage(scene boundary_rules_test can_slide_test cell_test change_units_test configuration_test curve_rules_test element_names_test expand_test field_test lattice_test nearest_name_test
  number_text_test one_line_test origin_test quantity_test reacting_parts_test read_scene_test request_field_test scaling_test scene_index_test scene_test solid_rules_test utf8_test
  validate_test violation_test write_scene_test)
contact_path_add_stage(structure bar_test beam_test dof_map_test elastica_test material_test scene_elements_test solid_test structure_test
  superelement_test)
contact_path_add_stage(linear blas_test bordered_solver_test generic_vector_test minimum_norm_test out_of_memory_test singular_vectors_test symmetric_factors_test)
find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig REQUIRED)
target_include_directories(linear_tests SYSTEM PRIVATE ${SUITESPARSE_INCLUDE_DIR})
target_link_libraries(linear_tests ${SUITESPARSECONFIG_LIBRARY})
contact_path_add_stage(contact contact_pair_test contact_state_test deformable_boundary_test deformable_pair_test path_point_test reach_tracker_test rigid_pair_test scene_contacts_test)
contact_path_add_stage(equations deformable_system_test fixed_state_system_test nearest_point_test rigid_modes_test)
contact_path_add_stage(stability jump_test slip_stability_test stability_problem_test)
contact_path_add_stage(mpec increment_problem_test increment_solver_test ipopt_solver_test short_increment_test)
contact_path_add_stage(branch arc_step_test branch_choices_test branch_order_test complementarity_test crossing_test curved_surface_test
  gauss_rule_test patches_test pivoting_test plane_tangents_test polynomial_test rate_problem_test reaction_redistribution_test
  redundant_contacts_test smooth_arc_test state_options_test tangents_test test_functions_test)
if(NOT CONTACT_PATH_SANITIZE)
  # It counts allocations, in place of the allocator that a sanitizer brings.
  contact_path_add_gtest(branch_allocations_test test/branch/allocations_test.cpp)
endif()
contact_path_add_long_test(branch branch_events_test)
contact_path_add_long_test(branch branch_method_test)
contact_path_add_long_test(branch branches_test)
contact_path_add_long_test(branch random_paths_test)
contact_path_add_stage(response closed_forms_test contact_pressure_test element_response_test reactions_test)
contact_path_add_stage(check answers_test boundary_residuals_test curved_residuals_test residuals_test solid_residuals_test)
contact_path_add_stage(path automatic_step_test branch_options_test csv_test determinism_test diagnosis_test end_test free_motion_test
  hard_scenes_test increment_lists_test increment_test large_requests_test largest_reaction_test model_size_test model_test path_summary_test preload_test
  program_test progress_estimate_test redistribution_test restored_states_test return_detector_test
  samples_test singular_scenes_test stop_test work_test)
contact_path_add_long_test(path curved_paths_test)
contact_path_add_long_test(path curved_random_paths_test)
contact_path_add_long_test(path curved_scenes_test)
contact_path_add_long_test(path deformable_random_paths_test)
contact_path_add_long_test(path deformable_scenes_test)
contact_path_add_long_test(path frames_on_curves_test)
contact_path_add_long_test(path invariance_test)
contact_path_add_long_test(path jump_paths_test)
contact_path_add_long_test(path total_law_test)
contact_path_add_long_test(path certified_paths_test)
contact_path_add_long_test(path mpec_cases_test)
contact_path_add_long_test(path mpec_method_test)
contact_path_add_long_test(path mpec_random_paths_test)
contact_path_add_long_test(path own_surface_test)
contact_path_add_long_test(path parts_on_contacts_test)
contact_path_add_long_test(path polygon_disc_test)
contact_path_add_long_test(path resume_test)
contact_path_add_long_test(path sizes_test)
contact_path_add_long_test(path surface_scenes_test)
contact_path_add_long_test(path beam_paths_test)
contact_path_add_long_test(path solid_paths_test)
contact_path_add_long_test(path trace_test)
contact_path_add_stage(study path_column_test study_outputs_test)
contact_path_add_stage(verify verify_end_test verify_events_test verify_path_test)
contact_path_add_stage(cli event_table_test progress_test)
target_link_libraries(cli_tests contact_path_terminal)
contact_path_add_long_test(extremes extremes_test ${contact_path_extremes})
# What scripts/stress writes docs/maintainers/extremes.md with.
add_executable(contact_path_extremes EXCLUDE_FROM_ALL test/extremes/extremes_table.cpp ${contact_path_extremes})
target_precompile_headers(contact_path_extremes REUSE_FROM contact_path_test_support)
target_compile_options(contact_path_extremes PRIVATE ${contact_path_test_options})
target_link_libraries(contact_path_extremes PRIVATE contact_path_test_support contact_path_core contact_path_warnings)

# contact_path_add_replay(<target> <library> <count> [source...]): runs test/fuzz/<target>_fuzz.cpp over its corpus, and over
# so many random changes of it.
function(contact_path_add_replay target library count)
  set(name fuzz_${target})
  contact_path_add_gtest(${name} test/fuzz/replay_test.cpp test/fuzz/${target}_fuzz.cpp ${ARGN})
  target_compile_definitions(${name} PRIVATE CONTACT_PATH_CHANGED=${count}
    CONTACT_PATH_CORPUS="${CMAKE_CURRENT_SOURCE_DIR}/test/fuzz/corpus/${target}")
  target_link_libraries(${name} ${library})
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
    set_property(TEST ${name} PROPERTY LABELS python)
  endif()
endfunction()

contact_path_add_python_test(cli_test test/cli/cli_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
contact_path_add_python_test(no_blas_test test/cli/no_blas_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_TEST_DATA=${CMAKE_CURRENT_SOURCE_DIR}/test/data)
contact_path_add_python_test(determinism_test test/cli/determinism_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
contact_path_add_python_test(plot_test test/cli/plot_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_PLOT=${CMAKE_CURRENT_SOURCE_DIR}/scripts/plot)
contact_path_add_python_test(expand_test test/cli/expand_test.py DEPENDS contact_path_trace contact_path_expand contact_path_response
  VARIABLES CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
contact_path_add_python_test(mesh_test test/cli/mesh_test.py
  VARIABLES CONTACT_PATH_MESH=${CMAKE_CURRENT_SOURCE_DIR}/scripts/contact_path_mesh)
contact_path_add_python_test(study_test test/cli/study_test.py DEPENDS contact_path_trace contact_path_study_server
  VARIABLES CONTACT_PATH_STUDY=${CMAKE_CURRENT_SOURCE_DIR}/scripts/contact_path_study CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR}
    CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
if(CONTACT_PATH_LONG_TESTS)
  contact_path_add_python_test(perturb_test test/stress/perturb_test.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
  if(contact_path_test_with_catkin)
    set_property(TEST _ctest_${PROJECT_NAME}_python_perturb_test PROPERTY LABELS long)
  else()
    set_property(TEST perturb_test APPEND PROPERTY LABELS long)
  endif()
endif()
foreach(test answers_test imports_test signatures_test scene_test path_test page_test page_study_test surface_curves_test trace_test
    doctest_test)
  contact_path_add_python_test(python_${test} test/python/${test}.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
endforeach()
if(CONTACT_PATH_ROS)
  foreach(test resume_test verify_test)
    contact_path_add_python_test(${test} test/ros/${test}.py DEPENDS contact_path_trace contact_path_verify
      VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_VERIFY=$<TARGET_FILE:contact_path_verify>)
  endforeach()
  contact_path_add_python_test(run_built_test test/ros/run_built_test.py
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR})
  contact_path_add_python_test(plot_bag_test test/ros/plot_bag_test.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_PLOT=${contact_path_devel_programs}/plot)
  contact_path_add_python_test(path_bag_test test/ros/path_bag_test.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR}
      CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
  set(contact_path_all_programs ${contact_path_programs} ${PROJECT_NAME}_generate_messages)
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
  contact_path_add_python_test(enumerate_branches_test test/stress/enumerate_branches_test.py)
  contact_path_add_python_test(install_test test/install/install_test.py DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR})
  if(CMAKE_SOURCE_DIR STREQUAL CMAKE_CURRENT_SOURCE_DIR)  # as package.cmake
    contact_path_add_python_test(package_test test/install/package_test.py DEPENDS ${contact_path_all_programs}
      VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR}
        CONTACT_PATH_PROGRAMS=${contact_path_devel_programs})
    if(contact_path_test_with_catkin)
      # Both install, which sets the Python package up in the build tree.
      set_property(TEST _ctest_${PROJECT_NAME}_python_install_test _ctest_${PROJECT_NAME}_python_package_test
        PROPERTY RESOURCE_LOCK contact_path_install)
    else()
      set_property(TEST install_test package_test PROPERTY RESOURCE_LOCK contact_path_install)
    endif()
  endif()
endif()
