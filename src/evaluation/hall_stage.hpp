#pragma once

#include <string>

#include "linewright/evaluation/hall_scene.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "routes_view.hpp"

namespace linewright::hall {

/// Everything in the hall, view.width x view.height.
[[nodiscard]] std::string stage_svg(const LogDocument& log, const HallScene& scene,
                                    const routes::View& view);

}  // namespace linewright::hall
