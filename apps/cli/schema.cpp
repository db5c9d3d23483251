#include "common.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::cli {

Command add_schema(CLI::App& app) {
  app.footer("Example:\n  linewright schema > scenario.schema.json");
  return [] {
    print(scenario_json_schema());
    return static_cast<int>(kOk);
  };
}

}  // namespace linewright::cli
