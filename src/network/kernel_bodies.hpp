#pragma once

#include <cstddef>

#include "kernels.hpp"

// The kernels, written once for any type `Lanes` of 16 floats; each source that includes this file
// is compiled for other instructions. So nothing here may leave that source: everything is in an
// unnamed namespace and no inline function of a library is called, or the linker might keep the
// copy that other machines cannot run.
namespace linewright::kernels {
namespace {

/// R rows by C blocks of y, which stay in registers while k runs.
template <class Lanes, std::size_t R, std::size_t C>
struct Tile {
  static void run(const Product& p, std::size_t row, std::size_t block) {
    const float* x = p.x + row * p.x_stride;
    const float* w = p.w + block * p.w_block;
    Lanes sums[R][C];
    start(p, row, block, sums);
    for (std::size_t k = 0; k < p.depth; ++k) {
      Lanes weights[C];
      for (std::size_t c = 0; c < C; ++c) {
        weights[c] = Lanes::load(w + c * p.w_block + k * p.w_stride);
      }
      for (std::size_t r = 0; r < R; ++r) {
        const Lanes value = Lanes::all(x[r * p.x_stride + k]);
        for (std::size_t c = 0; c < C; ++c) sums[r][c] = Lanes::fma(value, weights[c], sums[r][c]);
      }
    }
    finish(p, row, block, sums);
  }

  [[gnu::always_inline]] static inline void start(const Product& p, std::size_t row,
                                                  std::size_t block, Lanes (&sums)[R][C]) {
    const float* bias = p.bias + row * p.bias_stride + block * kLanes;
    for (std::size_t r = 0; r < R; ++r) {
      for (std::size_t c = 0; c < C; ++c) {
        sums[r][c] = Lanes::load(bias + r * p.bias_stride + c * kLanes);
      }
    }
  }

