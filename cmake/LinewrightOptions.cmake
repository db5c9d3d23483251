# Compiler settings shared by every target; link `linewright_options` to get them.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(LINEWRIGHT_CCACHE ccache)
if(LINEWRIGHT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${LINEWRIGHT_CCACHE}")
endif()

add_library(linewright_options INTERFACE)

# Without contraction a*b+c rounds the same everywhere: same seed, same log, on every compiler.
target_compile_options(linewright_options INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wno-missing-field-initializers)  # designated initialisers rely on the members' defaults

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports overlapping copies for plain std::string concatenation (GCC bug 105651).
  target_compile_options(linewright_options INTERFACE -Wno-restrict)
endif()

if(LINEWRIGHT_WERROR)
  target_compile_options(linewright_options INTERFACE -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # These three depend on the optimiser and are wrong at times: warn, do not stop the build.
    target_compile_options(linewright_options INTERFACE
      -Wno-error=maybe-uninitialized -Wno-error=array-bounds -Wno-error=stringop-overflow)
  endif()
endif()

if(LINEWRIGHT_SANITIZE)
  add_compile_options(
    -fsanitize=${LINEWRIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LINEWRIGHT_SANITIZE})
endif()

if(LINEWRIGHT_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "The fuzzers need clang; use the preset `fuzz` or tools/fuzz.sh.")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# linewright_use_ompl(<program>): OMPL and the macro LINEWRIGHT_HAS_OMPL, where it is installed. Only
# tests and benchmarks use it, to compare with.
function(linewright_use_ompl target)
  find_package(ompl QUIET)
  if(NOT OMPL_FOUND OR NOT TARGET ${target})
    return()
  endif()
  # Its list of libraries also names some that Debian's package does not bring and nothing needs.
  list(GET OMPL_LIBRARIES 0 library)
  set(folders ${OMPL_INCLUDE_DIRS})
  list(REMOVE_ITEM folders /usr/include)
  target_include_directories(${target} SYSTEM PRIVATE ${folders})
  target_link_libraries(${target} PRIVATE ${library})
  target_compile_definitions(${target} PRIVATE LINEWRIGHT_HAS_OMPL)
endfunction()
