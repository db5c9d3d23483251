#pragma once

#include <cstddef>
#include <cstdint>

#include "attention_kernel.hpp"

// The kernels, written once; each source that includes this file is compiled for other
// instructions. So everything is in an unnamed namespace and no inline function of a library is
// called, or the linker might keep the copy that other machines cannot run.
namespace linewright::learning {
namespace {

/// Rows are padded to whole lanes of 16 numbers, so that inner loops have no rest.
constexpr std::size_t kLane = 16;

std::size_t padded(std::size_t n) { return (n + kLane - 1) / kLane * kLane; }

void copy(const float* from, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
}

/// Numbers of one register: wider vectors would live in memory.
#if defined(__AVX512F__)
constexpr std::size_t kWide = 16;
#elif defined(__AVX2__)
constexpr std::size_t kWide = 8;
#else
constexpr std::size_t kWide = 4;
#endif
typedef float Lane __attribute__((vector_size(kWide * sizeof(float))));
typedef std::int32_t IntLane __attribute__((vector_size(kWide * sizeof(std::int32_t))));

[[gnu::always_inline]] inline Lane load(const float* from) {
  Lane lane;
  __builtin_memcpy(&lane, from, sizeof lane);
  return lane;
}

[[gnu::always_inline]] inline void store(float* to, Lane lane) {
  __builtin_memcpy(to, &lane, sizeof lane);
}

[[gnu::always_inline]] inline float sum_of(Lane lane) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < kWide; ++i) sum += lane[i];
  return sum;
}

/// e^x as 2^n times a polynomial; |relative error| < 3e-7 for x <= 0, and 0 far below.
[[gnu::always_inline]] inline Lane exp_of(Lane x) {
  const Lane lowest = Lane{} - 87.0F;
  const Lane bounded = x < lowest ? lowest : x;
  constexpr float kRound = 12582912.0F;  // 1.5 * 2^23: what is added to it is rounded to a whole
  const Lane whole = (bounded * 1.44269504F + kRound) - kRound;
  const Lane rest = (bounded - whole * 0.693359375F) + whole * 2.12194440e-4F;
  Lane value = rest * 1.9875691500e-4F + 1.3981999507e-3F;
  value = value * rest + 8.3334519073e-3F;
  value = value * rest + 4.1665795894e-2F;
  value = value * rest + 1.6666665459e-1F;
  value = value * rest + 5.0000001201e-1F;
  value = value * rest * rest + rest + 1.0F;
  const IntLane bits = (__builtin_convertvector(whole, IntLane) + 127) << 23;
  Lane power;
  __builtin_memcpy(&power, &bits, sizeof power);
  return value * power;
}

/// In place, over `count` numbers; those from `count` to `width` become 0.
void softmax(float* numbers, std::size_t count, std::size_t width) {
  for (std::size_t i = count; i < width; ++i) numbers[i] = -1e30F;
  Lane most = load(numbers);
  for (std::size_t block = kWide; block < width; block += kWide) {
    const Lane more = load(numbers + block);
    most = most < more ? more : most;
  }
  float largest = most[0];
  for (std::size_t i = 1; i < kWide; ++i) largest = largest < most[i] ? most[i] : largest;
  Lane sum{};
  for (std::size_t block = 0; block < width; block += kWide) {
    const Lane power = exp_of(load(numbers + block) - largest);
    store(numbers + block, power);
    sum += power;
  }
  const float factor = 1.0F / sum_of(sum);
  for (std::size_t block = 0; block < width; block += kWide) {
    store(numbers + block, load(numbers + block) * factor);
  }
  for (std::size_t i = count; i < width; ++i) numbers[i] = 0.0F;
}

/// gradient[i] = scale * weight[i] * (gradient[i] - sum over j of gradient[j] weight[j]).
void softmax_backward(const float* weights, std::size_t width, float scale, float* gradient) {
  Lane sum{};
  for (std::size_t block = 0; block < width; block += kWide) {
    sum += load(weights + block) * load(gradient + block);
  }
  const float total = sum_of(sum);
  for (std::size_t block = 0; block < width; block += kWide) {
    const Lane weight = load(weights + block);
    store(gradient + block, scale * weight * (load(gradient + block) - total));
  }
}

/// Element (i, k) of a matrix stands at `at[i * row + k * column]`.
struct Matrix {
  const float* at = nullptr;
  std::size_t row = 0;
  std::size_t column = 1;
};

