#pragma once

#include <functional>
#include <future>
#include <stop_token>

#include "run/progress.hpp"

namespace drape {

/// Work on its own thread; the calling thread shows its progress. The token is that of interruption().
class BackgroundWork {
 public:
  /// @param let_others_begin called at most once, when the rest needs only one core
  using Work = std::function<void(const std::stop_token&, Progress&, const std::function<void()>& let_others_begin)>;

  /// Starts the work.
  explicit BackgroundWork(const Work& work);

  /// Shows progress until others may begin, at the latest until the end.
  /// @param quiet show no progress
  void wait_until_single_core(bool quiet) { watch(quiet, others_may_begin_); }

  /// Shows progress until the end.
  /// @throws errors of the work
  void watch_to_its_end(bool quiet);

 private:
  void watch(bool quiet, const std::future<void>& until);

  Progress progress_;
  std::promise<void> told_;
  std::future<void> others_may_begin_ = told_.get_future();
  std::future<void> done_;  // last member: its destructor waits, and the others are still needed
};

/// Runs work on its own thread and shows its progress. The token is that of interruption().
/// @param quiet show no progress
/// @returns true if interrupted
/// @throws errors of the work
bool run_watched(bool quiet, const std::function<void(const std::stop_token&, Progress&)>& work);

}  // namespace drape
