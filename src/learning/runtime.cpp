#include "linewright/learning/runtime.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <thread>

#include "attention.hpp"

namespace linewright {
namespace {

/// The file that a function of the process comes from.
std::string library_of(const void* function) {
  Dl_info info{};
  return dladdr(function, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

void name_blas(LearningRuntime& runtime) {
  if (dlsym(RTLD_DEFAULT, "linewright_sgemm_is_onednn") != nullptr) {
    runtime.blas = "oneDNN";
    return;
  }
  using Config = const char* (*)();
  if (const auto config = reinterpret_cast<Config>(dlsym(RTLD_DEFAULT, "openblas_get_config"))) {
    runtime.blas = config();
    return;
  }
  const void* sgemm = dlsym(RTLD_DEFAULT, "sgemm_");
  const std::string file = sgemm == nullptr ? "" : library_of(sgemm);
  runtime.slow_blas = file.find("/blas/") != std::string::npos || file.ends_with("libblas.so.3");
  runtime.blas = runtime.slow_blas ? "reference BLAS" : file.empty() ? "unknown" : file;
}

}  // namespace

LearningRuntime prepare_learning(std::size_t threads) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  LearningRuntime runtime{.torch_version = TORCH_VERSION,
                          .device = torch::cuda::is_available() ? "cuda" : "cpu",
                          .threads = threads == 0 ? cores : threads};
  torch::set_num_threads(static_cast<int>(runtime.threads));
  name_blas(runtime);
  return runtime;
}

}  // namespace linewright
