#pragma once

#include <string>
#include <vector>

#include "label_places.hpp"
#include "linewright/evaluation/hall_scene.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "routes_view.hpp"

namespace linewright::hall {

struct MachineMarks {
  std::string svg;
  std::vector<labels::Box> numbers;  ///< where no name should be
  std::vector<labels::Box> boxes;    ///< around the machines
};

/// The machines whose place is known: on the floor they take up, else in front of their station.
/// Each with its number (from 1, in the order of the header), its state and, while an operation
/// runs, how far that is.
[[nodiscard]] MachineMarks machine_marks(const LogHeader& header, const HallScene& scene,
                                         const routes::View& view);

/// The part of the interval that has passed, 0 ... 1.
[[nodiscard]] double share_passed(const GanttInterval& doing, Tick tick);

}  // namespace linewright::hall