/// kRows rows and kLane columns of the product, all in registers.
template <std::size_t kRows>
[[gnu::always_inline]] inline void multiply_block(Matrix a, std::size_t depth, const float* b,
                                                  std::size_t width, float* out) {
  constexpr std::size_t kParts = kLane / kWide;
  Lane sum[kRows][kParts] = {};
  for (std::size_t k = 0; k < depth; ++k) {
    Lane row[kParts];
#pragma GCC unroll 4
    for (std::size_t p = 0; p < kParts; ++p) row[p] = load(b + k * width + p * kWide);
#pragma GCC unroll 16
    for (std::size_t i = 0; i < kRows; ++i) {
      const float factor = a.at[i * a.row + k * a.column];
#pragma GCC unroll 4
      for (std::size_t p = 0; p < kParts; ++p) sum[i][p] += factor * row[p];
    }
  }
#pragma GCC unroll 16
  for (std::size_t i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
    for (std::size_t p = 0; p < kParts; ++p) store(out + i * width + p * kWide, sum[i][p]);
  }
}

/// The same with `rows` rows, at most kRows.
template <std::size_t kRows>
[[gnu::always_inline]] inline void multiply_rows(std::size_t rows, Matrix a, std::size_t depth,
                                                 const float* b, std::size_t width, float* out) {
  if constexpr (kRows > 1) {
    if (rows < kRows) {
      multiply_rows<kRows - 1>(rows, a, depth, b, width, out);
      return;
    }
  }
  multiply_block<kRows>(a, depth, b, width, out);
}

/// Rows at once: as many sums as fit into the registers beside what is multiplied (32 of them with
/// AVX-512, else 16).
constexpr std::size_t kBlock = kWide == 16 ? 12 : kWide == 8 ? 6 : 3;

/// out [count][width] = a [count][depth] * b [depth][width]; width is a multiple of kLane.
void multiply(Matrix a, std::size_t count, std::size_t depth, const float* b, std::size_t width,
              float* out) {
  for (std::size_t i = 0; i < count; i += kBlock) {
    const Matrix part{a.at + i * a.row, a.row, a.column};
    for (std::size_t column = 0; column < width; column += kLane) {
      float* to = out + i * width + column;
      multiply_rows<kBlock>(count - i, part, depth, b + column, width, to);
    }
  }
}

/// One head's vectors of a sample: rows padded to whole lanes, and the same turned round.
struct Block {
  float* rows = nullptr;     ///< [rows][head]
  float* columns = nullptr;  ///< [head_width][keys]
};

struct Sizes {
  std::size_t head = 0;  ///< head_width, padded
  std::size_t keys = 0;  ///< present keys, padded
  std::size_t present = 0;
};

Sizes sizes_of(const AttentionShape& shape, const std::uint8_t* present) {
  Sizes sizes{.head = padded(shape.head_width)};
  for (std::size_t k = 0; k < shape.keys; ++k) sizes.present += present[k] != 0 ? 1 : 0;
  sizes.keys = padded(sizes.present);
  return sizes;
}

/// Rows of the present keys.
void gather(const AttentionShape& shape, const Sizes& sizes, Rows rows, std::size_t head,
            const std::uint8_t* present, Block block) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < shape.keys; ++k) {
    if (present[k] == 0) continue;
    const float* row = rows.at + k * rows.stride + head * shape.head_width;
    copy(row, shape.head_width, block.rows + n * sizes.head);
    for (std::size_t c = 0; c < shape.head_width; ++c) block.columns[c * sizes.keys + n] = row[c];
    ++n;
  }
}

/// One head's queries, times `factor`.
void gather_queries(const AttentionShape& shape, const Sizes& sizes, Rows rows, std::size_t head,
                    float factor, float* to) {
  for (std::size_t q = 0; q < shape.queries; ++q) {
    const float* row = rows.at + q * rows.stride + head * shape.head_width;
    for (std::size_t c = 0; c < shape.head_width; ++c) to[q * sizes.head + c] = row[c] * factor;
  }
}

void scatter(const AttentionShape& shape, const Sizes& sizes, const float* block, std::size_t head,
             const std::uint8_t* present, MutableRows out) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < shape.keys; ++k) {
    float* row = out.at + k * out.stride + head * shape.head_width;
    if (present[k] == 0) {
      for (std::size_t c = 0; c < shape.head_width; ++c) row[c] = 0.0F;
    } else {
      copy(block + n++ * sizes.head, shape.head_width, row);
    }
  }
}

void scatter_queries(const AttentionShape& shape, const Sizes& sizes, const float* block,
                     std::size_t head, MutableRows out) {
  for (std::size_t q = 0; q < shape.queries; ++q) {
    copy(block + q * sizes.head, shape.head_width,
         out.at + q * out.stride + head * shape.head_width);
  }
}

