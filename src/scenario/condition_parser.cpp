#include "condition_parser.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include "condition_tokens.hpp"
#include "limits.hpp"
#include "linewright/scenario/problems.hpp"

namespace linewright::loading {
namespace {

using Kind = ConditionToken::Kind;
using Clauses = std::vector<std::vector<Comparison>>;

constexpr std::size_t kLongestText = 10'000;
constexpr std::size_t kMostComparisons = 1'000;
constexpr std::size_t kMostTerms = 64;
constexpr int kDeepest = 64;

struct Fault {
  ConditionFault fault;
};

std::size_t comparisons_in(const Clauses& clauses) {
  std::size_t count = 0;
  for (const auto& clause : clauses) count += clause.size();
  return count;
}

bool is_small(std::size_t comparisons) { return comparisons <= kMostComparisons; }

Clauses any(Clauses a, Clauses b) {
  std::move(b.begin(), b.end(), std::back_inserter(a));
  return a;
}

/// Every clause of one with every clause of the other. Nothing when that would be too large.
std::optional<Clauses> all(Clauses a, const Clauses& b) {
  const std::size_t size = comparisons_in(a) * b.size() + comparisons_in(b) * a.size();
  if (!is_small(size)) return std::nullopt;
  if (b.size() == 1) {  // nothing is multiplied: no need to copy what is there already
    for (auto& clause : a) clause.insert(clause.end(), b.front().begin(), b.front().end());
    return a;
  }
  Clauses product;
  for (const auto& left : a) {
    for (const auto& right : b) {
      product.push_back(left);
      product.back().insert(product.back().end(), right.begin(), right.end());
    }
  }
  return product;
}

Relation negated(Relation relation) {
  switch (relation) {
    case Relation::kEqual:
      return Relation::kNotEqual;
    case Relation::kNotEqual:
      return Relation::kEqual;
    case Relation::kLess:
      return Relation::kGreaterEqual;
    case Relation::kLessEqual:
      return Relation::kGreater;
    case Relation::kGreater:
      return Relation::kLessEqual;
    case Relation::kGreaterEqual:
      return Relation::kLess;
  }
  return relation;
}

std::optional<Relation> relation_of(const ConditionToken& token) {
  static constexpr std::array<std::pair<std::string_view, Relation>, 7> kRelations = {
      {{"=", Relation::kEqual},
       {"==", Relation::kEqual},
       {"!=", Relation::kNotEqual},
       {"<", Relation::kLess},
       {"<=", Relation::kLessEqual},
       {">", Relation::kGreater},
       {">=", Relation::kGreaterEqual}}};
  for (const auto& [symbol, relation] : kRelations) {
    if (token.kind == Kind::kSymbol && token.text == symbol) return relation;
  }
  return std::nullopt;
}

/// Recursive descent. `negate` is passed down instead of negating what came up (De Morgan), so the
/// normal form is built directly.
class Parser {
 public:
  Parser(std::string_view text, const VariableLookup& lookup)
      : tokens_(condition_tokens(text)), lookup_(lookup) {}

  Clauses parse() {
    Clauses clauses = parse_or(false);
    if (peek().kind != Kind::kEnd) fail("'and', 'or' or the end");
    return clauses;
  }

 private:
  [[nodiscard]] const ConditionToken& peek() const { return tokens_[next_]; }
  ConditionToken take() { return tokens_[next_ + 1 < tokens_.size() ? next_++ : next_]; }
  bool take_if(std::string_view word) {
    if (!peek().is(word)) return false;
    ++next_;
    return true;
  }

  Clauses parse_or(bool negate) {
    Clauses clauses = parse_and(negate);
    while (take_if("or")) clauses = join(std::move(clauses), parse_and(negate), negate);
    return clauses;
  }

  Clauses parse_and(bool negate) {
    Clauses clauses = parse_not(negate);
    while (take_if("and")) clauses = join(std::move(clauses), parse_not(negate), !negate);
    return clauses;
  }

  Clauses parse_not(bool negate) {
    if (++depth_ > kDeepest) throw Fault{{"too deeply nested", "use fewer parentheses and 'not'"}};
    Clauses clauses;
    if (take_if("not")) {
      clauses = parse_not(!negate);
    } else if (take_if("(")) {
      clauses = parse_or(negate);
      if (!take_if(")")) fail("')'");
    } else {
      clauses = parse_comparison(negate);
    }
    --depth_;
    return clauses;
  }

  static Clauses join(Clauses a, Clauses b, bool must_hold_both) {
    if (!must_hold_both) {
      if (is_small(comparisons_in(a) + comparisons_in(b))) return any(std::move(a), std::move(b));
    } else if (auto product = all(std::move(a), b)) {
      return std::move(*product);
    }
    throw Fault{{"too large when written as alternatives", "split the operation or task in two"}};
  }

