#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace linewright::testing {

/// Follows every token, worker and zone through a log, with nothing but the log.
class Audit {
  using Json = nlohmann::json;

 public:
  explicit Audit(const std::string& text);

  std::string problem;
  [[nodiscard]] int count(const std::string& place) const { return count_.at(place); }

 private:
  /// Where a worker is, or which way it is on.
  struct Motion {
    std::string kind;
    std::vector<double> from;  ///< a pose
    std::vector<double> to;
    Json path;  ///< empty: the straight line
    int departs = 0;
    int arrives = 0;
    bool stopped = false;  ///< at `from`
  };

  void run();
  void place_workers();
  void expect_at(const Json& event, const Motion& motion, const std::vector<double>& pose);
  void follow_way(const Json& event);
  void change_zone(const Json& event);
  [[nodiscard]] static std::vector<double> pose_of(const Motion& motion, int tick);
  [[nodiscard]] std::vector<double> station(const std::string& name, const std::string& kind) const;
  std::map<std::string, int> flows(const Json& event, const char* key);
  void move(std::string where, int n, const Json& event);
  void machines(const Json& event, bool take);
  void crew(const Json& event, bool bind);

  Json head_;
  std::vector<Json> events_;
  std::map<std::string, int> count_;
  std::map<std::string, int> capacity_;
  std::set<std::string> berths_;
  std::map<std::string, std::string> standing_;  // berth -> carrier
  std::map<std::string, Json> operations_;
  std::set<std::string> taken_;
  std::set<std::string> busy_;
  std::map<int, std::vector<std::string>> bound_to_;
  std::map<std::string, Motion> motions_;  // by worker
  std::set<std::string> closed_;
};

}  // namespace linewright::testing
