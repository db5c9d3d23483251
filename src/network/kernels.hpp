#pragma once

#include <cstddef>

// The arithmetic of the network. There is one set of kernels per instruction set, and all sets give
// the same bits: products are sums over k in ascending order by fused multiply-add, all other sums
// run in kLanes lanes over ascending blocks and are then folded in halves (8, 4, 2, 1), and nothing
// else rounds more than once. Matrices are rows of floats with a stride; columns come in blocks of
// kLanes, so every row has room for whole blocks.
namespace linewright::kernels {

inline constexpr std::size_t kLanes = 16;

/// `columns` rounded up to whole blocks.
[[nodiscard]] constexpr std::size_t padded(std::size_t columns) {
  return (columns + kLanes - 1) / kLanes * kLanes;
}

/// What becomes of a product.
enum class Then : unsigned char {
  kStore,  ///< y = product
  kRelu,   ///< y = max(product, 0)
  kAdd,    ///< y = y + product
};

/// y[i][j] = bias[i][j] + sum over k of x[i][k] w[k][j].
struct Product {
  const float* x = nullptr;
  std::size_t x_stride = 0;
  std::size_t rows = 0;
  std::size_t depth = 0;  ///< number of k
  const float* w = nullptr;
  std::size_t w_stride = kLanes;  ///< from one k to the next
  std::size_t w_block = 0;        ///< from one block of columns to the next
  std::size_t blocks = 0;         ///< of columns
  const float* bias = nullptr;
  std::size_t bias_stride = 0;  ///< from one row to the next; 0: all rows have the same
  float* y = nullptr;
  std::size_t y_stride = 0;
  Then then = Then::kStore;
};

/// Layer normalisation over the first `width` columns with eps 1e-5; the padding becomes zero where
/// `weight` and `bias` are zero there.
struct Norm {
  std::size_t width = 0;
  const float* weight = nullptr;
  const float* bias = nullptr;
};

/// The functions; they neither allocate nor keep anything.
struct Kernels {
  const char* name;
  void (*multiply)(const Product&);
  void (*layer_norm)(const Norm&, const float* x, std::size_t stride, std::size_t rows, float* y);
  /// Each row of `blocks` blocks becomes exp(scale (s - max)) divided by its sum. `scale` > 0.
  void (*softmax)(float* s, std::size_t stride, std::size_t rows, std::size_t blocks, float scale);
  /// y[k][j] = mean[k][j] + sigma[k][j] (in[k] out[j]) for one block of columns, stride kLanes.
  void (*perturb)(const float* mean, const float* sigma, const float* in, const float* out,
                  std::size_t depth, float* y);
  /// y = e^x for `blocks` blocks, relative error below 2e-7; x outside [-87, 88] counts as the
  /// nearest of the two.
  void (*exponential)(const float* x, std::size_t blocks, float* y);
};

/// Those for any machine.
[[nodiscard]] const Kernels& plain_kernels();
/// Null when the program was not compiled for machines that have such instructions.
[[nodiscard]] const Kernels* avx2_kernels();
[[nodiscard]] const Kernels* avx512_kernels();

/// What this machine can run, at most `kMostSets`, the fastest first; the last one is the plain one
/// and all behind it are null.
inline constexpr std::size_t kMostSets = 3;
struct KernelSets {
  const Kernels* sets[kMostSets] = {};
};
[[nodiscard]] const KernelSets& available_kernels();

}  // namespace linewright::kernels
