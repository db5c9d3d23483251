// The routes that are kept beside a scenario.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "linewright/base/files.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

constexpr const char* kHall = R"(schema: line/1
name: hall
horizon: 500
order: {product: p, quantity: 3, finished_in: done}
workers:
  robot: {footprint_m: [1.0, 0.6], turning_radius_m: 0.7, speed_mps: 1.0}
stations:
  rack:  {robot: [1, 1, 0]}
  table: {robot: [9, 1, 0]}
places:
  stock: {of: p, initial: order, at: rack}
  done:  {of: p, at: table}
tasks:
  move:
    crew: {robot: 1}
    when: [stock > 0]
    steps:
      - {robot: [{go: rack}, {transfer: [stock, done]}, {go: table}]}
map:
  bounds: [0, 10, 0, 6]
  obstacles: {shelf: [4, 5, 0, WIDTH]}
)";

class RoutesBesideAScenario : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("linewright_routes_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    write_scenario("3");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_scenario(const std::string& width) const {
    std::string text = kHall;
    text.replace(text.find("WIDTH"), 5, width);
    write_file(scenario(), text);
  }
  [[nodiscard]] std::string scenario() const { return (folder_ / "hall.yaml").string(); }
  [[nodiscard]] std::string cache() const { return scenario() + ".routes"; }
  [[nodiscard]] std::string cache_bytes() const {
    std::ifstream in(cache(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] double metres(const Scenario& loaded) const {
    return loaded.line.travel[0].leg(StationId(0), StationId(1)).metres;
  }

  std::filesystem::path folder_;
};

TEST_F(RoutesBesideAScenario, AreStoredAndTakenFromThere) {
  const Scenario planned = load_scenario(scenario());
  ASSERT_TRUE(std::filesystem::exists(cache()));
  bool planned_again = false;
  LoadOptions options;
  options.progress = [&](std::size_t, std::size_t) { planned_again = true; };
  const Scenario stored = load_scenario(scenario(), options);
  EXPECT_FALSE(planned_again);
  EXPECT_TRUE(stored.warnings.empty());
  EXPECT_EQ(metres(stored), metres(planned));
}

TEST_F(RoutesBesideAScenario, ArePlannedAnewWhenTheMapChanges) {
  const Scenario before = load_scenario(scenario());
  const std::string bytes = cache_bytes();
  write_scenario("4.5");
  const Scenario after = load_scenario(scenario());
  EXPECT_GT(metres(after), metres(before) + 0.5);
  EXPECT_TRUE(after.warnings.empty());
  EXPECT_NE(cache_bytes(), bytes);
}

TEST_F(RoutesBesideAScenario, DamagedOrForeignOnesAreReplacedWithAWarning) {
  const Scenario sound = load_scenario(scenario());
  const std::string bytes = cache_bytes();
  std::string damaged = bytes;
  damaged[damaged.size() / 2] ^= 0x10;
  for (const std::string& text :
       {damaged, bytes.substr(0, 30), std::string("a diary"), std::string()}) {
    write_file(cache(), text);
    const Scenario loaded = load_scenario(scenario());
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_EQ(loaded.warnings[0].severity, Diagnostic::Severity::kWarning);
    EXPECT_EQ(loaded.warnings[0].file, cache());
    EXPECT_EQ(metres(loaded), metres(sound));
    EXPECT_EQ(cache_bytes(), bytes);
  }
}

TEST_F(RoutesBesideAScenario, AreNotStoredForAScenarioThatIsWrongOrCancelledOrWhenNotWanted) {
  LoadOptions options;
  options.route_cache = false;
  (void)load_scenario(scenario(), options);
  EXPECT_FALSE(std::filesystem::exists(cache()));
  CancelToken cancel;
  cancel.request();
  options.route_cache = true;
  options.cancel = &cancel;
  EXPECT_THROW((void)load_scenario(scenario(), options), ScenarioError);
  write_scenario("6");  // from wall to wall
  EXPECT_THROW((void)load_scenario(scenario()), ScenarioError);
  EXPECT_FALSE(std::filesystem::exists(cache()));
}

TEST_F(RoutesBesideAScenario, ThatCannotBeStoredAreAWarning) {
  std::filesystem::create_directories(cache());  // a folder has the file's name
  const Scenario loaded = load_scenario(scenario());
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_NE(loaded.warnings.back().message.find("could not be stored"), std::string::npos);
}

}  // namespace
}  // namespace linewright
