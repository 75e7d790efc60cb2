# Tests of the core and of the command-line program: one program a stage. They link the core and method mpec alone.
#
# In a catkin build they are catkin's tests: built by the target `tests`, run by `run_tests` and by ctest. Otherwise they
# are built with everything else and run by ctest. Either way each leaves its results as XML, one file a process, in
# test_results/ of the build directory. The label `long` is of what scripts/test leaves to scripts/stress: tests whose names
# begin with Long (test_long in Python), and those of random scenes again, with all of their seeds (support/seeds.h).

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
  bench/lattice.cpp
  test/support/dense.cpp
  test/support/derivative_checker.cpp
  test/support/curved_obstacles.cpp
  test/support/filled_request.cpp
  test/support/random_bodies.cpp
  test/support/random_scene.cpp
  test/support/reference_cases.cpp
  test/support/same_request.cpp
  test/support/traced_path.cpp
  test/support/transformations.cpp
)
target_include_directories(contact_path_test_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/test ${CMAKE_CURRENT_SOURCE_DIR}/bench)
target_compile_definitions(contact_path_test_support PUBLIC
  CONTACT_PATH_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes"
  CONTACT_PATH_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
# Tests are compiled for a quick build: not optimised, and what nearly all of them include is compiled once.
set(contact_path_test_options -O0 -g0)
if(CONTACT_PATH_SANITIZE MATCHES address)
  # What they call is watched, they themselves are not, which halves the time that they take to compile.
  set(contact_path_test_options -O0 -g0 -fno-sanitize=all)
endif()
target_compile_options(contact_path_test_support PRIVATE ${contact_path_test_options})
target_precompile_headers(contact_path_test_support PRIVATE <gtest/gtest.h> <Eigen/Core> <Eigen/SparseCore>
  <algorithm> <cmath> <functional> <map> <string> <vector>)
target_link_libraries(contact_path_test_support PUBLIC contact_path_mpec contact_path_core GTest::gtest PRIVATE contact_path_warnings)

# contact_path_add_processes(<type> <name> <shards> <depends> <command>...): so many tests that share the tests of one command; the path
# of the results is put behind its last word. Where several run side by side, those that take longest are to start first.
function(contact_path_add_processes type name shards depends)
  foreach(shard RANGE 1 ${shards})
    set(test ${name})
    if(shards GREATER 1)
      set(test ${name}_${shard})
    endif()
    math(EXPR index "${shard} - 1")
    set(environment OMP_NUM_THREADS=1)
    if(name MATCHES "_long$")
      list(APPEND environment CONTACT_PATH_LONG=1)
    endif()
    set(command env ${environment} GTEST_TOTAL_SHARDS=${shards} GTEST_SHARD_INDEX=${index}
      ${ARGN}${contact_path_test_results}/${type}-${test}.xml)
    if(contact_path_test_with_catkin)
      string(REPLACE ";" " " command "${command}")
      catkin_run_tests_target(${type} ${test} ${type}-${test}.xml COMMAND ${command} DEPENDENCIES ${depends})
      set(test _ctest_${PROJECT_NAME}_${type}_${test})
    else()
      add_test(NAME ${test} COMMAND ${command})
    endif()
    set_property(TEST ${test} PROPERTY COST ${shards})
    if(name MATCHES "_long$")
      set_property(TEST ${test} PROPERTY LABELS long)
    elseif(type STREQUAL "python")
      set_property(TEST ${test} PROPERTY LABELS python)
    endif()
  endforeach()
endfunction()

# contact_path_add_gtest(<name> [LONG] [OPTIMISED] [SHARDS <count>] SOURCES <source>...): one test program, which so many processes
# run side by side. LONG: it has tests that scripts/stress alone runs. OPTIMISED: its sources are, where that takes less time in
# sum. They are compiled as one where CONTACT_PATH_JOIN_SOURCES is on: each has a namespace of its own.
function(contact_path_add_gtest name)
  cmake_parse_arguments(ARG "LONG;OPTIMISED" "SHARDS" "SOURCES" SHARDS 1 ${ARGN})
  if(contact_path_test_with_catkin)
    catkin_add_executable_with_gtest(${name} ${ARG_SOURCES} EXCLUDE_FROM_ALL)
    add_dependencies(tests ${name})
  else()
    add_executable(${name} ${ARG_SOURCES})
  endif()
  contact_path_join_sources(${name})
  if(ARG_OPTIMISED)
    target_compile_options(${name} PRIVATE -O1 -g0)
  else()
    target_compile_options(${name} PRIVATE ${contact_path_test_options})
    target_precompile_headers(${name} REUSE_FROM contact_path_test_support)
  endif()
  # Without a keyword, as catkin does.
  target_link_libraries(${name} GTest::gtest_main contact_path_test_support contact_path_core contact_path_warnings)
  contact_path_add_processes(gtest ${name} ${ARG_SHARDS} ${name} $<TARGET_FILE:${name}> --gtest_brief=1 --gtest_filter=-*.Long*
    --gtest_output=xml:)
  if(ARG_LONG)
    contact_path_add_processes(gtest ${name}_long 1 ${name} $<TARGET_FILE:${name}> --gtest_brief=1 --gtest_filter=*.Long*:*Random*
      --gtest_output=xml:)
  endif()
endfunction()

# contact_path_add_stage(<stage> [LONG] [SHARDS <count>] NAMES <name>...): the tests test/<stage>/<name>.cpp, as one program <stage>_tests.
function(contact_path_add_stage stage)
  cmake_parse_arguments(ARG "" "" "NAMES" ${ARGN})
  list(TRANSFORM ARG_NAMES REPLACE "(.+)" "test/${stage}/\\1.cpp" OUTPUT_VARIABLE sources)
  contact_path_add_gtest(${stage}_tests ${ARG_UNPARSED_ARGUMENTS} SOURCES ${sources})
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
contact_path_add_stage(support NAMES derivative_checker_test)
contact_path_add_stage(geometry NAMES admissible_patches_test capsule_tree_test curve_test nodal_spline_test outline_test polyline_test
  spline_test surface_test)
contact_path_add_stage(scene NAMES boundary_rules_test can_slide_test cell_test change_units_test curve_rules_test
  element_names_test expand_test field_test nearest_name_test text_test origin_test quantity_test
  part_rules_test program_rules_test reacting_parts_test read_scene_test read_scene_violations_test request_field_test scaling_test
  scene_test scenes_test solid_rules_test validate_test violation_test write_scene_test)
contact_path_add_stage(structure NAMES attached_element_test bar_test beam_test elastica_test material_test solid_test
  structure_test)
contact_path_add_stage(linear NAMES blas_test bordered_solver_test minimum_norm_test out_of_memory_test
  symmetric_factors_test)
find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig REQUIRED)
target_include_directories(linear_tests SYSTEM PRIVATE ${SUITESPARSE_INCLUDE_DIR})
target_link_libraries(linear_tests ${SUITESPARSECONFIG_LIBRARY})
contact_path_add_stage(law NAMES moving_place_test slack_bar_test tendon_span_test toy_law_test)
contact_path_add_stage(contact NAMES contact_pair_test deformable_boundary_test deformable_pair_test
  reach_tracker_test rigid_pair_test scene_contacts_test)
