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
