#include "linewright/environment/observation_spec.hpp"

namespace linewright {

std::size_t TokenGroup::size() const {
  std::size_t sum = 0;
  for (std::size_t t = 0; t < tokens.size(); ++t) sum += features_of(t).size();
  return sum;
}

std::size_t ObservationSpec::feature_count() const {
  std::size_t sum = 0;
  for (const TokenGroup& group : groups) sum += group.size();
  return sum;
}

std::size_t ObservationSpec::token_count() const {
  std::size_t sum = 0;
  for (const TokenGroup& group : groups) sum += group.tokens.size();
  return sum;
}

}  // namespace linewright
