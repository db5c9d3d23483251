# LibTorch as the target Torch::Torch, where it is installed: only the layer `learning` needs it, and
# without it everything but training is built. Sanitizers and fuzzers leave it out: they would report
# what happens inside of it.

option(LINEWRIGHT_LEARNING "Build the trainer where LibTorch is installed" ON)

if(LINEWRIGHT_LEARNING AND NOT LINEWRIGHT_SANITIZE AND NOT LINEWRIGHT_BUILD_FUZZERS)
  find_package(Torch QUIET)
endif()
if(TORCH_FOUND)
  add_library(Torch::Torch INTERFACE IMPORTED)
  target_link_libraries(Torch::Torch INTERFACE ${TORCH_LIBRARIES})
  target_include_directories(Torch::Torch SYSTEM INTERFACE ${TORCH_INCLUDE_DIRS})
else()
  message(STATUS "LibTorch: not used, there will be no trainer")
endif()
