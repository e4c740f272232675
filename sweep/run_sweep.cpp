#include "sweep/run_sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <mutex>
#include <new>
#include <set>
#include <system_error>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "output/png_encoder.hpp"
#include "run/run_scene.hpp"
#include "sweep/page.hpp"

namespace drape {
namespace {

std::string timed_text(const SweepOptions& options) {
  if (options.jobs > 1) return fmt::format("beside {} others", options.jobs - 1);
  return options.shard.whole() ? "alone" : "in a shard";
}

/// Returns the file names of a run's outputs, in its folder.
std::vector<std::string> file_names(const RunResult& result) {
  std::vector<std::string> names;
  const auto add = [&](const std::filesystem::path& file) { names.push_back(file.filename().string()); };
  for (const std::vector<OutputFile>& files : result.outputs) {
    for (const OutputFile& file : files) add(file.path);
  }
  if (result.motion && result.motion->complete) add(result.motion->complete->path);
  return names;
}

/// Returns the times of the pictures in a film's contact sheet [s].
std::vector<double> moments_of(const Scene& scene, const RunResult& result) {
  std::vector<double> moments;
  for (int frame = 0; frame < result.frames; ++frame) {
    if (!is_spread(frame, result.frames_wanted, sweep_sheet.columns * sweep_sheet.rows)) continue;
    moments.push_back(frame * scene.video.speed / scene.video.fps);
  }
  return moments;
}

RunRecord record_of(const Scene& scene, const RunResult& result) {
  RunRecord record;
  record.moments = moments_of(scene, result);
  record.seconds = result.elapsed_seconds;
  record.files = file_names(result);
  if (!result.problems.empty()) {
    record.outcome = RunOutcome::failed;
    record.reason = fmt::format("{}", fmt::join(result.problems, "; "));
  } else if (result.outcome == Outcome::diverged) {
    record.outcome = RunOutcome::diverged;
    record.reason = result.divergence;
  } else {
    record.outcome = RunOutcome::completed;
  }
  return record;
}

RunRecord record_of(const Error& error) {
  RunRecord record;
  record.outcome = error.kind() == ErrorKind::usage      ? RunOutcome::refused
                   : error.kind() == ErrorKind::diverged ? RunOutcome::diverged
                                                         : RunOutcome::failed;
  record.reason = error.what();
  return record;
}

class Sweep {
 public:
  Sweep(const SweepPlan& plan, const SweepOptions& options, const std::stop_token& stop, Progress& progress)
      : plan_(plan), options_(options), stop_(stop), progress_(progress) {}

  std::map<std::size_t, RunRecord> run() {
    std::vector<std::size_t> todo = runs_to_do();
    // Start with the longest, so that all threads end at about the same time.
    if (options_.jobs > 1) {
      std::ranges::stable_sort(todo, std::greater(), [&](std::size_t i) { return plan_.runs[i].cost; });
    }
    progress_.begin("running", "runs", static_cast<std::int64_t>(todo.size()));
    for_each_in_parallel(options_.jobs, todo.size(), stop_, [&](std::size_t, std::size_t i) {
      run_one(todo[i]);
      ++progress_.done;
    });
    return std::move(unwritten_);
  }

 private:
  /// Returns the runs to do; those with equal keys count as one.
  [[nodiscard]] std::vector<std::size_t> runs_to_do() const {
    std::vector<std::size_t> todo;
    std::set<std::string> keys;
    for (const std::size_t i : runs_of_shard(plan_, options_.shard)) {
      const PlannedRun& run = plan_.runs[i];
      if (!run.refusal.empty() || !keys.insert(run.key).second) continue;
      if (options_.resume) {
        const std::optional<RunRecord> before = read_run(options_.folder, run.key);
        if (before && before->settled()) continue;
      }
      todo.push_back(i);
    }
    return todo;
  }

  void run_one(std::size_t place) {
    const PlannedRun& run = plan_.runs[place];
    try {
      RunFolder folder(options_.folder, run.key);
      std::string stats;
      std::optional<RunRecord> record = compute(run, folder.place(), stats);
      if (!record) return;
      record->timed = timed_text(options_);
      if (!record->settled()) folder.clear();
      if (!record->settled()) record->files.clear();
      folder.commit(*record, stats);
    } catch (const OutputError& error) {
      const std::scoped_lock lock(mutex_);
      unwritten_[place] = record_of(error);
    }
  }

  /// Returns the common viewing direction; the first thread computes it while others wait.
  const Camera& side() {
    std::call_once(side_is_found_, [&] { side_ = side_of_films(plan_, stop_); });
    return side_;
  }

  /// @returns nothing if stopped; then nothing is written
  [[nodiscard]] std::optional<RunRecord> compute(const PlannedRun& run, const std::filesystem::path& folder,
                                                 std::string& stats) {
    try {
      LoadedScene scene = load_scene(plan_.request.scenes[run.scene], overrides_of(plan_, run));
      if (run_key(scene, plan_) != run.key) {
        throw UsageError(fmt::format("{}: it, or a file that it names, has changed since the sweep began",
                                     shown(scene.source.file)));
      }
      if (chooses_side(plan_.request, scene.camera)) look_from(side(), scene.camera);
      Progress unseen;
      RunOptions options = run_options(plan_.request, folder);
      options.threads = options_.threads;
      const RunResult result = run_scene(scene, options, stop_, unseen);
      if (result.outcome == Outcome::interrupted) return std::nullopt;
      if (result.statistics.steps() > 0) stats = result.statistics.to_json(outcome_name(result.outcome));
      return record_of(scene, result);
    } catch (const Error& error) {
      return record_of(error);
    } catch (const std::bad_alloc&) {
      return record_of(UsageError("there is not enough memory for this"));
    } catch (const std::system_error& error) {
      return record_of(UsageError("the system does not give what this needs: " + error.code().message()));
    }
  }

  const SweepPlan& plan_;
  const SweepOptions& options_;
  const std::stop_token& stop_;
  Progress& progress_;
  std::once_flag side_is_found_;
  Camera side_;
  std::mutex mutex_;
  std::map<std::size_t, RunRecord> unwritten_;
};

}  // namespace

SweepLock::SweepLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".lock";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    if (!error) error.assign(errno, std::generic_category());
    throw OutputError(fmt::format("cannot write {}: {}", shown(file), error.message()));
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw UsageError(fmt::format("{}: another drape is running a sweep in this folder", shown(folder)));
  }
}

SweepLock::~SweepLock() { ::close(descriptor_); }

std::map<std::size_t, RunRecord> run_sweep(const SweepPlan& plan, const SweepOptions& options,
                                           const std::stop_token& stop, Progress& progress) {
  remove_unfinished(options.folder);
  return Sweep(plan, options, stop, progress).run();
}

}  // namespace drape
