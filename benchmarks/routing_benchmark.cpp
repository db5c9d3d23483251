// How fast and how good routes are found: the tables of docs/routing.md. Run with `make bench`, or
// build/release/benchmarks/routing_benchmark [--thorough] [hall] [random] [planners] [curves]
// [zones]; no name: all sections.

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "routing/sections.hpp"

namespace {

struct Section {
  std::string_view name;
  void (*measure)(bool thorough);
};

using namespace linewright::bench;

constexpr std::array kSections{
    Section{"hall", measure_hall}, Section{"random", measure_random_maps},
    Section{"planners", compare_planners}, Section{"curves", compare_curves},
    Section{"zones", compare_closing}};

}  // namespace

int main(int count, char** words) {
  bool thorough = false;
  std::vector<std::string_view> names;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word == "--thorough") {
      thorough = true;
    } else {
      names.push_back(word);
    }
  }
  for (const Section& section : kSections) {
    bool wanted = names.empty();
    for (const std::string_view name : names) wanted = wanted || name == section.name;
    if (wanted) section.measure(thorough);
  }
  return 0;
}
