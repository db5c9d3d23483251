#include "linewright/line/materials.hpp"

#include <map>

namespace linewright {

Materials materials_of(const LineModel& line) {
  Materials materials;
  std::map<std::string, std::int16_t> numbers;
  for (const Place& place : line.places) {
    const std::string& of = place.of.empty() ? place.name : place.of;
    const auto next = static_cast<std::int16_t>(numbers.size());
    const auto [found, added] = numbers.try_emplace(of, next);
    if (added) materials.names.push_back(of);
    materials.by_place.push_back(found->second);
  }
  return materials;
}

}  // namespace linewright
