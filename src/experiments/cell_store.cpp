#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cell_runs.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/experiments/cell.hpp"

namespace linewright {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t{1} << 28U;

Json to_json(const std::string& key, const ExperimentCell& cell, const CellResult& result) {
  Json object{{"format", experiments::kCellFormat},
              {"key", key},
              {"planner", cell.planner},
              {"bound", cell.bound},
              {"allocator", cell.allocator},
              {"order", cell.order},
              {"horizon", cell.horizon ? Json(*cell.horizon) : Json("scenario")},
              {"trials", cell.trials},
              {"seed", cell.seed},
              {"shield", cell.shield},
              {"wall_s", result.wall_s},
              {"crews", Json::array()}};
  for (const CellResult::Crew& crew : result.crews) {
    object["crews"].push_back({{"crew", crew.name},
                               {"makespan", crew.makespan},
                               {"finished", crew.finished},
                               {"progress", crew.progress},
                               {"distance_m", crew.distance_m},
                               {"decisions", crew.decisions}});
  }
  return object;
}

CellResult from_json(const Json& object) {
  CellResult result{.wall_s = object.at("wall_s").get<double>()};
  const bool is_bound = !object.at("bound").get<std::string>().empty();
  for (const Json& entry : object.at("crews")) {
    CellResult::Crew crew{.name = entry.at("crew").get<std::string>()};
    entry.at("makespan").get_to(crew.makespan);
    entry.at("finished").get_to(crew.finished);
    entry.at("progress").get_to(crew.progress);
    entry.at("distance_m").get_to(crew.distance_m);
    entry.at("decisions").get_to(crew.decisions);
    const std::size_t runs = crew.makespan.size();
    const std::size_t others = is_bound ? 0 : runs;
    if (runs == 0 || crew.finished.size() != others || crew.progress.size() != others ||
        crew.distance_m.size() != others || crew.decisions.size() != others) {
      throw std::runtime_error("lists of different lengths");
    }
    result.crews.push_back(std::move(crew));
  }
  if (result.crews.empty()) throw std::runtime_error("no crew");
  return result;
}

}  // namespace

std::string CellStore::file_of(const std::string& key) const {
  return folder_ + "/" + key + ".json";
}

std::optional<CellResult> CellStore::find(const std::string& key) const {
  const std::string file = file_of(key);
  if (!std::filesystem::exists(file)) return std::nullopt;
  std::string reason;
  const auto text = read_file(file, kMostBytes, reason);
  if (!text) throw ScenarioError(file, "cannot be read: " + reason, "");
  try {
    const Json object = Json::parse(*text);
    if (object.at("format") != experiments::kCellFormat || object.at("key") != key) {
      throw std::runtime_error("another format or key");
    }
    return from_json(object);
  } catch (const std::exception& wrong) {
    throw ScenarioError(file, fmt::format("is no result of a cell: {}", wrong.what()),
                        "remove the file; it will be made again");
  }
}

void CellStore::keep(const std::string& key, const ExperimentCell& cell,
                     const CellResult& result) const {
  write_file(file_of(key), to_json(key, cell, result).dump() + "\n");
}

}  // namespace linewright
