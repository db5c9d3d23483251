#include "map_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "linewright/base/utf8.hpp"

namespace linewright::map_yaml {
namespace {

/// Thrown inside this file only: the document cannot be read any further.
struct Refused {
  Spot spot;
  std::string message;
  std::string hint;
};

Spot spot_of(const YAML::Mark& mark) {
  return mark.is_null() ? Spot{} : Spot{mark.line + 1, mark.column + 1};
}

/// Takes yaml-cpp's events and refuses what a map's file cannot hold, before it can grow.
class Builder : public YAML::EventHandler {
 public:
  [[nodiscard]] std::vector<Entry> take() { return std::move(entries_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add(mark, {}); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& text) override {
    add(mark, text);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refused{spot_of(mark), "an alias is not allowed here", "write the value out"};
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    if (state_ != State::kStart) refuse_structure(mark);
    state_ = State::kKey;
  }
  void OnMapEnd() override {}
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    if (state_ != State::kValue) refuse_structure(mark);
    entries_.back().is_list = true;
    state_ = State::kList;
  }
  void OnSequenceEnd() override { state_ = State::kKey; }

 private:
  enum class State { kStart, kKey, kValue, kList };

  void add(const YAML::Mark& mark, const std::string& text) {
    if (state_ == State::kStart) refuse_structure(mark);
    if (state_ == State::kKey) {
      entries_.push_back({text, spot_of(mark), false, {}});
      state_ = State::kValue;
      return;
    }
    entries_.back().values.push_back({text, spot_of(mark)});
    if (state_ == State::kValue) state_ = State::kKey;
  }

  [[noreturn]] static void refuse_structure(const YAML::Mark& mark) {
    throw Refused{spot_of(mark), "a map's file holds lines `key: value` only",
                  "see docs/formats/map.md"};
  }

  State state_ = State::kStart;
  std::vector<Entry> entries_;
};

/// yaml-cpp takes byte 4 for the end of the input and guesses other encodings; only text gets in.
void refuse_other_than_text(std::string_view text) {
  if (text.size() > kMostBytes) {
    throw Refused{
        {}, fmt::format("the file is larger than {} bytes", kMostBytes), "is this a map's YAML?"};
  }
  const std::size_t bad = first_not_text(text);
  if (bad == text.size()) return;
  const std::string_view before = text.substr(0, bad);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0
  throw Refused{
      {static_cast<int>(1 + std::count(before.begin(), before.end(), '\n')),
       static_cast<int>(bad - line_start) + 1},
      fmt::format("byte 0x{:02x} is not allowed here", static_cast<unsigned char>(text[bad])),
      "name the YAML file of the map, not its image, and save it as UTF-8 text"};
}

std::vector<Entry> parse(std::string_view text) {
  refuse_other_than_text(text);
  std::istringstream stream{std::string(text)};
  YAML::Parser parser(stream);
  Builder builder;
  if (!parser.HandleNextDocument(builder)) {
    throw Refused{{}, "the file is empty", "see docs/formats/map.md"};
  }
  Builder second;
  if (parser.HandleNextDocument(second)) {
    throw Refused{{}, "the file holds a second YAML document", "remove the line `---`"};
  }
  return builder.take();
}

std::vector<Entry> without_duplicates(std::vector<Entry> entries, const std::string& file,
                                      std::vector<Diagnostic>& found) {
  std::vector<Entry> kept;
  for (Entry& entry : entries) {
    const auto first =
        std::find_if(kept.begin(), kept.end(), [&](const Entry& e) { return e.key == entry.key; });
    if (first == kept.end()) {
      kept.push_back(std::move(entry));
      continue;
    }
    found.push_back(
        {.severity = Diagnostic::Severity::kError,
         .file = file,
         .line = entry.spot.line,
         .column = entry.spot.column,
         .message = fmt::format("key {} is written twice", in_quotes(entry.key)),
         .hint = fmt::format("the first one is in line {}; keep one of them", first->spot.line)});
  }
  return kept;
}

}  // namespace

std::vector<Entry> read(std::string_view text, const std::string& file,
                        std::vector<Diagnostic>& found) {
  Refused refused;
  try {
    return without_duplicates(parse(text), file, found);
  } catch (const Refused& r) {
    refused = r;
  } catch (const YAML::Exception& e) {
    refused = {spot_of(e.mark), fmt::format("not valid YAML: {}", e.msg),
               "often the cause is indentation, a bracket or a colon just before"};
  }
  throw ScenarioError({{.severity = Diagnostic::Severity::kError,
                        .file = file,
                        .line = refused.spot.line,
                        .column = refused.spot.column,
                        .message = refused.message,
                        .hint = refused.hint}});
}

}  // namespace linewright::map_yaml
