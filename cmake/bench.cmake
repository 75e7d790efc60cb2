# Benchmarks: scripts/bench builds and runs them. Those of streaming need ROS.
find_package(benchmark REQUIRED)

add_executable(contact_path_trade bench/trade.cpp bench/lattice.cpp)
target_link_libraries(contact_path_trade PRIVATE contact_path_process contact_path_mpec contact_path_warnings)

add_executable(contact_path_benchmarks bench/benchmarks.cpp bench/scale.cpp bench/solvers.cpp bench/lattice.cpp bench/lattices.cpp)
target_include_directories(contact_path_benchmarks SYSTEM PRIVATE ${SUITESPARSE_INCLUDE_DIR})
target_link_libraries(contact_path_benchmarks PRIVATE contact_path_process contact_path_mpec contact_path_warnings benchmark::benchmark
  ${UMFPACK_LIBRARY} ${SPQR_LIBRARY} ${CHOLMOD_LIBRARY} ${KLU_LIBRARY})

if(CONTACT_PATH_ROS)
  add_executable(contact_path_streaming bench/streaming.cpp)
  target_link_libraries(contact_path_streaming PRIVATE contact_path_ros contact_path_warnings)
endif()
