#pragma once

#include <sched.h>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "run/progress.hpp"
#include "sim/kernels/kernels.hpp"
#include "study/runs_file.hpp"

namespace drape {

/// The purpose of a kernel.
enum class KernelPart { local, assembly, global, product, vectors };
inline constexpr std::size_t kernel_part_count = 5;

/// Timer of the kernels during its lifetime, for single-threaded computations. Only one may exist at a time.
class KernelClock {
 public:
  KernelClock();
  KernelClock(const KernelClock&) = delete;
  KernelClock& operator=(const KernelClock&) = delete;
  ~KernelClock();

  /// Sets all times to zero.
  void reset();
  [[nodiscard]] double seconds(KernelPart part) const;

 private:
  Kernels timed_;
  const Kernels& plain_;
};

/// The median of some measurements, with its 95 % confidence interval.
struct MedianInterval {
  double lower = 0, median = 0, upper = 0;  ///< lower and upper are NaN with too few measurements
  std::size_t count = 0;

  [[nodiscard]] bool known() const;
  /// Returns true if both ends are within 5 % of the median.
  [[nodiscard]] bool narrow() const;
  /// Converts to another unit.
  [[nodiscard]] MedianInterval times(double factor) const {
    return {factor * lower, factor * median, factor * upper, count};
  }
};

/// Smallest number of measurements with an interval: the range of five holds the median in only 94 of 100 cases.
inline constexpr std::size_t fewest_for_interval = 6;

/// Returns the rank l of the order statistic that begins the interval; the l-th from above ends it. The interval holds
/// the median with a probability of at least 0.95, for any distribution. Each of n values is below the median with
/// probability ½, so the coverage is 1 − 2·P(B < l) with B binomial. Returns 0 for n below fewest_for_interval.
/// Sources: Hahn and Meeker, "Statistical Intervals", 1991, section 5.2.1; Hoefler and Belli, "Scientific Benchmarking
/// of Parallel Computing Systems", 2015, section 3.1.3.
std::size_t first_order_statistic(std::size_t n);

/// @param values at least one
MedianInterval median_interval(std::vector<double> values);

/// Number of timed runs; absent: until each case's interval is narrow, at most most_runs.
using RunCount = std::optional<int>;
inline constexpr int most_runs = 30;

inline int runs_at_most(RunCount runs) { return runs.value_or(most_runs); }

/// Returns true if the measurements suffice.
bool is_enough(const std::vector<double>& values, RunCount runs);

/// Note for the interval columns of tables.
inline constexpr const char* interval_note =
    "From, to: where the median is with 95 % confidence, by order statistics; – where the runs are too few to say.";

/// Returns " --runs 5" for a command line; empty if the data decide.
std::string runs_option(RunCount runs);

/// Returns "the median of 5 runs", and the meaning of its interval.
std::string describe_runs(RunCount runs);

/// The measurements of a case. The motion is the same in every run; the times differ.
struct Measured {
  StudyCase study_case;
  double step = 0;                   ///< step length h [s]
  std::vector<int> iterations;       ///< iterations of every watched step
  std::int64_t capped = 0;           ///< number of steps within study_case.steps that reached the iteration limit
  std::vector<double> height;        ///< height of the centre of mass after every watched step [m]
  double flipped_pairs = 0;          ///< mean over the watched steps, see FlippedPairs
  std::vector<double> microseconds;  ///< mean CPU time per step, for every timed run
  std::vector<double> setup;         ///< CPU time before the first step, with factorisation, for every timed run [µs]
  /// Reason why the run ended before study_case.steps; empty: complete. Only for cases with `patience`.
  std::string failure;

  /// Returns the mean over study_case.steps.
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
