#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <future>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/text.hpp"
#include "run/progress.hpp"

namespace drape {

/// Use of colours. Automatic: on a terminal, unless NO_COLOR is set or TERM is "dumb".
enum class ColorMode { automatic, always, never };

/// Properties of a text destination.
struct Terminal {
  /// Line width. On a terminal: the smaller of the window's width (80 if unknown) and COLUMNS; for a file or a pipe:
  /// COLUMNS, if exported.
  std::size_t width = unlimited_width;
  bool color = false;
};

/// Returns the properties of standard output or standard error.
Terminal terminal(std::FILE* stream, ColorMode mode);

enum class Ink { red, yellow, green, bold };

/// Returns the text in a colour, if the terminal has colours.
std::string inked(std::string_view text, Ink ink, const Terminal& where);

/// Prints lines, wrapped at spaces to the stream's width. Continuation lines are indented.
void print_wrapped(std::FILE* stream, std::string_view lines);

/// Shows a temporary line; the next one replaces it, and logging or clearing erases it.
void show_transient_line(std::string_view line);
void clear_passing_line();

/// Sends log messages to standard error as "drape: message", wrapped and with a prefix for the severity.
void log_to_terminal(ColorMode mode);

/// Progress display of a run on standard error: a bar on a terminal, elsewhere plain lines at growing intervals.
class ProgressDisplay {
 public:
  enum class Style { none, bar, lines };

  /// Returns the style that fits standard error.
  static Style fitting_style(bool quiet);

  ProgressDisplay(const Progress& progress, Style style) : progress_(progress), style_(style) {}
  ~ProgressDisplay() { clear(); }

  /// Shows the current progress; call it often.
  void update();
  /// Removes the bar before other text is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  const Progress& progress_;
  Style style_;
  const char* stage_ = nullptr;
  std::int64_t done_before_ = 0;  // done when the stage was first seen
  Clock::time_point begin_ = Clock::now(), stage_begin_, last_line_ = begin_;
};

/// Returns the stop source of the process, for current and later work. Ctrl-C, SIGTERM, a closed terminal, or q between
/// two steps request a stop. A dedicated thread forwards signals at once, because a handler may only wake it. A second
/// signal ends the process. The first call installs the handlers.
std::stop_source& interruption();

/// Work on its own thread, with the stop token of interruption(). The calling thread shows its progress.
class BackgroundWork {
 public:
  using Work = std::function<void(const std::stop_token&, Progress&)>;

  /// Starts the work.
  explicit BackgroundWork(const Work& work);

  /// Shows progress until the end.
  /// @param quiet show no progress
  /// @throws errors of the work
  void watch_to_its_end(bool quiet);

 private:
  Progress progress_;
  std::future<void> done_;  // last member: its destructor waits, and the others are still needed
};

/// Runs work on its own thread, with the stop token of interruption(), and shows its progress.
/// @param quiet show no progress
/// @returns true if interrupted
/// @throws errors of the work
bool run_watched(bool quiet, const BackgroundWork::Work& work);

}  // namespace drape
