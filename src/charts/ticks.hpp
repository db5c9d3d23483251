#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/charts/chart.hpp"

// Axes of numbers: which values get a tick, and how they are written.
namespace linewright::charts {

/// Whether a value can be drawn; see chart.hpp.
[[nodiscard]] bool usable(double value);

/// The smallest and the largest of the usable values added so far.
class Range {
 public:
  void add(double value);

  [[nodiscard]] bool empty() const { return low_ > high_; }
  [[nodiscard]] double low() const { return low_; }    ///< not for empty ranges
  [[nodiscard]] double high() const { return high_; }  ///< not for empty ranges

 private:
  double low_ = 1.0;
  double high_ = 0.0;
};

/// What an axis shows. low < high; ticks ascend within it and are `mantissa` * 10^`exponent` apart.
struct Ticks {
  double low = 0.0;
  double high = 1.0;
  std::vector<double> values;
  std::int64_t mantissa = 1;  ///< 1, 2 or 5
  int exponent = 0;

  /// 0 at the low end of the axis, 1 at the high end, and beyond for values that it does not show.
  [[nodiscard]] double share(double value) const { return (value - low) / (high - low); }
};

/// Whether an axis ends at the data or at the next tick beyond.
enum class AxisEnd { kTight, kTick };

/// At most about `most` ticks over the data, or over what the axis fixes instead.
[[nodiscard]] Ticks make_ticks(const Range& data, const ChartAxis& axis, AxisEnd end,
                               std::size_t most);

/// The ticks as words, all in the same way: minus signs, thousands apart, large and tiny numbers
/// with a factor, as many decimals as the step needs.
[[nodiscard]] std::vector<std::string> tick_labels(const Ticks& ticks, std::string_view unit);

/// A value for hovering: six digits.
[[nodiscard]] std::string value_text(double value, std::string_view unit);

}  // namespace linewright::charts
