#include "linewright/evaluation/statistics.hpp"

#include <array>
#include <cmath>

namespace linewright {

double student_t_975(std::size_t degrees) {
  static constexpr std::array<double, 10> kSmall{12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                                 2.4469,  2.3646, 2.3060, 2.2622, 2.2281};
  if (degrees == 0) return 0.0;
  if (degrees <= kSmall.size()) return kSmall[degrees - 1];
  // Cornish-Fisher expansion around the normal quantile (Abramowitz & Stegun 26.7.5).
  constexpr double z = 1.959963985;
  const double n = static_cast<double>(degrees);
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  const double z7 = z5 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread{.count = values.size()};
  if (values.empty()) return spread;
  for (const double value : values) spread.mean += value;
  spread.mean /= static_cast<double>(values.size());
  if (values.size() < 2) return spread;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  const double n = static_cast<double>(values.size());
  spread.sd = std::sqrt(squares / (n - 1.0));
  spread.ci95 = student_t_975(values.size() - 1) * spread.sd / std::sqrt(n);
  return spread;
}

MeanDifference welch_difference(const Spread& first, const Spread& second) {
  MeanDifference difference{.mean = second.mean - first.mean};
  if (first.count < 2 || second.count < 2) return difference;
  const double n1 = static_cast<double>(first.count);
  const double n2 = static_cast<double>(second.count);
  const double v1 = first.sd * first.sd / n1;
  const double v2 = second.sd * second.sd / n2;
  if (v1 + v2 == 0.0) return difference;
  const double degrees = (v1 + v2) * (v1 + v2) / (v1 * v1 / (n1 - 1.0) + v2 * v2 / (n2 - 1.0));
  difference.ci95 = student_t_975(static_cast<std::size_t>(degrees)) * std::sqrt(v1 + v2);
  return difference;
}

}  // namespace linewright
