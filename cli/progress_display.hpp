#pragma once

#include <chrono>

#include "run/progress.hpp"

namespace drape {

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
  Clock::time_point begin_ = Clock::now(), stage_begin_, last_line_ = begin_;
};

}  // namespace drape
