#pragma once

#include <cstddef>
#include <string>

namespace linewright {

/// How LibTorch computes here.
struct LearningRuntime {
  std::string torch_version;
  std::string device;  ///< "cpu" or "cuda"
  std::string blas;    ///< who multiplies matrices: "oneDNN", "OpenBLAS ..." or "reference BLAS"
  bool slow_blas = false;  ///< the reference BLAS: 10 to 20 times slower
  std::size_t threads = 1;
};

/// Sets how many threads LibTorch computes with (0: one per core) and says what it found. To be
/// called once, before anything is learned.
LearningRuntime prepare_learning(std::size_t threads);

}  // namespace linewright
