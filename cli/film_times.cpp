#include "cli/film_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "run/outputs.hpp"

namespace drape {
namespace {

constexpr double rounding = 1e-9;  // tolerance for decimal fractions, in frames or steps

}  // namespace

double parse_time(const std::string& option, const std::string& text) {
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, seconds);
  const std::string_view unit(rest, end);
  const bool known = unit == "s" || unit == "ms";
  if (error != std::errc() || !known || !std::isfinite(seconds) || seconds < 0) {
    throw UsageError(fmt::format("{} takes a time such as 2.5s or 250ms; found '{}'", option, text));
  }
  return unit == "ms" ? 1e-3 * seconds : seconds;
}

std::int64_t steps_in(const std::string& option, const std::string& text, double h) {
  const double steps = parse_time(option, text) / h, whole = std::round(steps);
  constexpr double most = 1e9;
  if (whole >= 1 && whole <= most && std::abs(steps - whole) <= rounding * whole) {
    return static_cast<std::int64_t>(whole);
  }
  const double below = std::clamp(std::floor(steps), 1.0, most);
  throw UsageError(fmt::format("{} {}: a step is {:g} s long; expected a whole number of them, such as {:g}s or {:g}s",
                               option, text, h, below * h, (below + 1) * h));
}

FrameRange frames_at(const FilmTimes& times, const FilmExtent& whole, const std::string& film) {
  const double end = whole.time(whole.frames.last);
  const auto frame_at = [&](const std::string& option, const std::string& text) {
    const double frame = parse_time(option, text) / whole.seconds_per_frame;
    if (frame <= whole.frames.last + 0.5) return frame;
    throw UsageError(fmt::format("{} {}: the film of {} ends at {:g} s", option, text, film, end));
  };
  FrameRange range = whole.frames;
  if (!times.at.empty()) {
    range.first = range.last = std::min(static_cast<int>(std::lround(frame_at("--at", times.at))), whole.frames.last);
  }
  if (!times.from.empty()) range.first = static_cast<int>(std::ceil(frame_at("--from", times.from) - rounding));
  if (!times.to.empty()) {
    range.last = std::min(static_cast<int>(std::floor(frame_at("--to", times.to) + rounding)), whole.frames.last);
  }
  if (range.first > range.last) {
    throw UsageError(fmt::format("there is no frame between {} and {}: frames are {:g} s apart",
                                 times.from.empty() ? "the start" : "--from " + times.from,
                                 times.to.empty() ? "the end" : "--to " + times.to, whole.seconds_per_frame));
  }
  return range;
}

void choose_frames(const FilmTimes& times, const Scene& scene, RunOptions& options) {
  if (times.any()) options.frames = frames_at(times, whole_extent(scene, options), shown(scene.file));
}

void add_film_times(CLI::App& command, FilmTimes& times, CLI::Option* frames) {
  command.add_option("--at", times.at, "Only the frame nearest to this time of the scene: 2.5s")->excludes(frames);
  CLI::Option* const at = command.get_option("--at");
  command.add_option("--from", times.from, "Only frames from this time on: 1s")->excludes(frames)->excludes(at);
  command.add_option("--to", times.to, "Only frames up to this time: 2.5s")->excludes(frames)->excludes(at);
}

}  // namespace drape