contact_path_add_stage(equations OPTIMISED NAMES deformable_system_test fixed_mode_system_test nearest_point_test rigid_modes_test)
contact_path_add_stage(stability LONG OPTIMISED NAMES jump_landings_test jump_test onset_test slip_stability_test
  stability_problem_test verdicts_test)
contact_path_add_stage(mpec NAMES increment_kinds_test increment_problem_test increment_solver_test ipopt_solver_test)
contact_path_add_stage(branch LONG SHARDS 2 NAMES branch_choices_test branch_events_test branch_method_test branch_order_test
  branches_test complementarity_test crossing_test curved_surface_test leaning_blocks_test polynomial_test
  random_paths_test force_redistribution_test toys_test)
if(NOT CONTACT_PATH_SANITIZE)
  # It counts allocations, in place of the allocator that a sanitizer brings.
  contact_path_add_gtest(branch_allocations_test SOURCES test/branch/allocations_test.cpp)
endif()
contact_path_add_stage(response NAMES closed_forms_test contact_pressure_test element_response_test reactions_test)
contact_path_add_stage(check NAMES answers_test boundary_residuals_test curved_residuals_test residuals_test solid_residuals_test)
contact_path_add_stage(path LONG SHARDS 4 NAMES automatic_step_test beam_paths_test bodies_test body_scenes_test branch_options_test critical_loads_test csv_test
  curved_paths_test curved_random_paths_test curved_scenes_test deformable_random_paths_test deformable_scenes_test
  determinism_test diagnosis_test end_test eyes_test forces_of_bodies_test frames_on_curves_test free_motion_test friction_changes_test
  hard_scenes_test increment_lists_test
  invariance_test jump_paths_test turning_paths_test large_requests_test largest_reaction_test model_size_test model_test
  mpec_arch_test mpec_cases_test mpec_method_test mpec_parts_test mpec_random_paths_test own_surface_test parts_on_contacts_test path_summary_test pins_test
  points_of_bodies_test polygon_disc_test pushed_and_pulled_test preload_test program_stages_test program_test progress_estimate_test redistribution_test restored_states_test resume_test rollers_test rolling_curves_test rolling_test
  return_detector_test samples_test singular_scenes_test singular_trusses_test sizes_test slack_bars_test sliding_test small_and_stiff_test solid_paths_test stop_test
  surface_scenes_test surfaces_on_bodies_test tendons_test total_law_test trace_test turns_of_rigid_parts_test)
