#pragma once

#include <functional>
#include <future>
#include <stop_token>

#include "run/progress.hpp"

namespace drape {

/// Work on a thread of its own, whose progress this one shows. The token is that of interruption().
class WatchedWork {
 public:
  /// @param let_others_begin to be called, at most once, when what is left takes one core
  using Work = std::function<void(const std::stop_token&, Progress&, const std::function<void()>& let_others_begin)>;

  /// Begins it.
  explicit WatchedWork(const Work& work);

  /// Shows its progress until others may begin, at the latest at its end.
  /// @param quiet no progress is shown
  void watch_until_others_may_begin(bool quiet) { watch(quiet, others_may_begin_); }

  /// Shows its progress until its end.
  /// @throws what the work throws
  void watch_to_its_end(bool quiet);

 private:
  void watch(bool quiet, const std::future<void>& until);

  Progress progress_;
  std::promise<void> told_;
  std::future<void> others_may_begin_ = told_.get_future();
  std::future<void> done_;  // last: it is waited for before the others go
};

/// Does work on a thread of its own while this one shows its progress. The token is that of interruption().
/// @param quiet no progress is shown
/// @returns whether it was interrupted
/// @throws what the work throws
bool run_watched(bool quiet, const std::function<void(const std::stop_token&, Progress&)>& work);

}  // namespace drape
