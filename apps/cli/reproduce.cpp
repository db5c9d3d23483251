#include <fmt/format.h>

#include <memory>

#include "common.hpp"
#include "reproduction.hpp"
#include "reproduction_report.hpp"

namespace linewright::cli {
namespace {

int reproduce(const ReproduceArguments& arguments) {
  const std::int64_t start = clock_ns();
  Reproduction reproduction(arguments);
  if (!reproduction.train() || !reproduction.play()) {
    report(fmt::format("interrupted: the same command goes on from what is in {}", arguments.out));
    return kInterrupted;
  }
  const double wall_s = static_cast<double>(clock_ns() - start) / 1e9;
  print(write_results(reproduction, arguments, wall_s));
  print(fmt::format(
      "Report: {0}/report.html; tables as CSV, Markdown, LaTeX and JSON: {0}/tables; figures: "
      "{0}/figures\n",
      arguments.out));
  return kOk;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  auto arguments = std::make_shared<ReproduceArguments>();
  app.add_option("what", arguments->what,
                 "`paper`, or a file or folder of experiments (docs/formats/experiment.md)")
      ->required();
  app.add_flag("--quick", arguments->quick, "Fewer seeds and runs, as the experiments say");
  app.add_option("--out", arguments->out, "Folder for runs, results, tables and the report")
      ->capture_default_str();
  app.add_option("--policies", arguments->policies,
                 "Take trained policies FOLDER/ALGORITHM/SEED.safetensors instead of training")
      ->type_name("FOLDER");
  app.footer(
      "What is there already is not done again; Ctrl-C and the same command go on.\n"
      "Example:\n  linewright reproduce paper --policies policies/seeds");
  return [arguments] { return reproduce(*arguments); };
}

}  // namespace linewright::cli
