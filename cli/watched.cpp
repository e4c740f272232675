#include "cli/watched.hpp"

#include <chrono>
#include <future>

#include "cli/interruption.hpp"
#include "cli/progress_display.hpp"

namespace drape {
namespace {

constexpr std::chrono::milliseconds watch_interval{100};

}  // namespace

bool run_watched(bool quiet, const std::function<void(const std::stop_token&, Progress&)>& work) {
  const std::stop_token stop = interruption().get_token();
  Progress progress;
  ProgressDisplay display(progress, ProgressDisplay::fitting_style(quiet));
  std::future<void> done = std::async(std::launch::async, [&] { work(stop, progress); });
  while (done.wait_for(watch_interval) != std::future_status::ready) {
    static_cast<void>(interrupted());
    display.update();
  }
  display.clear();
  done.get();
  return stop.stop_requested();
}

}  // namespace drape
