#include "cli/background_work.hpp"

#include <chrono>
#include <future>
#include <utility>

#include "cli/interruption.hpp"
#include "cli/progress_display.hpp"

namespace drape {
namespace {

constexpr std::chrono::milliseconds display_interval{100};

}  // namespace

BackgroundWork::BackgroundWork(const Work& work) {
  done_ = std::async(std::launch::async, [this, work] {
    bool told = false;
    const auto tell = [&] {
      if (!std::exchange(told, true)) told_.set_value();
    };
    try {
      work(interruption().get_token(), progress_, tell);
    } catch (...) {
      tell();
      throw;
    }
    tell();
  });
}

void BackgroundWork::watch_to_its_end(bool quiet) {
  watch(quiet, done_);
  done_.get();
}

void BackgroundWork::watch(bool quiet, const std::future<void>& until) {
  ProgressDisplay display(progress_, ProgressDisplay::fitting_style(quiet));
  while (until.wait_for(display_interval) != std::future_status::ready) display.update();
  display.clear();
}

bool run_watched(bool quiet, const std::function<void(const std::stop_token&, Progress&)>& work) {
  BackgroundWork([&work](const std::stop_token& stop, Progress& progress, const auto&) {
    work(stop, progress);
  }).watch_to_its_end(quiet);
  return interruption().get_token().stop_requested();
}

}  // namespace drape
