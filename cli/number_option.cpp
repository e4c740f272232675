#include "cli/number_option.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace drape {
namespace {

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number number{};
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

template <class Number>
CLI::Validator validator(const char* kind, const Range& range) {
  const auto problem = [kind, range](const std::string& text) -> std::string {
    const std::optional<Number> number = parse<Number>(text);
    if (number && std::isfinite(static_cast<double>(*number)) && range.contains(static_cast<double>(*number))) {
      return {};
    }
    return fmt::format("expected {} {}, found '{}'", kind, range.text(), text);
  };
  return CLI::Validator(problem, "");
}

}  // namespace

CLI::Validator number_in(const Range& range) { return validator<double>("a number", range); }

CLI::Validator whole_number_in(const Range& range) { return validator<std::int64_t>("a whole number", range); }

}  // namespace drape
