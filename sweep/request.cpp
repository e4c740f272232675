#include "sweep/request.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string_view>

#include "core/console.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/document.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

constexpr std::size_t most_combinations = 100'000;

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  bool escaped = false;  // a backslash precedes, in a string that has escapes
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote && !escaped) quote = 0;
      escaped = quote == '"' && c == '\\' && !escaped;
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
  const double number = std::strtod(text.c_str(), nullptr);
  const bool whole = number == std::floor(number) && std::abs(number) < 1e12;
  return whole ? fmt::format("{:.0f}", number) : text;  // a key for whole numbers takes no 2e+04
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

namespace {

/// Reader of a [sweep] table.
class SweepTable {
 public:
  SweepTable(const std::filesystem::path& file, SweepRequest& request) : problems_(file, {}), request_(request) {}

  void read(const TomlValue& value) {
    const TomlTable* table = value.as<TomlTable>();
    if (table == nullptr) return fail(value, "[sweep]", "a table");
    static const std::map<std::string, void (SweepTable::*)(const TomlValue&)> readers{
        {"scenes", &SweepTable::read_scenes}, {"set", &SweepTable::read_set},   {"vary", &SweepTable::read_vary},
        {"zip", &SweepTable::read_zip},       {"film", &SweepTable::read_film}, {"motion", &SweepTable::read_motion},
        {"steps", &SweepTable::read_steps}};
    std::vector<std::string> names;
    for (const auto& [name, reader] : readers) names.push_back(name);
    for (const TomlEntry& entry : in_order(*table)) {
      const auto reader = readers.find(entry.name);
      if (reader == readers.end()) {
        problems_.add(entry.place, fmt::format("unknown key '{}' in [sweep]{}", entry.name,
                                               did_you_mean(entry.name, names, "the keys are")));
      } else {
        (this->*reader->second)(entry.value);
      }
    }
  }

  /// Returns the listed scenes. @throws UsageError
  std::vector<std::string> scenes() const {
    problems_.throw_if_any();
    return scenes_;
  }

 private:
  static std::vector<TomlEntry> in_order(const TomlTable& table) {
    std::vector<TomlEntry> entries = table.entries;
    std::ranges::sort(entries, std::less(), &TomlEntry::place);
    return entries;
  }

  void fail(const TomlValue& value, const std::string& name, const std::string& expected) {
    problems_.add(value.place, fmt::format("{}: expected {}, found {}", name, expected, value.kind()));
  }

  std::vector<std::string> strings(const TomlValue& value, const char* name) {
    std::vector<std::string> texts;
    if (const std::string* text = value.as<std::string>()) return {*text};
    const TomlArray* array = value.as<TomlArray>();
    if (array == nullptr) return fail(value, name, "strings"), texts;
    for (const TomlValue& item : *array) {
      const std::string* text = item.as<std::string>();
      if (text == nullptr) return fail(item, name, "a string"), texts;
      texts.push_back(*text);
    }
    return texts;
  }

  void flag(const TomlValue& value, const char* name, bool& target) {
    if (const bool* given = value.as<bool>()) {
      target = target || *given;
    } else {
      fail(value, name, "true or false");
    }
  }

  void read_scenes(const TomlValue& value) { scenes_ = strings(value, "scenes"); }
  void read_zip(const TomlValue& value) { flag(value, "zip", request_.zipped); }
  void read_motion(const TomlValue& value) { flag(value, "motion", request_.motion); }
  void read_set(const TomlValue& value) {
    const std::vector<std::string> given = strings(value, "set");
    request_.overrides.insert(request_.overrides.begin(), given.begin(), given.end());  // the command line's win
  }
  void read_film(const TomlValue& value) {
    const std::vector<std::string> given = strings(value, "film");
    if (request_.films.empty()) request_.films = given;
  }
  void read_steps(const TomlValue& value) {
    const std::int64_t* given = value.as<std::int64_t>();
    if (given == nullptr) return fail(value, "steps", "a whole number from 0 on");
    if (*given < 0) {
      return problems_.add(value.place, fmt::format("steps: expected a whole number from 0 on, found {}", *given));
    }
    if (!request_.steps) request_.steps = *given;
  }

