#include "cli/watched.hpp"

#include <chrono>
#include <future>

#include "cli/interruption.hpp"
#include "cli/progress_display.hpp"

namespace drape {
namespace {

constexpr std::chrono::milliseconds watch_interval{100};

}  // namespace

bool run_watched(const CommonOptions& common, const std::function<void(const std::stop_token&, Progress&)>& work) {
  const std::atomic<bool>& interrupted = interruption();
  Progress progress;
  ProgressDisplay display(progress, ProgressDisplay::fitting_style(common.quiet));
  std::stop_source stop;
  std::future<void> done = std::async(std::launch::async, [&] { work(stop.get_token(), progress); });
  while (done.wait_for(watch_interval) != std::future_status::ready) {
    if (interrupted) stop.request_stop();
    display.update();
  }
  display.clear();
  done.get();
  return stop.stop_requested();
}

}  // namespace drape
