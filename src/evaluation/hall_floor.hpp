#pragma once

#include "linewright/evaluation/log_document.hpp"
#include "linewright/map/polygon.hpp"

namespace linewright::hall {

/// The part of the floor that is drawn: the hall, or what is around the stations and machines of a
/// log without one.
[[nodiscard]] Rectangle floor_of(const LogHeader& header);

}  // namespace linewright::hall