  void read_vary(const TomlValue& value) {
    if (value.as<TomlTable>() == nullptr) return fail(value, "vary", "a table of keys with their values");
    std::vector<Variation> found;
    collect(value, "", found);
    for (Variation& variation : request_.varied) {
      std::erase_if(found, [&](const Variation& of_file) { return of_file.key == variation.key; });
      found.push_back(std::move(variation));
    }
    request_.varied = std::move(found);
  }

  /// Collects varied keys, written as quoted names ("integrator.tolerance") or as nested tables.
  void collect(const TomlValue& value, const std::string& name, std::vector<Variation>& found) {
    if (const TomlTable* table = value.as<TomlTable>()) {
      for (const TomlEntry& entry : in_order(*table)) {
        collect(entry.value, name.empty() ? entry.name : name + "." + entry.name, found);
      }
    } else if (const TomlArray* array = value.as<TomlArray>(); array != nullptr && !array->empty()) {
      found.push_back({name, {}});
      for (const TomlValue& item : *array) found.back().values.push_back(override_text(item));
    } else if (const std::string* text = value.as<std::string>()) {
      try {
        found.push_back({name, parse_values(*text)});
      } catch (const UsageError& error) {
        problems_.add(value.place, fmt::format("{}: {}", name, error.what()));
      }
    } else {
      const std::string kind = value.as<TomlArray>() != nullptr ? "an empty array" : value.kind();
      problems_.add(value.place,
                    fmt::format("{}: expected an array of values, or a text as --vary takes it, found {}", name, kind));
    }
  }

  /// Formats a value for --set: without quotes if that is unambiguous.
  static std::string override_text(const TomlValue& value) {
    const std::string* text = value.as<std::string>();
    const auto of_a_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
    if (text == nullptr || text->empty() || std::isalpha(static_cast<unsigned char>(text->front())) == 0 ||
        !std::ranges::all_of(*text, of_a_word)) {
      return toml_literal(value);
    }
    return *text == "true" || *text == "false" || *text == "inf" || *text == "nan" ? toml_literal(value) : *text;
  }

  Problems problems_;
  SweepRequest& request_;
  std::vector<std::string> scenes_;
};

}  // namespace

std::vector<std::string> add_sweep_table(const std::string& file, SweepRequest& request) {
  const TomlValue document = read_document(file);
  const TomlValue* value = document.as<TomlTable>()->find("sweep");
  if (value == nullptr) return {file};
  SweepTable table(file, request);
  table.read(*value);
  std::vector<std::string> scenes = table.scenes();
  if (scenes.empty()) return {file};
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  for (std::string& scene : scenes) scene = (folder / scene).string();
  return scenes;
}

std::string command_of(const SweepRequest& request) {
  std::string text = "drape sweep";
  for (const std::string& scene : request.scenes) text += " " + shell_file(scene);
  for (const std::string& value : request.overrides) text += " --set " + shell_word(value);
  for (const Variation& variation : request.varied) {
    std::string values;
    for (const std::string& value : variation.values) values += (values.empty() ? "" : ",") + value;
    text += " --vary " + shell_word(variation.key + "=" + values);
  }
  if (request.zipped) text += " --zip";
  for (const std::string& film : request.films) text += " --film " + shell_word(film);
  if (request.motion) text += " --motion";
  if (request.steps) text += fmt::format(" --steps {}", *request.steps);
  if (request.backend != GlBackend::automatic) text += fmt::format(" --backend {}", backend_name(request.backend));
  return text;
}

RunOptions run_options(const SweepRequest& request, const std::filesystem::path& folder) {
  RunOptions options;
  for (const std::string& film : request.films) options.outputs.push_back((folder / ("film." + film)).string());
  if (!request.films.empty()) {
    options.outputs.push_back((folder / "sheet.png").string());
    options.sheet = sweep_sheet;
  }
  if (request.motion) options.motion = {.path = (folder / "motion.drape").string()};
  options.steps = request.steps;
  options.backend = request.backend;
  options.time_effects = true;
  return options;
}

}  // namespace drape
