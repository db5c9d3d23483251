#include "linewright/learning/learner_state.hpp"

#include <cmath>

namespace linewright {

bool UpdateReport::finite() const {
  return std::isfinite(loss) && std::isfinite(mean_q) && std::isfinite(gradient_norm);
}

}  // namespace linewright
