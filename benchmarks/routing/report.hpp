#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace linewright::bench {

/// Seconds that this thread has computed for: what a measurement on a machine with other work can
/// be compared by.
[[nodiscard]] double cpu_s();
/// Seconds on the clock.
[[nodiscard]] double wall_s();

/// The value below which `share` (0 ... 1) of the values lie; 0 when there is none.
[[nodiscard]] double quantile(std::vector<double> values, double share);
[[nodiscard]] double sum_of(const std::vector<double>& values);
[[nodiscard]] double mean_of(const std::vector<double>& values);
/// "1.2  3.4  5.6": median, 95th percentile and maximum of seconds, in milliseconds.
[[nodiscard]] std::string spread_ms(const std::vector<double>& seconds);

/// Prints rows of cells in columns; the first row is the heading.
void print_table(const std::vector<std::vector<std::string>>& rows);
/// Prints a title and what the section measures.
void print_title(const std::string& title, const std::string& about);

}  // namespace linewright::bench
