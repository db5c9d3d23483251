#pragma once

#include <string>

#include "label_places.hpp"
#include "linewright/map/polygon.hpp"
#include "routes_view.hpp"

namespace linewright::routes {

/// The box around the polygon, pixels.
[[nodiscard]] labels::Box box_of(const Polygon& polygon, const View& view);

/// The name inside of a polygon, in the middle if there is room, written across or upwards; empty
/// when it does not fit in or other names leave no room. For after Placer::place().
[[nodiscard]] std::string name_within(const Polygon& polygon, const std::string& name,
                                      const View& view, labels::Placer& placer);

/// The name below, above or beside a polygon, where other names leave room; empty: nowhere.
[[nodiscard]] std::string name_beside(const Polygon& polygon, const std::string& name,
                                      const View& view, labels::Placer& placer);

}  // namespace linewright::routes