  [[gnu::always_inline]] static inline void finish(const Product& p, std::size_t row,
                                                   std::size_t block, const Lanes (&sums)[R][C]) {
    float* y = p.y + row * p.y_stride + block * kLanes;
    for (std::size_t r = 0; r < R; ++r) {
      for (std::size_t c = 0; c < C; ++c) {
        float* const place = y + r * p.y_stride + c * kLanes;
        Lanes result = sums[r][c];
        if (p.then == Then::kRelu) result = Lanes::max(result, Lanes::all(0.0F));
        if (p.then == Then::kAdd) result = Lanes::add(Lanes::load(place), result);
        Lanes::store(place, result);
      }
    }
  }
};

/// Tile<Lanes, count, C>, for a `count` of 1 to Most.
template <class Lanes, std::size_t Most, std::size_t C>
void run_tile(const Product& p, std::size_t row, std::size_t count, std::size_t block) {
  if constexpr (Most > 1) {
    if (count < Most) {
      run_tile<Lanes, Most - 1, C>(p, row, count, block);
      return;
    }
  }
  Tile<Lanes, Most, C>::run(p, row, block);
}

/// All rows of C blocks, in tiles of nearly equal height.
template <class Lanes, std::size_t C>
void multiply_columns(const Product& p, std::size_t block) {
  const std::size_t tiles = (p.rows + Lanes::kRows - 1) / Lanes::kRows;
  std::size_t row = 0;
  for (std::size_t left = tiles; left > 0; --left) {
    const std::size_t count = (p.rows - row + left - 1) / left;
    run_tile<Lanes, Lanes::kRows, C>(p, row, count, block);
    row += count;
  }
}

template <class Lanes>
void multiply(const Product& p) {
  std::size_t block = 0;
  for (; block + Lanes::kBlocks <= p.blocks; block += Lanes::kBlocks) {
    multiply_columns<Lanes, Lanes::kBlocks>(p, block);
  }
  for (; block < p.blocks; ++block) multiply_columns<Lanes, 1>(p, block);
}

/// e^x: 2^n e^r with |r| <= ln(2)/2, and for e^r the Taylor polynomial of degree 7.
template <class Lanes>
[[gnu::always_inline]] inline Lanes exponential_of(Lanes x) {
  x = Lanes::min(Lanes::max(x, Lanes::all(-87.0F)), Lanes::all(88.0F));
  // Adding 1.5 * 2^23 rounds to a whole number, which then stands in the lowest bits.
  const Lanes shift = Lanes::all(0x1.8p23F);
  const Lanes shifted = Lanes::fma(x, Lanes::all(0x1.715476p+0F), shift);
  const Lanes n = Lanes::sub(shifted, shift);
  Lanes r = Lanes::fma(n, Lanes::all(-0x1.62e4p-1F), x);
  r = Lanes::fma(n, Lanes::all(-0x1.7f7d1cp-20F), r);
  Lanes p = Lanes::all(1.0F / 5040.0F);
  p = Lanes::fma(p, r, Lanes::all(1.0F / 720.0F));
  p = Lanes::fma(p, r, Lanes::all(1.0F / 120.0F));
  p = Lanes::fma(p, r, Lanes::all(1.0F / 24.0F));
  p = Lanes::fma(p, r, Lanes::all(1.0F / 6.0F));
  p = Lanes::fma(p, r, Lanes::all(0.5F));
  p = Lanes::fma(p, r, Lanes::all(1.0F));
  p = Lanes::fma(p, r, Lanes::all(1.0F));
  return Lanes::mul(p, Lanes::power_of_two(shifted));
}

template <class Lanes>
void exponential(const float* x, std::size_t blocks, float* y) {
  for (std::size_t at = 0; at < blocks * kLanes; at += kLanes) {
    Lanes::store(y + at, exponential_of(Lanes::load(x + at)));
  }
}

template <class Lanes>
void softmax_row(float* s, std::size_t blocks, Lanes scale) {
  Lanes most = Lanes::load(s);
  for (std::size_t b = 1; b < blocks; ++b) most = Lanes::max(most, Lanes::load(s + b * kLanes));
  const Lanes top = Lanes::all(Lanes::fold_max(most));
  Lanes sum = Lanes::all(0.0F);
  for (std::size_t b = 0; b < blocks; ++b) {
    const Lanes below = Lanes::sub(Lanes::load(s + b * kLanes), top);
    const Lanes e = exponential_of(Lanes::mul(below, scale));
    Lanes::store(s + b * kLanes, e);
    sum = Lanes::add(sum, e);
  }
  const Lanes share = Lanes::all(1.0F / Lanes::fold_sum(sum));
  for (std::size_t b = 0; b < blocks; ++b) {
    Lanes::store(s + b * kLanes, Lanes::mul(Lanes::load(s + b * kLanes), share));
  }
}

template <class Lanes>
void softmax(float* s, std::size_t stride, std::size_t rows, std::size_t blocks, float scale) {
  for (std::size_t i = 0; i < rows; ++i) softmax_row(s + i * stride, blocks, Lanes::all(scale));
}

/// x - mean, and zero behind the width.
template <class Lanes>
[[gnu::always_inline]] inline Lanes centred(const float* x, std::size_t at, std::size_t width,
                                            Lanes mean) {
  const Lanes difference = Lanes::sub(Lanes::load(x + at), mean);
  if (at + kLanes <= width) return difference;
  alignas(64) float keep[kLanes] = {};
  for (std::size_t i = 0; at + i < width; ++i) keep[i] = 1.0F;
  return Lanes::mul(difference, Lanes::load(keep));
}

template <class Lanes>
void layer_norm_row(const Norm& norm, const float* x, float* y) {
  const auto count = static_cast<float>(norm.width);
  Lanes sum = Lanes::all(0.0F);
  for (std::size_t at = 0; at < norm.width; at += kLanes) {
    sum = Lanes::add(sum, Lanes::load(x + at));
  }
  const Lanes mean = Lanes::all(Lanes::fold_sum(sum) / count);
  Lanes squares = Lanes::all(0.0F);
  for (std::size_t at = 0; at < norm.width; at += kLanes) {
    const Lanes c = centred(x, at, norm.width, mean);
    squares = Lanes::fma(c, c, squares);
  }
  const float variance = Lanes::fold_sum(squares) / count;
  const Lanes scale = Lanes::all(1.0F / Lanes::root(variance + 1e-5F));
  for (std::size_t at = 0; at < norm.width; at += kLanes) {
    const Lanes c = Lanes::mul(centred(x, at, norm.width, mean), scale);
    Lanes::store(y + at, Lanes::fma(c, Lanes::load(norm.weight + at), Lanes::load(norm.bias + at)));
  }
}

template <class Lanes>
void layer_norm(const Norm& norm, const float* x, std::size_t stride, std::size_t rows, float* y) {
  for (std::size_t i = 0; i < rows; ++i)
    layer_norm_row<Lanes>(norm, x + i * stride, y + i * stride);
}

template <class Lanes>
void perturb(const float* mean, const float* sigma, const float* in, const float* out,
             std::size_t depth, float* y) {
  const Lanes columns = Lanes::load(out);
  for (std::size_t k = 0; k < depth; ++k) {
    const Lanes noise = Lanes::mul(Lanes::all(in[k]), columns);
    const std::size_t at = k * kLanes;
    Lanes::store(y + at, Lanes::fma(Lanes::load(sigma + at), noise, Lanes::load(mean + at)));
  }
}

template <class Lanes>
constexpr Kernels kernels_with(const char* name) {
  return {name,           multiply<Lanes>, layer_norm<Lanes>,
          softmax<Lanes>, perturb<Lanes>,  exponential<Lanes>};
}

}  // namespace
}  // namespace linewright::kernels
