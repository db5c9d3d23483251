#include "condition_parser.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "linewright/base/random.hpp"

namespace linewright::loading {
namespace {

constexpr int kVariables = 5;
using Values = std::array<int, kVariables>;

/// Knows x0 ... x4 as the counts of places 0 ... 4.
std::variant<Variable, ConditionFault> look_up(std::string_view name) {
  if (name.size() == 2 && name[0] == 'x' && name[1] >= '0' && name[1] < '0' + kVariables) {
    return Variable{VariableKind::kPlaceCount, name[1] - '0'};
  }
  return ConditionFault{fmt::format("no {}", name), ""};
}

Condition parsed(const std::string& text) {
  auto result = parse_condition(text, look_up);
  if (const auto* fault = std::get_if<ConditionFault>(&result)) {
    ADD_FAILURE() << text << ": " << fault->message;
    return {};
  }
  return std::get<Condition>(std::move(result));
}

std::string fault_of(const std::string& text) {
  const auto result = parse_condition(text, look_up);
  const auto* fault = std::get_if<ConditionFault>(&result);
  return fault == nullptr ? "" : fault->message;
}

bool holds(const Comparison& c, const Values& values) {
  int sum = c.constant;
  for (const Term& term : c.terms) {
    sum += term.coefficient * values[static_cast<std::size_t>(term.variable.index)];
  }
  return relation_holds(sum, c.relation);
}

bool holds(const Condition& condition, const Values& values) {
  if (condition.always()) return true;
  for (const auto& clause : condition.any_of) {
    bool all = true;
    for (const Comparison& comparison : clause) all = all && holds(comparison, values);
    if (all) return true;
  }
  return false;
}

/// A random expression, as text and as a tree that is evaluated directly.
struct Expression {
  enum class Kind { kComparison, kAnd, kOr, kNot };
  Kind kind = Kind::kComparison;
  std::vector<Expression> parts;
  std::string left;
  std::string right;
  std::string relation;
  std::array<std::array<int, kVariables + 1>, 2> sums{};  ///< per side: coefficients, constant
};

std::string random_sum(RandomStream& random, std::array<int, kVariables + 1>& sum) {
  std::string text;
  const int terms = random.between(1, 3);
  for (int i = 0; i < terms; ++i) {
    const bool minus = random.below(3) == 0;
    if (i > 0 || minus) text += minus ? " - " : " + ";
    const int sign = minus ? -1 : 1;
    const int number = random.between(0, 4);
    const auto variable = random.below(kVariables);
    switch (random.below(4)) {
      case 0:
        text += fmt::format("{}", number);
        sum[kVariables] += sign * number;
        break;
      case 1:
        text += fmt::format("{}*x{}", number, variable);
        sum[variable] += sign * number;
        break;
      case 2:
        text += fmt::format("x{} * {}", variable, number);
        sum[variable] += sign * number;
        break;
      default:
        text += fmt::format("x{}", variable);
        sum[variable] += sign;
        break;
    }
  }
  return text;
}

Expression random_expression(RandomStream& random, int depth) {
  Expression e;
  if (depth == 0 || random.below(4) == 0) {
    static constexpr std::array kRelations = {"=", "==", "!=", "<", "<=", ">", ">="};
    e.left = random_sum(random, e.sums[0]);
    e.right = random_sum(random, e.sums[1]);
    e.relation = kRelations[random.below(kRelations.size())];
    return e;
  }
  static constexpr std::array kKinds = {Expression::Kind::kAnd, Expression::Kind::kOr,
                                        Expression::Kind::kNot};
  e.kind = kKinds[random.below(kKinds.size())];
  const int parts = e.kind == Expression::Kind::kNot ? 1 : random.between(2, 3);
  for (int i = 0; i < parts; ++i) e.parts.push_back(random_expression(random, depth - 1));
  return e;
}

/// `binding`: 0 inside of `or`, 1 inside of `and`, 2 after `not`; parentheses only where needed.
std::string text_of(const Expression& e, int binding) {
  switch (e.kind) {
    case Expression::Kind::kComparison:
      return fmt::format("{} {} {}", e.left, e.relation, e.right);
    case Expression::Kind::kNot:
      return "not " + text_of(e.parts[0], 2);
    case Expression::Kind::kAnd:
    case Expression::Kind::kOr:
      break;
  }
  const bool is_and = e.kind == Expression::Kind::kAnd;
  std::string text;
  for (const Expression& part : e.parts) {
    if (!text.empty()) text += is_and ? " and " : " or ";
    text += text_of(part, is_and ? 1 : 0);
  }
  return binding > (is_and ? 1 : 0) ? "(" + text + ")" : text;
}

int value_of(const std::array<int, kVariables + 1>& sum, const Values& values) {
  int value = sum[kVariables];
  for (std::size_t i = 0; i < kVariables; ++i) value += sum[i] * values[i];
  return value;
}

bool evaluate(const Expression& e, const Values& values) {
  const auto part = [&](std::size_t i) { return evaluate(e.parts[i], values); };
  bool result = e.kind == Expression::Kind::kAnd;
  switch (e.kind) {
    case Expression::Kind::kNot:
      return !part(0);
    case Expression::Kind::kAnd:
      for (std::size_t i = 0; i < e.parts.size(); ++i) result = part(i) && result;
      return result;
    case Expression::Kind::kOr:
      for (std::size_t i = 0; i < e.parts.size(); ++i) result = part(i) || result;
      return result;
    case Expression::Kind::kComparison:
      break;
  }
  const int left = value_of(e.sums[0], values);
  const int right = value_of(e.sums[1], values);
  if (e.relation == "!=") return left != right;
  if (e.relation == "<") return left < right;
  if (e.relation == "<=") return left <= right;
  if (e.relation == ">") return left > right;
  if (e.relation == ">=") return left >= right;
  return left == right;
}

TEST(ConditionParser, NormalFormIsTrueExactlyWhenTheExpressionIs) {
  RandomStream random(1);
  for (int round = 0; round < 500; ++round) {
    const Expression expression = random_expression(random, random.between(0, 3));
    const std::string text = text_of(expression, 0);
    const Condition condition = parsed(text);
    EXPECT_EQ(condition.text, text);
    for (int sample = 0; sample < 100; ++sample) {
      Values values{};
      for (int& value : values) value = random.between(0, 4);
      ASSERT_EQ(holds(condition, values), evaluate(expression, values)) << text;
    }
  }
}

TEST(ConditionParser, BothIsTrueExactlyWhenEachIs) {
  RandomStream random(2);
  for (int round = 0; round < 200; ++round) {
    const Expression a = random_expression(random, 2);
    const Expression b = random_expression(random, 2);
    const auto joined = both(parsed(text_of(a, 0)), parsed(text_of(b, 0)));
    ASSERT_TRUE(joined.has_value());
    for (int sample = 0; sample < 50; ++sample) {
      Values values{};
      for (int& value : values) value = random.between(0, 4);
      ASSERT_EQ(holds(*joined, values), evaluate(a, values) && evaluate(b, values));
      ASSERT_EQ(holds(parsed(joined->text), values), holds(*joined, values)) << joined->text;
    }
  }
}

TEST(ConditionParser, AndBindsTighterThanOrAndNotTighterThanAnd) {
  EXPECT_EQ(parsed("x0 > 0 or x1 > 0 and x2 > 0").any_of.size(), 2U);
  EXPECT_TRUE(holds(parsed("not x0 > 0 and x1 > 0"), {0, 1, 0, 0, 0}));
  EXPECT_FALSE(holds(parsed("not x0 > 0 and x1 > 0"), {0, 0, 0, 0, 0}));
}

TEST(ConditionParser, AllNegationsEndUpInTheRelations) {
  const Condition condition = parsed("not (x0 > 0 or not x1 == 2)");
  ASSERT_EQ(condition.any_of.size(), 1U);
  EXPECT_EQ(condition.any_of[0][0].relation, Relation::kLessEqual);
  EXPECT_EQ(condition.any_of[0][1].relation, Relation::kEqual);
}

TEST(ConditionParser, SaysWhereItStoppedAndWhatWasExpected) {
  EXPECT_EQ(fault_of(""), "at the start it ends where a number or a name must be");
  EXPECT_EQ(fault_of("x0 >"), "after '>' it ends where a number or a name must be");
  EXPECT_EQ(fault_of("x0 > > 1"), "after '>' '>' stands where a number or a name must be");
  EXPECT_EQ(fault_of("x0"), "after 'x0' it ends where a comparison such as '> 0' must be");
  EXPECT_EQ(fault_of("(x0 > 1"), "after '1' it ends where ')' must be");
  EXPECT_EQ(fault_of("x0 > 1)"), "after '1' ')' stands where 'and', 'or' or the end must be");
  EXPECT_EQ(fault_of("0 < x0 < 3"),
            "after 'x0' '<' stands where 'and' before a second comparison must be");
  EXPECT_EQ(fault_of("x0 > 3rd"), "after '>' '3rd' stands where a number or a name must be");
  EXPECT_EQ(fault_of("x9 > 0"), "no x9");
  EXPECT_EQ(fault_of("x0 > 99999999999"), "'99999999999' is too large");
}

TEST(ConditionParser, HugeConditionsAreRefusedInsteadOfExpanded) {
  std::string product = "(x0 > 0 or x1 > 0)";
  for (int i = 0; i < 30; ++i) product += " and (x0 > 0 or x1 > 0)";
  EXPECT_EQ(fault_of(product), "too large when written as alternatives");
  EXPECT_EQ(fault_of(std::string(5000, '(') + "x0 > 0"), "too deeply nested");
  std::string sum = "x0";
  for (int i = 0; i < 100; ++i) sum += " + 1";
  EXPECT_EQ(fault_of(sum + " > 0"), "too many terms in one comparison");
  EXPECT_EQ(fault_of(std::string(20'000, ' ')), "longer than 10000 characters");
}

}  // namespace
}  // namespace linewright::loading
