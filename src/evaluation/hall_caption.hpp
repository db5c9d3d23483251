#pragma once

#include <string>

#include "linewright/evaluation/hall_scene.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright::hall {

struct Caption {
  std::string svg;
  double height = 0.0;
};

/// What everyone does, the machines and the material, as text in two columns, `width` pixels wide.
[[nodiscard]] Caption caption_of(const LogDocument& log, const HallScene& scene, double width);

}  // namespace linewright::hall
