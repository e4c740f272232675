#include "cli/progress_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cli/terminal.hpp"
#include "core/console.hpp"

namespace drape {
namespace {

constexpr int bar_width = 24;
constexpr std::chrono::seconds line_interval{5};  // initial interval
constexpr int lines_in_all = 10;                  // later: elapsed time divided by this number

std::string minutes(double seconds) {
  const auto whole = std::lround(std::min(seconds, 359999.0));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressDisplay::Style ProgressDisplay::fitting_style(bool quiet) {
  if (quiet) return Style::none;
  return isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines;
}

void ProgressDisplay::update() {
  const std::int64_t total = progress_.total, done = std::min<std::int64_t>(progress_.done, total);
  const char* stage = progress_.stage;
  if (style_ == Style::none || total <= 0) return;
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_begin_ = now;
  }
  const auto interval = std::max<Clock::duration>(line_interval, (now - begin_) / lines_in_all);
  if (style_ == Style::lines && now - last_line_ < interval) return;

  const double seconds = std::chrono::duration<double>(now - stage_begin_).count();
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  std::string text = fmt::format("{} {}/{} {}", stage, done, total, progress_.unit.load());
  if (rate > 0) {
    text +=
        fmt::format("  {:.{}f}/s  {} left", rate, rate < 10 ? 1 : 0, minutes(static_cast<double>(total - done) / rate));
  }
  if (style_ == Style::lines) {
    last_line_ = now;
    print_unescaped(stderr, text + "\n");
    return;
  }
  const std::size_t width = terminal(stderr, ColorMode::never).width;
  const auto filled = static_cast<std::size_t>(bar_width * done / total);
  std::string line = fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(bar_width - filled, ' '), text);
  if (line.size() >= width) line.resize(width - 1);  // a wrapped line could not be erased
  show_transient_line(line);
}

void ProgressDisplay::clear() {
  if (style_ == Style::bar) clear_passing_line();
}

}  // namespace drape
