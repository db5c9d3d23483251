#pragma once

#include <string>

#include "linewright/base/tick.hpp"
#include "linewright/evaluation/hall_scene.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright {

struct HallPictureOptions {
  double most_width = 1120.0;  ///< of the hall, pixels; it may be narrower where it is high
  double most_height = 660.0;  ///< of the hall, pixels
  bool caption = true;         ///< below the hall: what everyone does, machines, material
};

/// The hall at one moment of a recorded run, as one SVG without scripts, fonts or links, light or
/// dark as the viewer prefers: obstacles, stations with the material there, machines with their
/// state and progress, zones, carriers, workers with heading and the way ahead of them. Tasks have
/// the colours they have in the run's Gantt chart, machines the numbers of the caption. A log
/// without a hall is drawn around its stations. One `<g class="worker">` per worker. The same bytes
/// for the same log and tick. Nothing that stands in the log is executed.
[[nodiscard]] std::string hall_picture(const LogDocument& log, Tick tick,
                                       const HallPictureOptions& options = {});

/// The same for a scene of that log.
[[nodiscard]] std::string hall_picture(const LogDocument& log, const HallScene& scene,
                                       const HallPictureOptions& options = {});

}  // namespace linewright
