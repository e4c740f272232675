#pragma once

#include <sched.h>

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"
#include "study/case.hpp"
#include "study/median_interval.hpp"

namespace drape {

/// What a case did. The motion is the same in every run; the times are not.
struct Measured {
  StudyCase what;
  double step = 0;                   ///< h [s]
  std::vector<int> iterations;       ///< of every step that is watched
  std::int64_t capped = 0;           ///< of what.steps, those that ended at the cap
  std::vector<double> height;        ///< of the centre of mass after every step that is watched [m]
  double flipped_pairs = 0;          ///< mean over the steps that are watched, see FlippedPairs
  std::vector<double> microseconds;  ///< mean over the steps, of every timed run, as computing time
  std::vector<double> setup;         ///< likewise, before the first step: analysing and factoring included
  /// Why it has not come to the end of what.steps; empty: it has. Only of a case that may fail.
  std::string failure;

  /// Over what.steps.
  [[nodiscard]] double mean_iterations() const;
  /// Over the steps first … last−1.
  [[nodiscard]] double mean_iterations(std::size_t first, std::size_t last) const;
  [[nodiscard]] MedianInterval time() const { return median_interval(microseconds); }
};

/// Sees the motion of a case by its number, after every step of the run that is not timed.
using CaseWatch = std::function<void(std::size_t number, const Simulation&, const StepReport&)>;

/// Keeps the calling thread on the processor where it is, until the object's end.
class PinnedThread {
 public:
  PinnedThread();
  PinnedThread(const PinnedThread&) = delete;
  PinnedThread& operator=(const PinnedThread&) = delete;
  ~PinnedThread();

 private:
  cpu_set_t before_;
  bool known_ = false;
};

/// Seconds that this thread has computed: the time in which others had the processor does not count.
double thread_seconds();

/// Runs every case as often as asked after a first time that is not timed, on one thread that stays on one processor.
/// The cases take turns within each run, a few steps each, so that whatever slows the machine down slows all of them;
/// one whose median is known well enough takes part no more.
/// @returns nothing if it was stopped
/// @throws UsageError; DivergedError, but for a case that may fail
std::vector<Measured> measure(const std::vector<StudyCase>& cases, RunCount runs, const std::stop_token& stop,
                              Progress& progress, const CaseWatch& watch = {});

/// How measure() measures, in a sentence or two.
std::string describe_measuring(RunCount runs);

}  // namespace drape
