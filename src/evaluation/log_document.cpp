#include "linewright/evaluation/log_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "log_events.hpp"
#include "log_fields.hpp"
#include "log_header.hpp"

namespace linewright {
namespace {

using event_log::fail;
using event_log::Json;
using event_log::LogPosition;

constexpr const char* kSimulateAgain =
    "simulate the run again: linewright simulate SCENARIO --log FILE";

/// Hands out the lines of a stream, one by one, never more than kLongestLogLine in memory.
class LineReader {
 public:
  LineReader(std::istream& stream, LogPosition& where) : stream_(stream), where_(where) {}

  /// False at the end of the input. Blank lines are skipped.
  bool next(std::string& line) {
    while (read(line)) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    }
    return false;
  }

  /// Whether the last line handed out ended with a line break.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  bool read(std::string& line) {
    line.clear();
    ++where_.line;
    while (true) {
      stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
      const auto count = static_cast<std::size_t>(stream_.gcount());
      if (stream_.bad()) fail(where_, "cannot be read to its end", "check the disk and the file");
      const bool more = !stream_.eof() && stream_.fail() && count > 0;  // the buffer was too short
      ended_ = !stream_.eof() && !more;
      if (ended_ && count == 0) return false;  // the stream had failed before
      line.append(buffer_.data(), ended_ ? count - 1 : count);
      if (line.size() > kLongestLogLine) too_long();
      if (!more) return ended_ || !line.empty();
      stream_.clear();
    }
  }

  [[noreturn]] void too_long() const {
    fail(where_,
         fmt::format("the line is longer than {} MB: this is not an event log",
                     kLongestLogLine >> 20U),
         kSimulateAgain);
  }

  std::istream& stream_;
  LogPosition& where_;
  std::array<char, 1U << 16U> buffer_{};
  bool ended_ = false;
};

/// Deepest nesting of lists and objects; the destructor of a parsed value recurses that deep.
int nesting(std::string_view json) {
  int depth = 0;
  int deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

/// Builds the document line by line and compares each line with those before it.
class DocumentReader {
 public:
  DocumentReader(std::istream& stream, const std::string& file_name, CutOffLog cut_off)
      : where_{file_name, 0},
        lines_(stream, where_),
        accepts_cut_off_(cut_off == CutOffLog::kAccept) {}

  LogDocument read() {
    std::string line;
    if (!lines_.next(line)) {
      fail({where_.file, 0}, "the file is empty", kSimulateAgain);
    }
    const std::optional<Json> header = parse(line);
    if (!header) fail(where_, "the log is cut off in its header", kSimulateAgain);
    document_.header = event_log::read_log_header(*header, where_, index_);
    while (lines_.next(line)) {
      if (ended_) fail(where_, "something stands after the event 'end'", kSimulateAgain);
      const std::optional<Json> json = parse(line);
      if (!json) break;
      add(event_log::read_log_line(*json, where_, index_));
    }
    if (!ended_ && !document_.cut_off) {
      cut_off("the log is cut off: its last line is not the event 'end'");
    }
    return std::move(document_);
  }

 private:
  void cut_off(const std::string& message) {
    const char* hint = "the run was stopped or is still going on; simulate it again to its end";
    if (!accepts_cut_off_) fail({where_.file, last_line_}, message, hint);
    document_.cut_off = Diagnostic{.severity = Diagnostic::Severity::kWarning,
                                   .file = where_.file,
                                   .line = last_line_,
                                   .message = message,
                                   .hint = hint};
    document_.end = {.tick = latest_, .status = RunStatus::kRunning, .makespan = {}};
  }

  /// None for the last line of a log that is cut off within it.
  std::optional<Json> parse(const std::string& line) {
    last_line_ = where_.line;
    if (nesting(line) > kDeepestLogNesting) {
      fail(where_, fmt::format("lists and objects are nested deeper than {}", kDeepestLogNesting),
           kSimulateAgain);
    }
    Json json = Json::parse(line, nullptr, false);
    if (!json.is_discarded()) return json;
    if (!lines_.ended() && line.front() == '{') {
      cut_off("the log is cut off in the middle of this line");
      return std::nullopt;
    }
    fail(where_, fmt::format("is not JSON: {}", event_log::in_quotes(line)),
         "an event log is one JSON object per line; see docs/formats/event_log.md");
  }

  void add(event_log::LogLine&& line) {
    if (auto* end = std::get_if<LoggedEnd>(&line)) {
      check_tick(end->tick);
      document_.end = *end;
      ended_ = true;
      return;
    }
    auto& event = std::get<LoggedEvent>(line);
    check_tick(event.tick);
    check_number(event);
    check_zone(event);
    document_.events.push_back(std::move(event));
  }

  void check_tick(Tick tick) {
    if (tick < latest_) {
      fail(where_, fmt::format("time runs backwards: tick {} after tick {}", tick, latest_),
           "events must stand in order of time; simulate the run again");
    }
    latest_ = tick;
  }

  void check_number(const LoggedEvent& event) {
    const auto n = event_log::decision_number(event);
    const auto decided = static_cast<std::int32_t>(document_.decisions.size());
    if (std::holds_alternative<LoggedDecision>(event.what)) {
      if (*n != decided + 1) {
        fail(where_, fmt::format("decision {} follows decision {}", *n, decided),
             "decisions are numbered 1, 2, 3, ...; lines may be missing, simulate the run again");
      }
      document_.decisions.push_back(document_.events.size());
    } else if (n && *n > decided) {
      fail(where_, fmt::format("decision {} has not been taken yet", *n),
           "'n' is the number of an earlier decision; simulate the run again");
    }
  }

  void check_zone(const LoggedEvent& event) {
    const auto* zone = std::get_if<LoggedZone>(&event.what);
    if (zone == nullptr) return;
    zone_closed_.resize(document_.header.zones.size(), false);
    if (zone_closed_[zone->zone.index()] == zone->closed) {
      fail(where_,
           fmt::format("zone {} is {} already",
                       event_log::in_quotes(document_.header.zones[zone->zone.index()].name),
                       zone->closed ? "closed" : "open"),
           "lines may be missing; simulate the run again");
    }
    zone_closed_[zone->zone.index()] = zone->closed;
  }

  LogPosition where_;
  LineReader lines_;
  event_log::LogIndex index_;
  LogDocument document_;
  std::vector<bool> zone_closed_;
  Tick latest_ = 0;
  int last_line_ = 0;
  bool ended_ = false;
  bool accepts_cut_off_ = false;
};

}  // namespace

LogDocument read_event_log(std::istream& stream, const std::string& file_name, CutOffLog cut_off) {
  return DocumentReader(stream, file_name, cut_off).read();
}

LogDocument load_event_log(const std::string& file, CutOffLog cut_off) {
  const auto unreadable = [&](const std::string& why) {
    fail({file, 0}, fmt::format("cannot be read: {}", why), "check the name and the folder");
  };
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) unreadable("it is a folder");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) unreadable(errno != 0 ? std::strerror(errno) : "unknown reason");
  return read_event_log(stream, file, cut_off);
}

}  // namespace linewright
