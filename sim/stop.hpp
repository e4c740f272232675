#pragma once

// Example:
//   int patience = 1000;
//   const drape::Stop stop([&patience] { return --patience == 0; });
//   try {
//     for (;;) stop.look();
//   } catch (const drape::Interrupted&) {
//   }

#include <exception>
#include <functional>
#include <memory>
#include <utility>

namespace drape {

/// Thrown by a computation that was told to stop. Not an error: there is nothing to report.
struct Interrupted final : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

/// A stop request that a computation checks between pieces of work of a few milliseconds. Library calls, such as a
/// sparse factorisation, run to their end between two checks.
class Stop {
 public:
  /// Creates an object that never stops.
  Stop() = default;
  /// @param asked returns true to stop; called on the computing thread, so it should be fast
  explicit Stop(std::function<bool()> asked)
      : asked_(std::make_shared<const std::function<bool()>>(std::move(asked))) {}

  /// Returns false if it can never stop.
  [[nodiscard]] bool possible() const { return asked_ != nullptr; }

  /// @throws Interrupted if a stop is requested
  void look() const {
    if (asked_ && (*asked_)()) throw Interrupted();
  }

 private:
  std::shared_ptr<const std::function<bool()>> asked_;
};

}  // namespace drape
