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

/// Difference of the means of two independent samples, second minus first, and the half-width of
/// its 95 % confidence interval (Welch; degrees of freedom by Welch and Satterthwaite, rounded
/// down). With fewer than two values in either the interval is 0: there is none.
struct MeanDifference {
  double mean = 0.0;
  double ci95 = 0.0;
};
[[nodiscard]] MeanDifference welch_difference(const Spread& first, const Spread& second);

/// The 97.5 % quantile of Student's t with `degrees` >= 1 degrees of freedom, within 1e-3.
[[nodiscard]] double student_t_975(std::size_t degrees);

}  // namespace linewright