  Clauses parse_comparison(bool negate) {
    Comparison comparison;
    terms_ = 0;
    parse_sum(comparison, 1);
    const auto relation = relation_of(peek());
    if (!relation) fail("a comparison such as '> 0'", attribute_hint());
    take();
    comparison.relation = negate ? negated(*relation) : *relation;
    parse_sum(comparison, -1);
    if (relation_of(peek())) fail("'and' before a second comparison");
    return {{std::move(comparison)}};
  }

  [[nodiscard]] std::string attribute_hint() const {
    return peek().kind == Kind::kEnd ? "a condition compares numbers, for example: press.free == 1"
                                     : "";
  }

  void parse_sum(Comparison& comparison, std::int32_t sign) {
    std::int32_t term_sign = take_sign(sign);
    while (true) {
      parse_term(comparison, term_sign);
      if (!peek().is("+") && !peek().is("-")) return;
      term_sign = take_sign(sign);
    }
  }

  std::int32_t take_sign(std::int32_t sign) {
    if (take_if("-")) return -sign;
    take_if("+");
    return sign;
  }

  void parse_term(Comparison& comparison, std::int32_t sign) {
    if (++terms_ > kMostTerms)
      throw Fault{{"too many terms in one comparison", "count something else"}};
    if (peek().kind == Kind::kNumber) {
      const std::int32_t number = take_number();
      if (!take_if("*")) {
        comparison.constant += sign * number;
        return;
      }
      comparison.terms.push_back({take_variable(), sign * number});
      return;
    }
    const Variable variable = take_variable();
    const std::int32_t factor = take_if("*") ? take_number() : 1;
    comparison.terms.push_back({variable, sign * factor});
  }

  std::int32_t take_number() {
    if (peek().kind != Kind::kNumber) fail("a number");
    const std::string_view digits = take().text;
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || number > kLargestAmount) {
      throw Fault{{fmt::format("{} is too large", in_quotes(digits)),
                   fmt::format("numbers go up to {}", kLargestAmount)}};
    }
    return number;
  }

  Variable take_variable() {
    const ConditionToken token = peek();
    if (token.is("(")) {
      fail("a number or a name", "parentheses hold whole conditions; write sums without them");
    }
    if (token.kind != Kind::kName || token.is("and") || token.is("or") || token.is("not")) {
      fail("a number or a name");
    }
    take();
    auto found = lookup_(token.text);
    if (auto* fault = std::get_if<ConditionFault>(&found)) throw Fault{std::move(*fault)};
    return std::get<Variable>(found);
  }

  [[noreturn]] void fail(const std::string& expected, const std::string& hint = {}) const {
    const std::string before =
        next_ == 0 ? "at the start" : fmt::format("after {}", in_quotes(tokens_[next_ - 1].text));
    const std::string found =
        peek().kind == Kind::kEnd ? "it ends" : in_quotes(peek().text) + " stands";
    throw Fault{{fmt::format("{} {} where {} must be", before, found, expected),
                 hint.empty() ? operator_hint() : hint}};
  }

  [[nodiscard]] std::string operator_hint() const {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOperators = {
        {{"&&", "and"}, {"||", "or"}, {"!", "not"}, {"<>", "!="}}};
    for (const auto& [wrong, right] : kOperators) {
      if (peek().text.starts_with(wrong)) return fmt::format("write '{}' for '{}'", right, wrong);
    }
    return {};
  }

  std::vector<ConditionToken> tokens_;
  const VariableLookup& lookup_;
  std::size_t next_ = 0;
  std::size_t terms_ = 0;
  int depth_ = 0;
};

}  // namespace

std::variant<Condition, ConditionFault> parse_condition(std::string_view text,
                                                        const VariableLookup& lookup) {
  if (text.size() > kLongestText) {
    return ConditionFault{fmt::format("longer than {} characters", kLongestText),
                          "split the operation or task in two"};
  }
  try {
    return Condition{Parser(text, lookup).parse(), std::string(text)};
  } catch (Fault& fault) {
    return std::move(fault.fault);
  }
}

std::optional<Condition> both(Condition a, const Condition& b) {
  if (a.always()) return b;
  if (b.always()) return a;
  if (a.text.size() + b.text.size() > kLongestText) return std::nullopt;
  const auto bracketed = [](const Condition& c) {
    return c.any_of.size() > 1 ? "(" + c.text + ")" : c.text;
  };
  std::string text = bracketed(a) + " and " + bracketed(b);
  auto clauses = all(std::move(a.any_of), b.any_of);
  if (!clauses) return std::nullopt;
  return Condition{std::move(*clauses), std::move(text)};
}

}  // namespace linewright::loading
