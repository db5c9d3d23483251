# The programs above the layers. Each is skipped while it has no sources.

# apps/cli/*.cpp -> the command line tool `linewright` at the top of the build folder.
function(linewright_add_cli)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/cli/*.cpp")
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  if(LINEWRIGHT_BUILD_FUZZERS OR NOT sources)
    return()
  endif()
  get_property(layers GLOBAL PROPERTY LINEWRIGHT_LAYERS)
  add_executable(linewright ${sources})
  target_link_libraries(linewright
    PRIVATE linewright_options linewright_commit ${layers} CLI11::CLI11 Boost::headers)
  target_compile_definitions(linewright PRIVATE LINEWRIGHT_VERSION="${PROJECT_VERSION}")
  set_target_properties(linewright PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    # Most of what a file costs are the headers of CLI11 and nlohmann-json: several files at once
    # take less than half of the time in all.
    set_target_properties(linewright PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()

# apps/trainer/*.cpp -> `linewright-train` beside it, where the layer `learning` is built.
function(linewright_add_trainer)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/trainer/*.cpp")
  if(NOT TARGET linewright_learning OR NOT sources)
    return()
  endif()
  list(FILTER sources EXCLUDE REGEX "/gemm\\.cpp$")
  get_property(layers GLOBAL PROPERTY LINEWRIGHT_LAYERS)
  add_executable(linewright-train ${sources})
  target_link_libraries(linewright-train
    PRIVATE linewright_options linewright_commit ${layers} CLI11::CLI11)
  linewright_use_learning(linewright-train)
  target_compile_definitions(linewright-train PRIVATE LINEWRIGHT_VERSION="${PROJECT_VERSION}")
  set_target_properties(linewright-train PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
endfunction()

# tests/**/*.cpp -> `repository_test`; LINEWRIGHT_CLI is the path of the command line tool.
function(linewright_add_repository_test)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/tests/data/")
  if(NOT LINEWRIGHT_BUILD_TESTS OR NOT sources)
    return()
  endif()
  get_property(layers GLOBAL PROPERTY LINEWRIGHT_LAYERS)
  linewright_add_test(repository_test ${sources})
  target_include_directories(repository_test PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(repository_test PRIVATE ${layers})
  if(TARGET linewright)
    add_dependencies(repository_test linewright)
    target_compile_definitions(repository_test PRIVATE LINEWRIGHT_CLI="$<TARGET_FILE:linewright>")
  endif()
endfunction()

# apps/solver/*_test.py: with LINEWRIGHT_ORTOOLS=PYTHON in the environment, a Python that has ortools,
# what the solver proves is tested, too.
function(linewright_add_solver_test)
  find_package(Python3 COMPONENTS Interpreter QUIET)
  if(NOT LINEWRIGHT_BUILD_TESTS OR NOT Python3_FOUND)
    return()
  endif()
  add_test(NAME solver_test.relaxation
    COMMAND sh -c "PYTHONDONTWRITEBYTECODE=1 \"\${LINEWRIGHT_ORTOOLS:-${Python3_EXECUTABLE}}\" relaxation_test.py"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}/apps/solver")
endfunction()

# benchmarks/*.cpp -> one program each, in <build folder>/benchmarks. The sources of x_benchmark.cpp
# are also benchmarks/x/*.cpp; a program without a main function of its own is Google Benchmark's.
function(linewright_add_benchmarks)
  if(NOT LINEWRIGHT_BUILD_BENCHMARKS)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/benchmarks/*.cpp")
  get_property(layers GLOBAL PROPERTY LINEWRIGHT_LAYERS)
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    if(name STREQUAL "learning_benchmark" AND NOT TARGET linewright_learning)
      continue()
    endif()
    string(REGEX REPLACE "_benchmark$" "" folder "${name}")
    file(GLOB parts CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/benchmarks/${folder}/*.cpp")
    add_executable(${name} "${source}" ${parts})
    target_link_libraries(${name}
      PRIVATE linewright_options ${layers} benchmark::benchmark benchmark::benchmark_main)
    target_compile_definitions(${name} PRIVATE LINEWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    linewright_use_ompl(${name})
    if(name STREQUAL "learning_benchmark")
      linewright_use_learning(${name})
    endif()
    set_target_properties(${name} PROPERTIES
      RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/benchmarks")
  endforeach()
endfunction()

# fuzz/*.cpp -> one libFuzzer program each, in <build folder>/fuzzers.
function(linewright_add_fuzzers)
  if(NOT LINEWRIGHT_BUILD_FUZZERS)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/fuzz/*.cpp")
  get_property(layers GLOBAL PROPERTY LINEWRIGHT_LAYERS)
  # What no fuzzer uses need not be built for them a second time.
  list(REMOVE_ITEM layers linewright_charts linewright_bounds linewright_experiments)
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    add_executable(${name} "${source}")
    target_link_libraries(${name} PRIVATE linewright_options ${layers})
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    set_target_properties(${name} PROPERTIES
      RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/fuzzers")
  endforeach()
endfunction()
