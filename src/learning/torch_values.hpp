#pragma once

#include <vector>

#include "attention.hpp"

namespace linewright::learning {

/// Where LibTorch computes: on a GPU when this build and this machine have one.
[[nodiscard]] inline torch::Device default_device() {
  return torch::cuda::is_available() ? torch::kCUDA : torch::kCPU;
}

/// A tensor on `device` of the numbers, which it may look at where they are: they must outlive it.
template <class Number>
[[nodiscard]] torch::Tensor view(const std::vector<Number>& values, std::vector<std::int64_t> shape,
                                 torch::Device device) {
  // from_blob wants a pointer to non-const; nothing writes through it.
  return torch::from_blob(const_cast<Number*>(values.data()), shape,
                          c10::CppTypeToScalarType<Number>::value)
      .to(device);
}

/// As view() with `rows` rows.
template <class Number>
[[nodiscard]] torch::Tensor rows_of(const std::vector<Number>& values, std::int64_t rows,
                                    torch::Device device) {
  return view(values, {rows, static_cast<std::int64_t>(values.size()) / rows}, device);
}

/// The numbers of a tensor; none of an undefined one.
[[nodiscard]] inline std::vector<float> numbers_of(const torch::Tensor& tensor) {
  if (!tensor.defined()) return {};
  const torch::Tensor here = tensor.detach().cpu().contiguous();
  const float* first = here.data_ptr<float>();
  return {first, first + here.numel()};
}

}  // namespace linewright::learning