/// Cuts the scratch into zeroed blocks; what pads a row stays zero.
class Cutter {
 public:
  Cutter(float* scratch, std::size_t size) : next_(scratch) {
    for (std::size_t i = 0; i < size; ++i) scratch[i] = 0.0F;
  }
  float* take(std::size_t size) {
    float* block = next_;
    next_ += size;
    return block;
  }

 private:
  float* next_;
};

void attention_forward(const AttentionShape& shape, Rows query, Rows key, Rows value,
                       const std::uint8_t* present, float* weights, MutableRows out,
                       float* scratch) {
  const Sizes sizes = sizes_of(shape, present);
  const float scale = 1.0F / __builtin_sqrtf(static_cast<float>(shape.head_width));
  const std::size_t key_block = sizes.head * sizes.keys;
  const std::size_t query_block = sizes.head * shape.queries;
  Cutter cutter(scratch, 4 * key_block + 2 * query_block + shape.queries * sizes.keys);
  const Block keys{cutter.take(key_block), cutter.take(key_block)};
  const Block values{cutter.take(key_block), cutter.take(key_block)};
  float* asked = cutter.take(query_block);
  float* result = cutter.take(query_block);
  float* scores = cutter.take(shape.queries * sizes.keys);
  for (std::size_t head = 0; head < shape.heads; ++head) {
    gather(shape, sizes, key, head, present, keys);
    gather(shape, sizes, value, head, present, values);
    gather_queries(shape, sizes, query, head, scale, asked);
    multiply({asked, sizes.head}, shape.queries, shape.head_width, keys.columns, sizes.keys,
             scores);
    for (std::size_t q = 0; q < shape.queries; ++q) {
      float* row = scores + q * sizes.keys;
      softmax(row, sizes.present, sizes.keys);
      copy(row, sizes.present, weights + (head * shape.queries + q) * shape.keys);
    }
    multiply({scores, sizes.keys}, shape.queries, sizes.present, values.rows, sizes.head, result);
    scatter_queries(shape, sizes, result, head, out);
  }
}

void attention_backward(const AttentionShape& shape, Rows query, Rows key, Rows value,
                        const std::uint8_t* present, const float* weights, Rows out_gradient,
                        MutableRows query_gradient, MutableRows key_gradient,
                        MutableRows value_gradient, float* scratch) {
  const Sizes sizes = sizes_of(shape, present);
  const float scale = 1.0F / __builtin_sqrtf(static_cast<float>(shape.head_width));
  const std::size_t key_block = sizes.head * sizes.keys;
  const std::size_t query_block = sizes.head * shape.queries;
  const std::size_t score_block = shape.queries * sizes.keys;
  Cutter cutter(scratch, 5 * key_block + 3 * query_block + 2 * score_block);
  const Block keys{cutter.take(key_block), cutter.take(key_block)};
  const Block values{cutter.take(key_block), cutter.take(key_block)};
  float* sum = cutter.take(key_block);
  float* given = cutter.take(query_block);
  float* asked = cutter.take(query_block);
  float* result = cutter.take(query_block);
  float* weight = cutter.take(score_block);
  float* gradient = cutter.take(score_block);
  for (std::size_t head = 0; head < shape.heads; ++head) {
    gather(shape, sizes, key, head, present, keys);
    gather(shape, sizes, value, head, present, values);
    gather_queries(shape, sizes, out_gradient, head, 1.0F, given);
    gather_queries(shape, sizes, query, head, 1.0F, asked);
    multiply({given, sizes.head}, shape.queries, shape.head_width, values.columns, sizes.keys,
             gradient);
    for (std::size_t q = 0; q < shape.queries; ++q) {
      float* row = weight + q * sizes.keys;
      copy(weights + (head * shape.queries + q) * shape.keys, sizes.present, row);
      softmax_backward(row, sizes.keys, scale, gradient + q * sizes.keys);
    }
    multiply({gradient, sizes.keys}, shape.queries, sizes.present, keys.rows, sizes.head, result);
    scatter_queries(shape, sizes, result, head, query_gradient);
    multiply({gradient, 1, sizes.keys}, sizes.present, shape.queries, asked, sizes.head, sum);
    scatter(shape, sizes, sum, head, present, key_gradient);
    multiply({weight, 1, sizes.keys}, sizes.present, shape.queries, given, sizes.head, sum);
    scatter(shape, sizes, sum, head, present, value_gradient);
  }
}

constexpr AttentionKernels kKernels{attention_forward, attention_backward};

}  // namespace
}  // namespace linewright::learning
