#include <string>
#include <utility>
#include <vector>

#include "linewright/scenario/shape_makers.hpp"
#include "option_fields.hpp"
#include "option_nodes.hpp"

namespace linewright::training_files {
namespace {

using loading::Field;
using loading::ShapePtr;
using Kind = loading::Shape::Kind;

constexpr std::size_t kMostRules = 1000;
constexpr std::size_t kMostKinds = 16;
constexpr std::int32_t kMostOfAKind = 10'000;

ShapePtr horizon_shape(Tick most) {
  const ShapePtr crew =
      loading::names_to(loading::integer(0, kMostOfAKind),
                        "a mapping from kinds of workers to numbers", "", kMostKinds);
  const ShapePtr rule = loading::mapping(
      "a mapping {crew: {human: 1}, ticks: 1250}",
      {loading::key("crew", crew, ""), loading::required("ticks", loading::integer(1, most), "")});
  return loading::one_of(
      {loading::choice({"scenario"}), loading::integer(1, most),
       loading::list(rule, "a list of {crew: {KIND: count}, ticks: number}", 1, kMostRules)});
}

/// Collects the fields of each group.
class ShapeBuilder {
 public:
  void group(const char* name) { groups_.emplace_back(name, std::vector<Field>()); }
  void text(const char* name, const std::string&) {
    add(name, loading::scalar(Kind::kName, "a name"));
  }
  template <class Enum>
  void choice(const char* name, const Enum&, std::vector<std::string> names) {
    add(name, loading::choice(std::move(names)));
  }
  template <class Number>
  void whole(const char* name, const Number&, std::int64_t min, std::int64_t max) {
    add(name, loading::integer(min, max));
  }
  void real(const char* name, double, double min, double max) {
    add(name, loading::real(min, max));
  }
  void flag(const char* name, bool) { add(name, loading::scalar(Kind::kBoolean, "true or false")); }
  void order(const char* name, const std::optional<std::int32_t>&, std::int64_t min,
             std::int64_t max) {
    add(name, loading::one_of({loading::choice({"scenario"}), loading::integer(min, max)}));
  }
  void horizon(const char* name, const std::vector<HorizonRule>&, Tick most) {
    add(name, horizon_shape(most));
  }

  [[nodiscard]] loading::Shape take() {
    std::vector<Field> fields;
    for (auto& [name, keys] : groups_) {
      fields.push_back(
          loading::key(name, loading::mapping("a mapping of options", std::move(keys)), ""));
    }
    return *loading::mapping("a mapping of groups of options", std::move(fields));
  }

 private:
  void add(const char* name, ShapePtr shape) {
    groups_.back().second.push_back(loading::key(name, std::move(shape), ""));
  }

  std::vector<std::pair<std::string, std::vector<Field>>> groups_;
};

}  // namespace

const loading::Shape& options_shape() {
  static const loading::Shape kShape = [] {
    const TrainingOptions defaults;
    ShapeBuilder builder;
    visit_options(defaults, builder);
    return builder.take();
  }();
  return kShape;
}

}  // namespace linewright::training_files
