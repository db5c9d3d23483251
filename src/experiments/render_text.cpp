#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "linewright/experiments/render.hpp"
#include "metric_titles.hpp"
#include "number_text.hpp"

namespace linewright {
namespace {

using experiments::number_text;
using experiments::title_of;
using experiments::value_text;
using Json = nlohmann::ordered_json;

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string optional_csv(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::string markdown_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c;
  }
  return safe;
}

/// A line of a Markdown table from the texts of its cells.
std::string line_of(const std::string& first, const std::vector<std::string>& cells) {
  return fmt::format("| {} | {} |\n", first, fmt::join(cells, " | "));
}

std::string markdown_rows(const TableRow& row, Metric metric) {
  std::vector<std::string> ours;
  std::vector<std::string> paper;
  std::vector<std::string> ratio;
  for (const TableValue& value : row.values) {
    ours.push_back(value_text(value, metric));
    paper.push_back(experiments::paper_text(value, metric));
    ratio.push_back(experiments::ratio_text(value));
  }
  std::string text = line_of("**" + markdown_text(row.name) + "**", ours);
  if (row.has_paper()) text += line_of("paper", paper) + line_of("ratio", ratio);
  return text;
}

std::string markdown_table(const ResultTable& table) {
  std::string text = fmt::format("### {}\n\n", title_of(table.metric));
  text += line_of("", table.columns);
  text += line_of("---", std::vector<std::string>(table.columns.size(), "---:"));
  for (const TableRow& row : table.rows) text += markdown_rows(row, table.metric);
  return text + "\n";
}

std::string latex_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

std::string latex_row(const std::string& first, const std::vector<std::string>& cells) {
  return fmt::format("{} & {} \\\\\n", first, fmt::join(cells, " & "));
}

std::string latex_table(const ResultTable& table) {
  std::vector<std::string> columns;
  for (const std::string& column : table.columns) columns.push_back(latex_text(column));
  std::string text = fmt::format("% {}\n\\begin{{tabular}}{{l{}}}\n\\toprule\n",
                                 title_of(table.metric), std::string(columns.size(), 'r'));
  text += latex_row("", columns) + "\\midrule\n";
  for (const TableRow& row : table.rows) {
    std::vector<std::string> ours;
    std::vector<std::string> paper;
    for (const TableValue& value : row.values) {
      ours.push_back(value_text(value, table.metric, "\\,$\\pm$\\,"));
      paper.push_back(experiments::paper_text(value, table.metric));
    }
    text += latex_row(latex_text(row.name), ours);
    if (row.has_paper()) text += latex_row("\\quad paper", paper);
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

Json value_json(const TableValue& value, const std::string& column) {
  Json entry{{"column", column}};
  if (value.mean) entry["mean"] = *value.mean;
  if (value.ci95) entry["ci95"] = *value.ci95;
  if (value.low) entry["low"] = *value.low;
  if (value.high) entry["high"] = *value.high;
  if (value.paper) entry["paper"] = *value.paper;
  if (value.ratio()) entry["ratio"] = *value.ratio();
  return entry;
}

}  // namespace

std::string result_csv(const ExperimentResult& result) {
  std::string text =
      "experiment,metric,row,column,mean,ci95,low,high,over,samples,seeds,paper,ratio\n";
  for (const ResultTable& table : result.tables) {
    for (const TableRow& row : table.rows) {
      for (std::size_t c = 0; c < row.values.size(); ++c) {
        const TableValue& value = row.values[c];
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(result.experiment.name),
            name_of(table.metric), csv_field(row.name), csv_field(table.columns[c]),
            optional_csv(value.mean), optional_csv(value.ci95), optional_csv(value.low),
            optional_csv(value.high), name_of(row.over), row.samples, row.seeds,
            optional_csv(value.paper), optional_csv(value.ratio()));
      }
    }
  }
  return text;
}

std::string result_markdown(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text = fmt::format("## {}\n\n", experiment.title);
  if (!experiment.about.empty()) text += experiment.about + "\n\n";
  text += experiments::what_was_run(experiment) + "\n\n";
  for (const ResultTable& table : result.tables) text += markdown_table(table);
  if (result.claims.empty()) return text;
  text +=
      "### Claims\n\n| claim | difference | 95 % | interval | on a correct implementation |\n| --- "
      "| ---: | ---: | --- | --- |\n";
  for (const JudgedClaim& claim : result.claims) {
    text += fmt::format("| {} | {:+.2f} | ± {:.2f} | {} | {} |\n", markdown_text(claim.claim.says),
                        claim.difference.mean, claim.difference.ci95, experiments::over_text(claim),
                        name_of(claim.verdict));
  }
  return text + "\n";
}

std::string result_latex(const ExperimentResult& result) {
  std::string text = fmt::format("% {}\n", result.experiment.title);
  for (const ResultTable& table : result.tables) text += latex_table(table);
  return text;
}

std::string result_json(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  Json object{{"experiment", experiment.name},
              {"title", experiment.title},
              {"scenario", experiment.scenario},
              {"trials", experiment.trials},
              {"starts_seed", experiment.starts_seed},
              {"shield", experiment.shield},
              {"seeds", experiment.seeds},
              {"tables", Json::array()},
              {"claims", Json::array()}};
  for (const ResultTable& table : result.tables) {
    Json& entry = object["tables"].emplace_back(
        Json{{"metric", name_of(table.metric)}, {"rows", Json::array()}});
    for (const TableRow& row : table.rows) {
      Json& out = entry["rows"].emplace_back(Json{{"row", row.name},
                                                  {"seeds", row.seeds},
                                                  {"over", name_of(row.over)},
                                                  {"samples", row.samples},
                                                  {"values", Json::array()}});
      for (std::size_t c = 0; c < row.values.size(); ++c) {
        out["values"].push_back(value_json(row.values[c], table.columns[c]));
      }
    }
  }
  for (const JudgedClaim& claim : result.claims) {
    object["claims"].push_back({{"says", claim.claim.says},
                                {"metric", name_of(claim.claim.metric)},
                                {"lower", claim.claim.lower},
                                {"than", claim.claim.than},
                                {"difference", claim.difference.mean},
                                {"ci95", claim.difference.ci95},
                                {"over", experiments::over_text(claim)},
                                {"verdict", name_of(claim.verdict)}});
  }
  return object.dump(2) + "\n";
}

}  // namespace linewright
