# Which commit a program was built from, for `--version` and for what it writes.

# Target linewright_commit: <build folder>/commit/linewright_commit.hpp defines LINEWRIGHT_COMMIT. Looked at
# in every build, and written only when it changed.
function(linewright_add_commit)
  set(header "${PROJECT_BINARY_DIR}/commit/linewright_commit.hpp")
  add_custom_target(linewright_commit_header
    COMMAND "${CMAKE_COMMAND}" -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${header}
            -P "${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake"
    BYPRODUCTS "${header}" COMMENT "" VERBATIM)
  add_library(linewright_commit INTERFACE)
  add_dependencies(linewright_commit linewright_commit_header)
  target_include_directories(linewright_commit INTERFACE "${PROJECT_BINARY_DIR}/commit")
endfunction()
