#include "ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace linewright::charts {
namespace {

constexpr double kLargest = 1e15;
constexpr const char* kMinus = "\xE2\x88\x92";  // U+2212

struct Step {
  std::int64_t mantissa = 1;
  int exponent = 0;
};

/// `count` steps. Dividing by a power of ten is exact where multiplying by its inverse is not.
double multiple(double count, const Step& step) {
  const double units = count * static_cast<double>(step.mantissa);
  return step.exponent < 0 ? units / std::pow(10.0, -step.exponent)
                           : units * std::pow(10.0, step.exponent);
}

Step next(Step step) {
  switch (step.mantissa) {
    case 1:
      return {2, step.exponent};
    case 2:
      return {5, step.exponent};
    default:
      return {1, step.exponent + 1};
  }
}

/// The smallest nice step with at most `most` steps in the span.
Step nice_step(double span, std::size_t most, bool integer) {
  const double wanted = span / static_cast<double>(std::max<std::size_t>(most, 1));
  Step step{1, static_cast<int>(std::floor(std::log10(wanted))) - 1};
  if (integer && step.exponent < 0) step.exponent = 0;
  while (multiple(1.0, step) < wanted * (1.0 - 1e-9)) step = next(step);
  return step;
}

/// The ends that the axis fixes, where they make sense with the others.
void apply_fixed(const ChartAxis& axis, double& low, double& high) {
  const bool fixes_low = axis.low && usable(*axis.low);
  const bool fixes_high = axis.high && usable(*axis.high);
  const double fixed_low = fixes_low ? *axis.low : low;
  const double fixed_high = fixes_high ? *axis.high : high;
  if (fixed_low >= fixed_high) return;
  low = fixed_low;
  high = fixed_high;
}

/// Widens what is too narrow to be told apart, so that every step is many times a rounding error.
void widen(double& low, double& high) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > std::max(1e-12, size * 1e-9)) return;
  const double room = size > 1e-9 ? size * 0.05 : 0.5;
  low -= room;
  high += room;
}

/// Digits with a comma between thousands.
std::string grouped(std::string digits) {
  std::size_t end = digits.find('.');
  if (end == std::string::npos) end = digits.size();
  while (end > 3) {
    end -= 3;
    digits.insert(end, ",");
  }
  return digits;
}

std::string number(double value, int decimals) {
  const std::string digits = grouped(fmt::format("{:.{}f}", std::abs(value), decimals));
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return value < 0.0 && !zero ? kMinus + digits : digits;
}

std::string superscript(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

/// How the numbers of one axis are written: divided by 10^`power`, and then what says so.
struct Notation {
  int power = 0;
  std::string suffix;
};

Notation notation_of(const Ticks& ticks) {
  double largest = 0.0;
  for (const double value : ticks.values) largest = std::max(largest, std::abs(value));
  if (largest >= 1e6 && largest < 1e9 && ticks.exponent >= 4) return {6, " M"};
  if (largest < 1e9 && (largest >= 1e-3 || largest == 0.0)) return {};
  const int power = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  return {power, "×10" + superscript(power)};
}

}  // namespace

bool usable(double value) { return std::isfinite(value) && std::abs(value) <= kLargest; }

void Range::add(double value) {
  if (!usable(value)) return;
  const bool first = empty();
  low_ = first ? value : std::min(low_, value);
  high_ = first ? value : std::max(high_, value);
}

Ticks make_ticks(const Range& data, const ChartAxis& axis, AxisEnd end, std::size_t most) {
  double low = data.empty() ? 0.0 : data.low();
  double high = data.empty() ? 1.0 : data.high();
  apply_fixed(axis, low, high);
  widen(low, high);
  const Step step = nice_step(high - low, most, axis.integer);
  const double size = multiple(1.0, step);
  double first = std::ceil(low / size - 1e-6);
  double last = std::floor(high / size + 1e-6);
  if (end == AxisEnd::kTick) {
    if (multiple(first, step) > low && axis.low != low) low = multiple(first -= 1.0, step);
    if (multiple(last, step) < high && axis.high != high) high = multiple(last += 1.0, step);
  }
  Ticks ticks{low, high, {}, step.mantissa, step.exponent};
  for (double i = first; i <= last; i += 1.0) ticks.values.push_back(multiple(i, step));
  return ticks;
}

std::vector<std::string> tick_labels(const Ticks& ticks, std::string_view unit) {
  const Notation notation = notation_of(ticks);
  const int decimals = std::clamp(notation.power - ticks.exponent, 0, 15);
  std::vector<std::string> labels;
  for (const double value : ticks.values) {
    const std::string digits = number(value / std::pow(10.0, notation.power), decimals);
    const bool zero = value == 0.0;
    labels.push_back(fmt::format("{}{}{}", zero ? "0" : digits, zero ? "" : notation.suffix, unit));
  }
  return labels;
}

std::string value_text(double value, std::string_view unit) {
  const std::string digits = fmt::format("{:.6g}", std::abs(value));
  return fmt::format("{}{}{}", value < 0.0 ? kMinus : "", digits, unit);
}

}  // namespace linewright::charts
