#include "watch/session.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/temporary_folder.hpp"

namespace drape {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto look_again = std::chrono::milliseconds(100);
constexpr std::size_t most_film_bytes = std::size_t{1} << 30;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

WatchSession::WatchSession(std::filesystem::path file, std::vector<std::string> overrides, GlBackend backend,
                           Describe describe)
    : file_(std::move(file)),
      overrides_(std::move(overrides)),
      backend_(backend),
      describe_(std::move(describe)),
      inputs_{file_} {}

WatchedFilm WatchSession::film() const {
  const std::lock_guard lock(mutex_);
  return film_;
}

void WatchSession::publish(const std::function<void(WatchedFilm&)>& change) {
  const std::lock_guard lock(mutex_);
  change(film_);
  ++film_.version;
}

void WatchSession::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    stamps_ = FileStamps(inputs_);
    publish([](WatchedFilm& film) { film.running = true; });
    try {
      draw(stop);
      publish([](WatchedFilm& film) { film.running = false; });
    } catch (const Error& error) {
      publish([&](WatchedFilm& film) {
        film.running = false;
        film.errors = lines_of(error.what());
      });
    }
    while (!stop.stop_requested() && !changed()) std::this_thread::sleep_for(look_again);
  }
}

void WatchSession::draw(const std::stop_token& stop) {
  const auto begin = Clock::now();
  const Scene scene = load_scene(file_, overrides_);
  const double load = seconds_since(begin);
  inputs_ = scene.inputs;
  stamps_.follow(inputs_);

  const TemporaryFolder folder("drape-watch");
  const std::string path = (folder.path() / "film.gif").string();
  RunOptions options;
  options.outputs = {path};
  options.backend = backend_;
  options.threads = 0;
  std::stop_source changed_or_stopped;
  auto work = std::async(std::launch::async,
                         [&] { return run_scene(scene, options, changed_or_stopped.get_token(), progress_); });
  while (work.wait_for(look_again) != std::future_status::ready) {
    if (stop.stop_requested() || changed()) changed_or_stopped.request_stop();
  }
  const RunResult result = work.get();
  if (result.outcome == Outcome::interrupted) return;
  const std::string shown = result.outputs.empty() ? path : result.outputs.front().front().path.string();
  std::string bytes = result.outputs.empty() ? "" : read_file(shown, most_film_bytes);
  publish([&](WatchedFilm& film) {
    film.errors = result.problems;
    if (!result.divergence.empty()) film.errors.push_back(file_.string() + ": " + result.divergence);
    film.hints = scene.warnings;
    film.summary = describe_(scene, options);
    if (!bytes.empty()) {
      film.film = std::move(bytes);
      ++film.film_number;
    }
    film.load = load;
    film.simulate = result.statistics.total_seconds();
    film.draw = result.draw_seconds;
    film.encode = result.write_seconds;
    film.total = seconds_since(begin);
  });
}

}  // namespace drape
