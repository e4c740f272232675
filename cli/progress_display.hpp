#pragma once

#include <chrono>

#include "run/progress.hpp"

namespace drape {

/// Shows on standard error how far a run is: a bar on a terminal, elsewhere a plain line now and
/// then, which comes less often the longer a run takes.
class ProgressDisplay {
 public:
  enum class Style { none, bar, lines };

  /// The style that fits standard error.
  static Style fitting_style(bool quiet);

  ProgressDisplay(const Progress& progress, Style style) : progress_(progress), style_(style) {}
  ~ProgressDisplay() { clear(); }

  /// Shows the progress as it is now; to be called often.
  void update();
  /// Removes the bar, so that other text can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  const Progress& progress_;
  Style style_;
  const char* stage_ = nullptr;
  Clock::time_point begin_ = Clock::now(), stage_begin_, last_line_ = begin_;
};

}  // namespace drape