contact_path_add_stage(study NAMES path_column_test study_outputs_test)
contact_path_add_stage(verify LONG SHARDS 2 NAMES inner_states_test verdicts_test verify_end_test verify_events_test verify_jumps_test
  verify_path_test verify_tampering_test)
target_include_directories(verify_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
contact_path_add_stage(cli NAMES event_table_test progress_test)
target_link_libraries(cli_tests contact_path_terminal)
# What scripts/stress writes docs/maintainers/extremes.md with.
add_executable(contact_path_extremes EXCLUDE_FROM_ALL test/extremes/extremes_table.cpp ${contact_path_extremes})
target_precompile_headers(contact_path_extremes REUSE_FROM contact_path_test_support)
target_compile_options(contact_path_extremes PRIVATE ${contact_path_test_options})
target_link_libraries(contact_path_extremes PRIVATE contact_path_test_support contact_path_core contact_path_warnings)

# contact_path_add_replay(<target> <library> <count> [source...]): runs test/fuzz/<target>_fuzz.cpp over its corpus, and over
# so many random changes of it.
function(contact_path_add_replay target library count)
  set(name fuzz_${target})
  contact_path_add_gtest(${name} SOURCES test/fuzz/replay_test.cpp test/fuzz/${target}_fuzz.cpp ${ARGN})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  target_compile_definitions(${name} PRIVATE CONTACT_PATH_CHANGED=${count}
    CONTACT_PATH_CORPUS="${CMAKE_CURRENT_SOURCE_DIR}/test/fuzz/corpus/${target}")
  target_link_libraries(${name} ${library})
endfunction()

contact_path_add_replay(read_scene contact_path_core 20000)
contact_path_add_replay(trace_scene contact_path_mpec 20 test/fuzz/varied_request.cpp)
if(CONTACT_PATH_ROS)
  contact_path_add_replay(convert_request contact_path_ros 20000)
endif()

# contact_path_add_python_test(<name> <file> [LONG] [SHARDS <count>] DEPENDS target... VARIABLES NAME=VALUE...): unittests that run
# programs as their users do, told where these are by environment variables; LONG and SHARDS as above.
function(contact_path_add_python_test name file)
  cmake_parse_arguments(ARG "LONG" "SHARDS" "DEPENDS;VARIABLES" SHARDS 1 ${ARGN})
  set(command ${CONTACT_PATH_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/support/run_unittest.py
    ${CMAKE_CURRENT_SOURCE_DIR}/${file} CONTACT_PATH_SCENES=${CMAKE_CURRENT_SOURCE_DIR}/scenes ${ARG_VARIABLES})
  contact_path_add_processes(python ${name} ${ARG_SHARDS} "${ARG_DEPENDS}" ${command} RESULTS=)
  if(ARG_LONG)
    contact_path_add_processes(python ${name}_long 1 "${ARG_DEPENDS}" ${command} RESULTS=)
  endif()
endfunction()

foreach(test cli_test cli_input_test)
  contact_path_add_python_test(${test} test/cli/${test}.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
endforeach()
contact_path_add_python_test(no_blas_test test/cli/no_blas_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_TEST_DATA=${CMAKE_CURRENT_SOURCE_DIR}/test/data)
contact_path_add_python_test(determinism_test test/cli/determinism_test.py DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace>)
foreach(test plot_test plot_shapes_test)
  contact_path_add_python_test(${test} test/cli/${test}.py DEPENDS contact_path_trace
    VARIABLES CONTACT_PATH_TRACE=$<TARGET_FILE:contact_path_trace> CONTACT_PATH_PLOT=${CMAKE_CURRENT_SOURCE_DIR}/scripts/plot)
endforeach()
contact_path_add_python_test(expand_test test/cli/expand_test.py DEPENDS contact_path_trace contact_path_expand contact_path_response
  VARIABLES CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
foreach(test mesh_test mesh_by_hand_test)
  contact_path_add_python_test(${test} test/cli/${test}.py
    VARIABLES CONTACT_PATH_MESH=${CMAKE_CURRENT_SOURCE_DIR}/scripts/contact_path_mesh)
endforeach()
foreach(test study_test study_input_test)
  contact_path_add_python_test(${test} test/cli/${test}.py LONG SHARDS 2 DEPENDS contact_path_trace contact_path_study_server
    VARIABLES CONTACT_PATH_STUDY=${CMAKE_CURRENT_SOURCE_DIR}/scripts/contact_path_study CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR}
      CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
endforeach()
contact_path_add_python_test(perturb_test test/stress/perturb_test.py LONG DEPENDS contact_path_trace
  VARIABLES CONTACT_PATH_PROGRAMS=$<TARGET_FILE_DIR:contact_path_trace>)
foreach(test answers_test imports_test markers_test signatures_test scene_test path_test page_test page_study_test surface_curves_test
    trace_test doctest_test)
  contact_path_add_python_test(python_${test} test/python/${test}.py LONG DEPENDS contact_path_trace
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
  contact_path_add_python_test(docs_test test/docs/docs_test.py LONG SHARDS 2 DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_PROGRAMS=${contact_path_devel_programs}
      CONTACT_PATH_MODULES=${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
  contact_path_add_python_test(service_stress_test test/stress/service_stress_test.py LONG
    DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR})
  if(contact_path_test_with_catkin)
    set_property(TEST _ctest_${PROJECT_NAME}_python_service_stress_test PROPERTY RESOURCE_LOCK contact_path_nodes)
  endif()
  contact_path_add_python_test(enumerate_branches_test test/stress/enumerate_branches_test.py)
  contact_path_add_python_test(install_test test/install/install_test.py DEPENDS ${contact_path_all_programs}
    VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR})
  if(CMAKE_SOURCE_DIR STREQUAL CMAKE_CURRENT_SOURCE_DIR)  # as package.cmake
    contact_path_add_python_test(package_test test/install/package_test.py DEPENDS ${contact_path_all_programs}
      VARIABLES CONTACT_PATH_ROOT=${CMAKE_CURRENT_SOURCE_DIR} CONTACT_PATH_BUILD=${CMAKE_BINARY_DIR}
        CONTACT_PATH_PROGRAMS=${contact_path_devel_programs})
    if(contact_path_test_with_catkin)
      # Both install, which sets the Python package up in the build tree. They take long, one after the other.
      set_tests_properties(_ctest_${PROJECT_NAME}_python_install_test _ctest_${PROJECT_NAME}_python_package_test
        PROPERTIES RESOURCE_LOCK contact_path_install COST 50)
    else()
      set_property(TEST install_test package_test PROPERTY RESOURCE_LOCK contact_path_install)
    endif()
  endif()
endif()
