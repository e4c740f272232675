#include "sweep/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "core/error.hpp"

namespace drape {
namespace {

constexpr std::size_t most_combinations = 100'000;

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  return values;
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Formats a number with at least 4 significant digits, rounded by at most a thousandth of its distance `apart` to the
/// next value.
std::string rounded(double value, double apart) {
  constexpr int least = 4, most = 12;  // shows 1e-3 without rounding noise
  if (std::abs(value) <= 1e-9 * apart) return "0";
  std::string text;
  for (int digits = least; digits <= most; ++digits) {
    text = fmt::format("{:.{}g}", value, digits);
    if (std::abs(std::strtod(text.c_str(), nullptr) - value) <= 1e-3 * apart) break;
  }
  return text;
}

/// Returns the values of a range; nothing if the text does not start like one.
std::optional<std::vector<std::string>> range_values(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos || !number(text.substr(0, dots))) return std::nullopt;
  const std::string_view rest = text.substr(dots + 2);
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  std::string_view amount = rest.substr(std::min(slash + 1, rest.size()));
  const bool logarithmic = amount.ends_with("log");
  if (logarithmic) amount.remove_suffix(3);
  const auto from = number(text.substr(0, dots)), to = number(rest.substr(0, slash)), count = number(amount);
  if (!to || !count || *count < 2 || *count > most_combinations || *count != std::floor(*count)) {
    throw UsageError(fmt::format("a range is FROM..TO/COUNT or FROM..TO/COUNTlog with a count from 2 to {}, found '{}'",
                                 most_combinations, text));
  }
  if (logarithmic && !(*from > 0 && *to > 0)) {
    throw UsageError(fmt::format("a range of equal ratios goes between numbers above 0, found '{}'", text));
  }
  std::vector<std::string> values;
  for (double i = 0; i < *count; ++i) {
    const double part = i / (*count - 1);
    const double value = logarithmic ? std::exp(std::lerp(std::log(*from), std::log(*to), part))
                                     : *from * (1 - part) + *to * part;  // cannot overflow
    const double apart = logarithmic ? value * std::abs(std::log(*to) - std::log(*from)) / (*count - 1)
                                     : std::abs(*to / (*count - 1) - *from / (*count - 1));
    const bool end = i == 0 || i == *count - 1;
    values.push_back(end ? fmt::format("{:.12g}", i == 0 ? *from : *to) : rounded(value, apart));
  }
  return values;
}

}  // namespace

std::vector<std::string> parse_values(const std::string& text) {
  std::vector<std::string> values;
  for (std::string& item : split_at_commas(text)) {
    if (auto range = range_values(item)) {
      values.insert(values.end(), range->begin(), range->end());
    } else {
      values.push_back(std::move(item));
    }
  }
  return values;
}

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError(fmt::format("--vary takes key.path=value,value…, found '{}'", text));
  }
  try {
    return {text.substr(0, equals), parse_values(text.substr(equals + 1))};
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--vary {}: {}", text.substr(0, equals), error.what()));
  }
}

std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& varied, bool zipped) {
  std::vector<std::vector<std::string>> all;
  if (zipped && !varied.empty()) {
    const Variation& first = varied.front();
    all.resize(first.values.size());
    for (const Variation& variation : varied) {
      if (variation.values.size() != first.values.size()) {
        throw UsageError(fmt::format("--zip pairs values: {} has {} of them, {} has {}", first.key, first.values.size(),
                                     variation.key, variation.values.size()));
      }
      for (std::size_t i = 0; i < all.size(); ++i) all[i].push_back(variation.values[i]);
    }
    return all;
  }
  all.resize(1);
  for (const Variation& variation : varied) {
    if (all.size() * variation.values.size() > most_combinations) {
      throw UsageError(fmt::format("the values make more than {} combinations", most_combinations));
    }
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& before : all) {
      for (const std::string& value : variation.values) {
        longer.push_back(before);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::string> overrides_of(const std::vector<Variation>& varied, const std::vector<std::string>& values) {
  std::vector<std::string> overrides;
  for (std::size_t i = 0; i < varied.size(); ++i) overrides.push_back(varied[i].key + "=" + values[i]);
  return overrides;
}

std::string as_varied(std::string_view message, const std::vector<std::string>& overrides) {
  std::string text;
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t end = std::min(message.find('\n', begin), message.size());
    std::string line(message.substr(begin, end - begin));
    for (const std::string& override : overrides) {
      if (line.starts_with("--set " + override + ": ")) line.replace(0, 5, "--vary");
      // Message about a motion, which is only read.
      const std::string key = override.substr(0, override.find('='));
      if (line.starts_with(key + ": ") && line.ends_with(" in --set")) line.replace(line.size() - 5, 5, "--vary");
    }
    text += (begin == 0 ? "" : "\n") + line;
    begin = end + 1;
  }
  return text;
}

}  // namespace drape
