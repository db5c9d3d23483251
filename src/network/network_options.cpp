#include "linewright/network/network_options.hpp"

#include <fmt/format.h>

#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/environment/json_text.hpp"

namespace linewright {
namespace {

constexpr const char* kTitle = "the network's options";
constexpr const char* kPerTask = "per_task";
constexpr const char* kSingle = "single";

/// Collects what is wrong.
class Checker {
 public:
  explicit Checker(const std::string& file) : file_(file) {}

  void range(const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    add(fmt::format("'{}' of the network is {}", field, value),
        fmt::format("it must be from {} to {}", low, high));
  }
  void add(std::string message, std::string hint) {
    found_.push_back({.severity = Diagnostic::Severity::kError,
                      .file = file_,
                      .line = 0,
                      .column = 0,
                      .message = std::move(message),
                      .hint = std::move(hint)});
  }
  void finish() {
    if (!found_.empty()) throw ScenarioError(std::move(found_));
  }

 private:
  const std::string& file_;
  std::vector<Diagnostic> found_;
};

NetworkOptions::Query query_of(const JsonFields& fields) {
  const std::string& name = fields.text("query");
  if (name == kPerTask) return NetworkOptions::Query::kPerTask;
  if (name == kSingle) return NetworkOptions::Query::kSingle;
  fields.wrong("query", "'per_task' or 'single'");
}

void read_integer(const JsonFields& fields, const char* key, int& value) {
  constexpr int kMost = 1 << 20;  // the ranges follow later, in check()
  if (fields.has(key)) value = static_cast<int>(fields.integer(key, 0, kMost));
}

void read_boolean(const JsonFields& fields, const char* key, bool& value) {
  if (fields.has(key)) value = fields.boolean(key);
}

}  // namespace

void check(const NetworkOptions& o, const std::string& file) {
  Checker checker(file);
  checker.range("width", o.width, 1, 1024);
  checker.range("heads", o.heads, 1, 64);
  checker.range("encoder_layers", o.encoder_layers, 0, 8);
  checker.range("feedforward", o.feedforward, 1, 4096);
  checker.range("head_hidden", o.head_hidden, 1, 4096);
  checker.range("sigma0", o.sigma0, 0.0, 10.0);
  if (o.heads >= 1 && o.width % o.heads != 0) {
    checker.add(fmt::format("'heads' of the network is {}, which does not divide 'width', {}",
                            o.heads, o.width),
                "each head takes an equal part of the width");
  }
  if (o.actor_critic && !o.dueling) {
    checker.add("'actor_critic' of the network needs 'dueling'",
                "the value stream gives the value of the state");
  }
  checker.finish();
}

std::string to_json(const NetworkOptions& o) {
  nlohmann::ordered_json json;
  json["width"] = o.width;
  json["heads"] = o.heads;
  json["encoder_layers"] = o.encoder_layers;
  json["feedforward"] = o.feedforward;
  json["head_hidden"] = o.head_hidden;
  json["query"] = o.query == NetworkOptions::Query::kPerTask ? kPerTask : kSingle;
  json["dueling"] = o.dueling;
  json["noisy"] = o.noisy;
  json["sigma0"] = o.sigma0;
  json["actor_critic"] = o.actor_critic;
  return json.dump();
}

NetworkOptions network_options_from_json(const std::string& json, const std::string& file) {
  const nlohmann::json parsed = parse_json(json, file, kTitle, 1);
  const JsonFields fields(parsed, kTitle, file);
  fields.allow_only({"width", "heads", "encoder_layers", "feedforward", "head_hidden", "query",
                     "dueling", "noisy", "sigma0", "actor_critic"});
  NetworkOptions options;
  read_integer(fields, "width", options.width);
  read_integer(fields, "heads", options.heads);
  read_integer(fields, "encoder_layers", options.encoder_layers);
  read_integer(fields, "feedforward", options.feedforward);
  read_integer(fields, "head_hidden", options.head_hidden);
  if (fields.has("query")) options.query = query_of(fields);
  read_boolean(fields, "dueling", options.dueling);
  read_boolean(fields, "noisy", options.noisy);
  if (fields.has("sigma0")) options.sigma0 = fields.number("sigma0", 0.0, 10.0);
  read_boolean(fields, "actor_critic", options.actor_critic);
  check(options, file);
  return options;
}

}  // namespace linewright
