# linewright_layer(NAME <layer> [DEPENDS <lower layer>...] [LIBRARIES <external target>...])
#
# Makes the library `linewright_<layer>` from src/<layer>/*.cpp (header-only if there are none) and
# the test program `<layer>_test` from src/<layer>/*_test.cpp. A layer without any file is skipped.
# Sources named x_avx2.cpp and x_avx512.cpp are compiled for x86-64 processors with those instructions.
# The names of all layers made so far, but of those that need LibTorch, are in the global property
# LINEWRIGHT_LAYERS. A layer is skipped where one of its libraries is missing.

include(GoogleTest)

function(linewright_layer)
  cmake_parse_arguments(PARSE_ARGV 0 layer "" "NAME" "DEPENDS;LIBRARIES")
  if(layer_UNPARSED_ARGUMENTS OR NOT layer_NAME)
    message(FATAL_ERROR "linewright_layer: bad arguments: ${layer_UNPARSED_ARGUMENTS}")
  endif()

  foreach(library IN LISTS layer_LIBRARIES)
    if(NOT TARGET ${library})
      message(STATUS "Layer ${layer_NAME}: skipped, there is no ${library}")
      return()
    endif()
  endforeach()
  file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/linewright/${layer_NAME}/*.hpp")
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${layer_NAME}/*.cpp")
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  if(NOT headers AND NOT sources)
    message(STATUS "Layer ${layer_NAME}: no files yet, skipped")
    return()
  endif()

  set(target linewright_${layer_NAME})
  if(sources)
    linewright_choose_instructions(${sources})
    add_library(${target} STATIC ${sources} ${headers})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE linewright_options)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} "${PROJECT_SOURCE_DIR}/include")
  target_link_libraries(${target} ${scope} ${layer_LIBRARIES})
  foreach(lower IN LISTS layer_DEPENDS)
    if(TARGET linewright_${lower})
      target_link_libraries(${target} ${scope} linewright_${lower})
    endif()
  endforeach()
  if(NOT "Torch::Torch" IN_LIST layer_LIBRARIES)  # it costs every program 0.4 s at its start
    set_property(GLOBAL APPEND PROPERTY LINEWRIGHT_LAYERS ${target})
  endif()

  if(LINEWRIGHT_BUILD_TESTS AND tests)
    linewright_add_test(${layer_NAME}_test ${tests})
    target_link_libraries(${layer_NAME}_test PRIVATE ${target})
  endif()
endfunction()

# Gives x_avx2.cpp and x_avx512.cpp among the sources the instructions that their names promise. On
# other processors than x86-64 they are compiled as all others are.
function(linewright_choose_instructions)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    return()
  endif()
  set(avx2 -mavx2 -mfma)
  set(avx512 -mavx512f -mavx512dq -mfma)
  # GCC 12 takes its own header for AVX-512 to read uninitialised values (GCC bug 105593).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND avx512 -Wno-maybe-uninitialized)
  endif()
  foreach(source IN LISTS ARGN)
    if(source MATCHES "_(avx2|avx512)\\.cpp$")
      set_property(SOURCE "${source}" APPEND PROPERTY COMPILE_OPTIONS "${${CMAKE_MATCH_1}}")
    endif()
  endforeach()
endfunction()

# linewright_add_test(<program> <source>...): a GoogleTest program whose tests run in the repository
# root; LINEWRIGHT_SOURCE_DIR is that root as a string literal. In release builds the tests themselves
# are optimised less than what they test, and share a compiled header: half the time to build them.
function(linewright_add_test name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE linewright_options GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE LINEWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${name} PRIVATE -O1)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # GCC 12 sees what is not there in std::string (bug 105651)
      target_compile_options(${name} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
    endif()
    target_precompile_headers(${name} PRIVATE <gtest/gtest.h>)
  endif()
  gtest_discover_tests(${name}
    TEST_PREFIX "${name}."
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 120)
endfunction()
