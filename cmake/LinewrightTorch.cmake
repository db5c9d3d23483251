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

# What only learning uses need not give the same bits on every machine: fused multiply-add is faster.
# Vectors wider than the machine's never leave their functions there, so their ABI does not matter.
file(GLOB kernels CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/learning/attention_*.cpp")
set_property(SOURCE ${kernels} APPEND PROPERTY COMPILE_OPTIONS -ffp-contract=fast -Wno-psabi)

# linewright_use_learning(<program>): the layer `learning` and oneDNN's matrix product for LibTorch. It
# finds the program's sgemm_ because the program shows its symbols to libraries.
function(linewright_use_learning target)
  target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/apps/trainer/gemm.cpp")
  target_link_libraries(${target} PRIVATE linewright_learning)
  set_target_properties(${target} PROPERTIES ENABLE_EXPORTS ON)
  find_library(LINEWRIGHT_DNNL dnnl)
  find_path(LINEWRIGHT_DNNL_INCLUDE oneapi/dnnl/dnnl.h)
  if(LINEWRIGHT_DNNL AND LINEWRIGHT_DNNL_INCLUDE)
    target_link_libraries(${target} PRIVATE "${LINEWRIGHT_DNNL}")
    target_compile_definitions(${target} PRIVATE LINEWRIGHT_HAS_DNNL)
  endif()
endfunction()
