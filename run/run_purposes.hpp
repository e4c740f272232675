#pragma once

#include <atomic>

namespace drape {

/// The purposes of a run: outputs, motion file, records. Any thread may drop one that cannot be written.
class RunPurposes {
 public:
  RunPurposes(bool outputs, bool motion, bool records) : outputs_(outputs), motion_(motion), records_(records) {}

  /// @returns true if no purpose is left
  bool lose_outputs() { return lose(outputs_); }
  bool lose_motion() { return lose(motion_); }

  /// Returns true if no purpose is left.
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
