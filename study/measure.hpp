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

/// The measurements of a case. The motion is the same in every run; the times differ.
struct Measured {
  StudyCase what;
  double step = 0;                   ///< step length h [s]
  std::vector<int> iterations;       ///< iterations of every watched step
  std::int64_t capped = 0;           ///< number of steps within what.steps that reached the iteration limit
  std::vector<double> height;        ///< height of the centre of mass after every watched step [m]
  double flipped_pairs = 0;          ///< mean over the watched steps, see FlippedPairs
  std::vector<double> microseconds;  ///< mean CPU time per step, for every timed run
  std::vector<double> setup;         ///< CPU time before the first step, with factorisation, for every timed run [µs]
  /// Reason why the run ended before what.steps; empty: complete. Only for cases with `patience`.
  std::string failure;

  /// Returns the mean over what.steps.
  [[nodiscard]] double mean_iterations() const;
  /// Returns the mean over steps first … last−1.
  [[nodiscard]] double mean_iterations(std::size_t first, std::size_t last) const;
  [[nodiscard]] MedianInterval time() const { return median_interval(microseconds); }
};

/// Callback after every step of the untimed run of case `number`.
using CaseWatch = std::function<void(std::size_t number, const Simulation&, const StepReport&)>;

/// A guard that pins the calling thread to its current processor.
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

/// Returns the CPU time of this thread [s]; time of other threads does not count.
double thread_seconds();

/// Runs every case once untimed and then `runs` times timed, on one thread pinned to one processor. Within a run the
/// cases take turns of a few steps, so that a slow phase of the machine affects all of them. A case whose median is
/// known well enough is not run again.
/// @returns nothing if stopped
/// @throws UsageError; DivergedError for a case without `patience`
std::vector<Measured> measure(const std::vector<StudyCase>& cases, RunCount runs, const std::stop_token& stop,
                              Progress& progress, const CaseWatch& watch = {});

/// Describes the method of measure() in a sentence or two.
std::string describe_measuring(RunCount runs);

}  // namespace drape
