#pragma once

#include <cstddef>
#include <vector>

namespace linewright {

/// Mean, sample standard deviation and the half-width of the 95 % confidence interval of the mean
/// (Student's t). With one value sd and ci95 are 0; with none all are 0.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0;
  double sd = 0.0;
  double ci95 = 0.0;
};

[[nodiscard]] Spread spread_of(const std::vector<double>& values);

/// The 97.5 % quantile of Student's t with `degrees` >= 1 degrees of freedom, within 1e-3.
[[nodiscard]] double student_t_975(std::size_t degrees);

}  // namespace linewright
