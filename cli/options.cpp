#include "cli/options.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/registry.hpp"
#include "output/sink.hpp"

namespace drape {

std::uint64_t parse_byte_count(const std::string& option, const std::string& text) {
  static const std::map<std::string, double> units{{"", 1},         {"B", 1},       {"kB", 1e3},     {"KB", 1e3},
                                                   {"MB", 1e6},     {"GB", 1e9},    {"kiB", 0x1p10}, {"KiB", 0x1p10},
                                                   {"MiB", 0x1p20}, {"GiB", 0x1p30}};
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const std::string written(rest, end);
  const auto unit = units.find(written.substr(std::min(written.find_first_not_of(' '), written.size())));
  constexpr double largest = 1e18;
  if (error == std::errc() && unit != units.end()) {
    const double bytes = std::floor(number * unit->second);
    if (bytes >= 1 && bytes <= largest) return static_cast<std::uint64_t>(bytes);
  }
  throw UsageError(fmt::format("{} takes a size such as 5MB, 800kB or 1.5GiB; found '{}'", option, text));
}

std::vector<int> parse_frame_list(const std::string& text) {
  std::vector<int> frames;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    int frame = -1;
    const auto [next, error] = std::from_chars(at, end, frame);
    const bool separated = next == end || (*next == ',' && next + 1 != end);
    if (error != std::errc() || frame < 0 || !separated) {
      throw UsageError(fmt::format("--frames takes frame numbers A,B,C, counted from 0; found '{}'", text));
    }
    frames.push_back(frame);
    at = next == end ? end : next + 1;
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

FrameRange parse_frames(const std::string& text) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool two = first.ec == std::errc() && std::string_view(first.ptr, end).starts_with("..");
  const auto last = two ? std::from_chars(first.ptr + 2, end, range.last) : first;
  if (!two || last.ec != std::errc() || last.ptr != end || range.first < 0 || range.last < range.first) {
    throw UsageError(fmt::format("--frames takes A..B, two frame numbers with 0 ≤ A ≤ B; found '{}'", text));
  }
  return range;
}

SheetGrid parse_grid(const std::string& option, const std::string& text) {
  constexpr int most = 100;
  SheetGrid grid;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, grid.columns);
  const bool two = columns.ec == std::errc() && std::string_view(columns.ptr, end).starts_with('x');
  const auto rows = two ? std::from_chars(columns.ptr + 1, end, grid.rows) : columns;
  const auto within = [](int count) { return count >= 1 && count <= most; };
  if (!two || rows.ec != std::errc() || rows.ptr != end || !within(grid.columns) || !within(grid.rows)) {
    throw UsageError(
        fmt::format("{} takes COLUMNSxROWS, each from 1 to {}, as in 4x3; found '{}'", option, most, text));
  }
  return grid;
}

std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs) {
  if (text.empty()) return std::nullopt;
  const SheetGrid grid = parse_grid("--sheet", text);
  const auto becomes_sheet = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && format->file_per_frame() && !PathTemplate(path).has_frame();
  };
  if (std::ranges::none_of(outputs, becomes_sheet)) {
    throw UsageError(fmt::format("--sheet {} needs an output for it: -o NAME.png", text));
  }
  return grid;
}

CLI::Validator on_one_line() {
  const auto problem = [](const std::string& text) -> std::string {
    const bool plain = std::ranges::none_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
    return plain ? "" : fmt::format("expected a text without control characters, found '{}'", shown(text));
  };
  return CLI::Validator(problem, "");
}

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

void add_quality_option(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option_function<std::string>(
          "--quality",
          [&overrides](const std::string& given) {
            const std::vector<std::string> names{"draft", "film", "print"};
            if (std::ranges::find(names, given) == names.end()) {
              throw CLI::ValidationError(
                  "--quality", "unknown quality '" + given + "'" + did_you_mean(given, names, "the choices are"));
            }
            overrides.push_back("look.quality=" + given);
          },
          "Size, samples and solver's tolerance in one word, relative to the scene's own")
      ->type_name("draft|film|print");
}

void add_style_option(CLI::App& subcommand, FigureStyle& style) {
  subcommand
      .add_option_function<std::string>(
          "--style",
          [&style](const std::string& given) {
            const std::vector<std::string> names(figure_style_names.begin(), figure_style_names.end());
            const auto found = std::ranges::find(names, given);
            if (found == names.end()) {
              throw CLI::ValidationError(
                  "--style", "unknown style '" + given + "'" + did_you_mean(given, names, "the styles are"));
            }
            style = static_cast<FigureStyle>(found - names.begin());
          },
          "Style of the diagrams' files; default screen. paper: for a column of an article, 3.3 in wide, without a "
          "title, in a serif font of 8 pt, as SVG, PDF and pgfplots; paper-wide: 7 in")
      ->type_name("screen|paper|paper-wide");
}

}  // namespace drape
