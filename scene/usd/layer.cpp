#include "scene/usd/layer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <string>

namespace drape {
namespace {

using Kind = UsdToken::Kind;

// Messages are formatted only on errors: these functions run once per number of the file.

/// Takes a number or a bool, which may be a word.
std::optional<double> accept_number_or_bool(UsdLexer& lexer) {
  if (!lexer.at_word("true") && !lexer.at_word("false")) return lexer.accept_number();
  return lexer.take().text == "true" ? 1 : 0;
}

/// Parses a number, or `count` > 1 of them between parentheses.
void parse_tuple(UsdLexer& lexer, UsdValue& value, std::size_t count, const std::string& owner) {
  if (count > 1 && !lexer.accept('(')) lexer.fail_expected(fmt::format("'(' and {} numbers in {}", count, owner));
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && !lexer.accept(',')) {
      lexer.fail_expected(fmt::format("',' and {} numbers in a tuple of {}", count, owner));
    }
    const std::optional<double> number = accept_number_or_bool(lexer);
    if (!number) lexer.fail_expected("a finite number in " + owner);
    value.numbers.push_back(*number);
  }
  if (count > 1 && !lexer.accept(')')) {
    lexer.fail_expected(fmt::format("')' after the {} numbers of a tuple of {}", count, owner));
  }
}

void parse_matrix(UsdLexer& lexer, UsdValue& value, const UsdType& type, const std::string& owner) {
  lexer.expect('(', "'(' before a matrix of " + owner);
  for (std::size_t row = 0; row < type.rows; ++row) {
    if (row > 0) lexer.expect(',', fmt::format("',' and {} rows in a matrix of {}", type.rows, owner));
    parse_tuple(lexer, value, type.columns, owner);
  }
  lexer.expect(')', fmt::format("')' after the {} rows of a matrix of {}", type.rows, owner));
}

void parse_element(UsdLexer& lexer, UsdValue& value, const UsdType& type, const std::string& owner) {
  if (type.kind == UsdType::Kind::text) {
    value.strings.emplace_back(lexer.expect(Kind::string, "a string in quotes in " + owner).text);
  } else if (type.rows > 1) {
    parse_matrix(lexer, value, type, owner);
  } else {
    parse_tuple(lexer, value, type.columns, owner);
  }
}

}  // namespace

UsdType usd_type(std::string_view name) {
  using enum UsdType::Kind;
  constexpr std::array<std::string_view, 10> scalar_types = {"bool",   "uchar", "int",   "uint",   "int64",
                                                             "uint64", "half",  "float", "double", "timecode"};
  if (name == "string" || name == "token") return {text, 0, 0};
  if (name == "matrix2d") return {number, 2, 2};
  if (name == "matrix3d") return {number, 3, 3};
  if (name == "matrix4d") return {number, 4, 4};
  if (std::find(scalar_types.begin(), scalar_types.end(), name) != scalar_types.end()) return {number, 1, 1};
  for (const std::string_view base : {"int", "half", "float", "double"}) {
    if (!name.starts_with(base)) continue;
    const std::string_view size = name.substr(base.size());
    for (const std::size_t n : {2, 3, 4}) {
      if (size.size() == 1 && size[0] == static_cast<char>('0' + n)) return {number, 1, n};
    }
  }
  // The other types end in the precision of their numbers: h, f or d.
  if (name.empty() || std::string_view("hfd").find(name.back()) == std::string_view::npos) return {};
  name.remove_suffix(1);
  if (name == "texCoord2") return {number, 1, 2};
  if (name == "texCoord3" || name == "point3" || name == "vector3" || name == "normal3" || name == "color3") {
    return {number, 1, 3};
  }
  if (name == "quat" || name == "color4") return {number, 1, 4};
  return {};
}

std::optional<UsdValue> parse_usd_value(const SourceText& source, UsdLexer& lexer, const UsdAttribute& attribute,
                                        const UsdType& type) {
  if (lexer.at_word("None")) {
    lexer.take();
    return std::nullopt;
  }
  UsdValue value;
  value.place = {&source, lexer.token().offset};
  if (!attribute.is_array) {
    parse_element(lexer, value, type, attribute.name);
    return value;
  }
  const std::string owner = "the array " + attribute.name;
  lexer.expect('[', "'[' before " + owner);
  while (!lexer.accept(']')) {
    parse_element(lexer, value, type, owner);
    if (!lexer.at(']') && !lexer.accept(',')) lexer.fail_expected("',' or ']' in " + owner);
  }
  return value;
}

UsdValue usd_value_of(const UsdAttribute& attribute, const UsdValue& value) {
  if (!value.located) return value;
  UsdLexer lexer(*value.place.source, value.place.offset);
  return parse_usd_value(*value.place.source, lexer, attribute, usd_type(attribute.type)).value_or(UsdValue{});
}

Eigen::Quaterniond usd_quaternion(const double* wxyz) {
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  // Divide by the largest component first: squares of huge or tiny ones would overflow or underflow.
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  return largest == 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(q.coeffs() / largest).normalized();
}

std::vector<double> usd_numbers_at(const UsdAttribute& attribute, double time) {
  const std::vector<UsdSample>& samples = attribute.samples;
  if (samples.empty()) return attribute.value ? attribute.value->numbers : std::vector<double>{};
  const auto next = std::upper_bound(samples.begin(), samples.end(), time,
                                     [](double t, const UsdSample& sample) { return t < sample.time; });
  const auto numbers_of = [&](const UsdSample& sample) { return usd_value_of(attribute, sample.value).numbers; };
  if (next == samples.begin()) return numbers_of(samples.front());
  if (next == samples.end()) return numbers_of(samples.back());
  const UsdSample& before = *std::prev(next);
  const double weight = (time - before.time) / (next->time - before.time);
  std::vector<double> result = numbers_of(before);
  if (weight == 0) return result;
  const std::vector<double> after = numbers_of(*next);
  if (after.size() != result.size()) return result;
  if (attribute.type.starts_with("quat")) {
    for (std::size_t i = 0; i + 4 <= result.size(); i += 4) {
      const Eigen::Quaterniond q = usd_quaternion(&result[i]).slerp(weight, usd_quaternion(&after[i]));
      result[i] = q.w();
      std::copy_n(q.vec().data(), 3, &result[i + 1]);
    }
    return result;
  }
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * (after[i] - result[i]);
  return result;
}

SourcePlace usd_value_place(const UsdValue& value, std::size_t index) {
  UsdLexer lexer(*value.place.source, value.place.offset);
  while (true) {
    const UsdToken token = lexer.take();
    const bool counts = token.kind == Kind::number || token.kind == Kind::string;
    if (token.kind == Kind::end || (counts && index-- == 0)) return {value.place.source, token.offset};
  }
}

}  // namespace drape
