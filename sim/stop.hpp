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

/// Thrown by a computation that was told to end before it was done. No error: there is nothing to report.
struct Interrupted final : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

/// A question that a computation asks between pieces of work of a few milliseconds: whether to end. What is in the
/// hands of a library, such as a sparse factorisation, asks before and after.
class Stop {
 public:
  /// The answer is always no.
  Stop() = default;
  /// @param asked on the thread that computes; should take no time
  explicit Stop(std::function<bool()> asked)
      : asked_(std::make_shared<const std::function<bool()>>(std::move(asked))) {}

  /// Whether anybody is asked at all.
  [[nodiscard]] bool possible() const { return asked_ != nullptr; }

  /// @throws Interrupted if the answer is yes
  void look() const {
    if (asked_ && (*asked_)()) throw Interrupted();
  }

 private:
  std::shared_ptr<const std::function<bool()>> asked_;
};

}  // namespace drape
