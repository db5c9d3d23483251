#include <gtest/gtest.h>

#include <set>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/geometry.hpp"
#include "linewright/base/random.hpp"

namespace linewright {
namespace {

TEST(RandomStream, GivesTheSameNumbersOnEveryPlatform) {
  RandomStream stream(42);
  // xoshiro256** seeded with SplitMix64(42): reference values of the published algorithms.
  EXPECT_EQ(stream.next(), 1546998764402558742ULL);
  EXPECT_EQ(stream.next(), 6990951692964543102ULL);
}

TEST(RandomStream, StreamsOfDifferentNamesOrIndicesDiffer) {
  std::set<std::uint64_t> first;
  for (const char* name : {"planner", "allocator"}) {
    for (std::uint64_t index = 0; index < 50; ++index) {
      first.insert(RandomStream::derive(7, name, index).next());
    }
  }
  EXPECT_EQ(first.size(), 100U);
}

TEST(RandomStream, BelowReachesEveryValueEvenlyAndNoOther) {
  RandomStream stream(1);
  std::vector<int> seen(7, 0);
  for (int i = 0; i < 70'000; ++i) ++seen.at(stream.below(7));
  for (const int count : seen) EXPECT_NEAR(count, 10'000, 500);
}

TEST(RandomStream, BetweenIncludesBothEnds) {
  RandomStream stream(1);
  std::set<int> seen;
  for (int i = 0; i < 200; ++i) seen.insert(stream.between(-1, 1));
  EXPECT_EQ(seen, (std::set<int>{-1, 0, 1}));
}

TEST(RandomStream, UniformStaysBelowOne) {
  RandomStream stream(3);
  double sum = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const double value = stream.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
  }
  EXPECT_NEAR(sum / 10'000, 0.5, 0.02);
}

TEST(Diagnostic, NamesThePlaceAndTheWayOut) {
  const Diagnostic diagnostic{
      .file = "a.yaml", .line = 3, .column = 7, .message = "bad", .hint = "good"};
  EXPECT_EQ(to_string(diagnostic), "a.yaml:3:7: error: bad\n  hint: good");
  EXPECT_EQ(to_string({.file = "a.yaml", .message = "bad", .hint = ""}), "a.yaml: error: bad");
}

TEST(Diagnostic, AnErrorCarriesAllOfThem) {
  const ScenarioError error(
      {{.file = "a", .message = "one", .hint = ""}, {.file = "a", .message = "two", .hint = ""}});
  EXPECT_STREQ(error.what(), "a: error: one\na: error: two");
  EXPECT_EQ(error.diagnostics().size(), 2U);
}

TEST(NearestName, FindsTypingErrorsAndRefusesStrangers) {
  const std::vector<std::string> names{"flange_table", "bend_table", "storage"};
  EXPECT_EQ(nearest_name("flange_tabel", names), "flange_table");
  EXPECT_EQ(nearest_name("storag", names), "storage");
  EXPECT_EQ(nearest_name("zzz", names), "");
  EXPECT_EQ(nearest_name(std::string(10'000, 'a'), names), "");
  EXPECT_EQ(name_hint("zzz", names), "known: flange_table, bend_table, storage");
}

TEST(Geometry, DistanceIsEuclidean) { EXPECT_DOUBLE_EQ(distance_m({0, 0}, {3, 4}), 5.0); }

}  // namespace
}  // namespace linewright
