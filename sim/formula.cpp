#include "sim/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>
#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/text.hpp"

namespace drape {
namespace {

constexpr std::array<std::string_view, 3> places{"x", "y", "z"}, speeds{"vx", "vy", "vz"};
constexpr std::array<std::string_view, 1> times{"t"};

/// Returns a parser whose variables are the members of `point`, which must outlive it.
mu::Parser parser_at(FieldPoint& point) {
  mu::Parser parser;
  const std::pair<const char*, double*> variables[] = {{"x", &point.x},  {"y", &point.y},   {"z", &point.z},
                                                       {"t", &point.t},  {"vx", &point.vx}, {"vy", &point.vy},
                                                       {"vz", &point.vz}};
  for (const auto& [name, value] : variables) parser.DefineVar(name, value);
  parser.DefineConst("pi", std::numbers::pi);
  return parser;
}

/// Returns every name that a formula may use.
std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names;
  for (const auto& [name, value] : parser.GetVar()) names.push_back(name);
  for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
  names.emplace_back("pi");
  return names;
}

std::string sentence(const mu::Parser& parser, const mu::ParserError& error) {
  const std::string where = fmt::format("at its character {}", error.GetPos() + 1);
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      if (parser.GetFunDef().contains(error.GetToken())) {
        return fmt::format("'{0}' {1} is a function: write what it is of in brackets, as in {0}(x)", error.GetToken(),
                           where);
      }
      return fmt::format("unknown name '{}' {}{}", error.GetToken(), where,
                         did_you_mean(error.GetToken(), known_names(parser), "the names are"));
    case mu::ecUNEXPECTED_EOF:
    case mu::ecEMPTY_EXPRESSION:
      return "it ends where a number, a name or '(' is expected";
    case mu::ecMISSING_PARENS:
      return "a ')' is missing";
    default: {
      std::string message = error.GetMsg();
      while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
      if (!message.empty()) message.front() = static_cast<char>(std::tolower(message.front()));
      return message;
    }
  }
}

/// Returns an error if a formula assigns to its variables or has several values, which muParser allows.
std::optional<std::string> beyond_one_value(const std::string& formula, mu::Parser& parser) {
  for (std::size_t i = formula.find('='); i != std::string::npos; i = formula.find('=', i + 1)) {
    if (i + 1 < formula.size() && formula[i + 1] == '=') {
      ++i;
    } else if (i == 0 || std::string_view("<>!").find(formula[i - 1]) == std::string_view::npos) {
      return fmt::format("'=' at its character {} assigns; to compare, write '=='", i + 1);
    }
  }
  int count = 0;
  parser.Eval(count);
  if (count != 1) return fmt::format("expected one formula, found {} separated by commas", count);
  return std::nullopt;
}

}  // namespace

class FormulaField::Parsers {
 public:
  explicit Parsers(const std::array<std::string, 3>& formulas)
      : parsers_{parser_at(point_), parser_at(point_), parser_at(point_)} {
    for (std::size_t i = 0; i < 3; ++i) parsers_[i].SetExpr(formulas[i]);
  }

  std::array<double, 3> at(const FieldPoint& point) {
    point_ = point;
    return {parsers_[0].Eval(), parsers_[1].Eval(), parsers_[2].Eval()};
  }

  bool uses(std::string_view name) {
    return std::ranges::any_of(parsers_,
                               [&](mu::Parser& parser) { return parser.GetUsedVar().contains(std::string(name)); });
  }

 private:
  FieldPoint point_;
  std::array<mu::Parser, 3> parsers_;
};

FormulaField::FormulaField(const std::array<std::string, 3>& formulas) {
  for (const std::string& formula : formulas) {
    if (const auto wrong = problem(formula)) throw std::invalid_argument("\"" + formula + "\": " + *wrong);
  }
  parsers_ = std::make_unique<Parsers>(formulas);
}

FormulaField::~FormulaField() = default;
FormulaField::FormulaField(FormulaField&&) noexcept = default;
FormulaField& FormulaField::operator=(FormulaField&&) noexcept = default;

std::array<double, 3> FormulaField::at(const FieldPoint& point) const { return parsers_->at(point); }

bool FormulaField::uses(std::span<const std::string_view> names) const {
  return std::ranges::any_of(names, [&](std::string_view name) { return parsers_->uses(name); });
}

bool FormulaField::uses_position() const { return uses(places); }
bool FormulaField::uses_time() const { return uses(times); }
bool FormulaField::uses_velocity() const { return uses(speeds); }

std::optional<std::string> FormulaField::problem(const std::string& formula) {
  FieldPoint point;
  mu::Parser parser = parser_at(point);
  try {
    parser.SetExpr(formula);
    parser.Eval();
    return beyond_one_value(formula, parser);
  } catch (const mu::ParserError& error) {
    return sentence(parser, error);
  }
}

}  // namespace drape
