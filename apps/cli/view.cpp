#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/hall_picture.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "viewing.hpp"

namespace linewright::cli {
namespace {

constexpr std::size_t kLargestLog = std::size_t{2} << 30U;  // bytes, held in memory

struct ViewArguments {
  std::vector<std::string> logs;
  std::string export_to;
  std::vector<std::string> snapshots;
  std::string out;
  ServeArguments serve;
};

/// File names, or where several logs have the same, the paths as they were given.
std::vector<std::string> names_of(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const std::string& file : files) {
    names.push_back(std::filesystem::path(file).filename().string());
  }
  std::vector<std::string> unique = names;
  std::sort(unique.begin(), unique.end());
  return std::adjacent_find(unique.begin(), unique.end()) == unique.end() ? names : files;
}

/// Refuses what is no log; warns of one that breaks off, of which what is there can be shown.
LogDocument checked(const std::string& file) {
  LogDocument log = load_event_log(file, CutOffLog::kAccept);
  if (log.cut_off) report(to_string(*log.cut_off));
  return log;
}

std::string text_of(const std::string& file) {
  std::string reason;
  auto text = read_file(file, kLargestLog, reason);
  if (text && text->size() <= kLargestLog) return std::move(*text);
  throw ScenarioError(file, "cannot be read: " + (text ? "it is larger than 2 GiB" : reason),
                      "check the name and the folder");
}

Tick parse_tick(const std::string& text, const LogDocument& log, const std::string& file) {
  Tick tick = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, tick);
  if (error != std::errc() || stop != end || tick < 0) {
    throw ScenarioError({}, fmt::format("--snapshots: {} is no tick", in_quotes(text)),
                        "write --snapshots 100,250,400");
  }
  if (tick > log.end.tick) {
    throw ScenarioError(file, fmt::format("has no tick {}: it ends at tick {}", tick, log.end.tick),
                        fmt::format("name ticks from 0 to {}", log.end.tick));
  }
  return tick;
}

/// NAME_tickT.svg for each log and tick; nothing is written when a tick is wrong.
void write_snapshots(const ViewArguments& arguments, const std::vector<LogDocument>& logs) {
  const std::vector<std::string> names = names_of(arguments.logs);
  std::map<std::string, std::string> pictures;  // by file
  for (std::size_t i = 0; i < logs.size(); ++i) {
    std::string stem = std::filesystem::path(names[i]).replace_extension().string();
    std::replace(stem.begin(), stem.end(), '/', '_');
    for (const std::string& text : arguments.snapshots) {
      const Tick tick = parse_tick(text, logs[i], arguments.logs[i]);
      const std::string name = fmt::format("{}_tick{}.svg", stem, tick);
      const std::string file = (std::filesystem::path(arguments.out) / name).string();
      const std::string svg = hall_picture(logs[i], tick);
      const auto [other, is_new] = pictures.emplace(file, svg);
      if (is_new || other->second == svg) continue;
      throw ScenarioError({}, fmt::format("two logs have a picture for {}", in_quotes(file)),
                          "give them one after the other, with another --out");
    }
  }
  for (const auto& [file, svg] : pictures) {
    write_file(file, svg);
    print("hall picture  " + file + "\n");
  }
}

void write_export(const ViewArguments& arguments) {
  const std::string page = load_page();
  const std::vector<std::string> names = names_of(arguments.logs);
  std::vector<NamedText> logs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    logs.push_back({names[i], text_of(arguments.logs[i])});
  }
  write_file(arguments.export_to, page_with(page, logs));
  print("page         " + arguments.export_to + "\n");
}

int serve(const ViewArguments& arguments) {
  std::string page = load_page();
  const std::vector<std::string> names = names_of(arguments.logs);
  std::vector<ServedLog> logs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    logs.push_back({names[i], std::make_shared<GrowingText>(text_of(arguments.logs[i]))});
  }
  ViewServer server(std::move(page), std::move(logs), arguments.serve.port);
  print(server.address() + "\n");
  report("Ctrl-C ends it");
  open_browser(server.address(), arguments.serve);
  server.run([](std::size_t) { return !interrupted().requested(); });
  return kInterrupted;
}

int view(const ViewArguments& arguments) {
  std::vector<LogDocument> logs;
  for (const std::string& file : arguments.logs) {
    LogDocument log = checked(file);
    if (!arguments.snapshots.empty()) logs.push_back(std::move(log));
  }
  if (!arguments.snapshots.empty()) write_snapshots(arguments, logs);
  if (!arguments.export_to.empty()) write_export(arguments);
  if (!arguments.snapshots.empty() || !arguments.export_to.empty()) return kOk;
  return serve(arguments);
}

}  // namespace

Command add_view(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  app.add_option("logs", arguments->logs,
                 "Event logs (docs/formats/event_log.md); several are compared")
      ->required()
      ->type_name("LOG.jsonl");
  app.add_option("--export", arguments->export_to,
                 "Write one page with the logs inside, which any browser opens from disk")
      ->type_name("FILE.html");
  app.add_option("--snapshots", arguments->snapshots,
                 "Write pictures of the hall at these ticks (SVG)")
      ->delimiter(',')
      ->type_name("TICK,...");
  app.add_option("--out", arguments->out, "Folder for the pictures")
      ->type_name("FOLDER")
      ->needs("--snapshots")
      ->default_str("here");
  add_serve_options(app, arguments->serve);
  app.footer(
      "Without --export and --snapshots the page is served on 127.0.0.1 until Ctrl-C.\n"
      "Examples:\n"
      "  linewright view out/run.jsonl\n"
      "  linewright view out/sap.jsonl out/random.jsonl\n"
      "  linewright view out/run.jsonl --export out/run.html\n"
      "  linewright view out/run.jsonl --snapshots 100,250,400 --out out/pictures");
  return [arguments] { return view(*arguments); };
}

}  // namespace linewright::cli
