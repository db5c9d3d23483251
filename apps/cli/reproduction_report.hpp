#pragma once

#include <string>

#include "reproduction.hpp"

namespace linewright::cli {

/// Writes everything into the folder of `arguments`: tables, figures, report.html. Returns the
/// tables as Markdown. `wall_s`: what this run has taken so far.
[[nodiscard]] std::string write_results(Reproduction& reproduction,
                                        const ReproduceArguments& arguments, double wall_s);

}  // namespace linewright::cli
