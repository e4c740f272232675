#pragma once

#include <atomic>

namespace drape {

/// What a run is for. It may lose one after the other, on any thread, where it cannot be written.
class ReasonsToRun {
 public:
  ReasonsToRun(bool outputs, bool motion, bool records) : outputs_(outputs), motion_(motion), records_(records) {}

  /// @returns whether there is nothing left to run for
  bool lose_outputs() { return lose(outputs_); }
  bool lose_motion() { return lose(motion_); }

  /// Whether everything was lost.
  [[nodiscard]] bool none() const { return none_; }

 private:
  bool lose(std::atomic<bool>& reason) {
    reason = false;
    if (!outputs_ && !motion_ && !records_) none_ = true;
    return none_;
  }

  std::atomic<bool> outputs_, motion_, none_ = false;
  const bool records_;
};

}  // namespace drape
