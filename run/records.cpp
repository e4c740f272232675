#include "run/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <limits>
#include <utility>

#include "drape/core/error.hpp"
#include "sim/system.hpp"

namespace drape {

/// A file that stores its first error instead of throwing it.
class Records::Record {
 public:
  explicit Record(const std::string& path) : file_(path) {}

  void write(const std::string& text) {
    try {
      if (problem_.empty()) file_.write(text);
    } catch (const OutputError& error) {
      problem_ = error.what();
    }
  }

  void finish(Ending ending, std::vector<std::string>& names, std::vector<std::string>& problems) {
    try {
      if (problem_.empty()) file_.commit(ending);
    } catch (const OutputError& error) {
      problem_ = error.what();
    }
    if (problem_.empty()) {
      names.push_back(file_.name(ending).string());
    } else {
      problems.push_back(problem_);
    }
  }

 private:
  PartialFile file_;
  std::string problem_;
};

class Records::EnergyLog final : public StepObserver {
 public:
  explicit EnergyLog(const std::string& path) : file(path) {}

  void begin(const Simulation& simulation) override {
    std::string header = "step,time,total,kinetic,gravity,elastic";
    const std::vector<ClothPiece>& pieces = simulation.cloth().pieces;
    columns_ = pieces.size() > 1 ? pieces.size() : 0;
    for (std::size_t k = 0; k < columns_; ++k) {
      header += fmt::format(",{0}.kinetic,{0}.gravity,{0}.elastic", pieces[k].name);
    }
    file.write(header + "\n");
    if (simulation.state().step == 0) add(simulation);
  }
  void replay(const StepRow& row, double time, double /*seconds*/) override {
    add(row.step, time, row.energies, row.cloths);
  }
  void after_step(const Simulation& simulation, const StepReport&, double) override { add(simulation); }

  Record file;

 private:
  void add(const Simulation& simulation) {
    add(simulation.state().step, simulation.time(), simulation.energies(),
        columns_ > 0 ? simulation.piece_energies() : std::vector<Energies>());
  }
  /// @param pieces energies of several cloths; empty: unknown
  void add(std::int64_t step, double time, const Energies& e, const std::vector<Energies>& pieces) {
    std::string row = fmt::format("{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}", step, time, e.total(), e.kinetic,
                                  e.gravity, e.elastic);
    for (const Energies& one : pieces)
      row += fmt::format(",{:.12g},{:.12g},{:.12g}", one.kinetic, one.gravity, one.elastic);
    if (pieces.empty()) row += std::string(3 * columns_, ',');
    file.write(row + "\n");
  }

  std::size_t columns_ = 0;  // number of cloths with columns of their own
};

class Records::TraceLog final : public StepObserver {
 public:
  explicit TraceLog(const std::string& path) : file(path) {}

  void begin(const Simulation& simulation) override {
    file.write("step,time,iterations,residual,step_us");
    file.write(simulation.settings().accuracy ? ",substeps,estimate\n" : "\n");
  }

  void replay(const StepRow& row, double time, double seconds) override {
    if (row.step > 0) add(row.step, time, row.iterations, row.residual, seconds, row.substeps, row.estimate);
  }
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override {
    add(simulation.state().step, simulation.time(), report.iterations, simulation.residual(), seconds, report.substeps,
        report.estimate);
  }

  Record file;

 private:
  void add(std::int64_t step, double time, int iterations, double residual, double seconds, std::int64_t substeps,
           const std::optional<double>& estimate) {
    const std::string microseconds = std::isnan(seconds) ? "" : fmt::format("{:.3f}", 1e6 * seconds);
    file.write(fmt::format("{},{:.12g},{},{:.6g},{}", step, time, iterations, residual, microseconds));
    file.write(estimate ? fmt::format(",{},{:.6g}\n", substeps, *estimate) : "\n");
  }
};

namespace {

std::string positions_csv(const Vertices& x) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "vertex,x,y,z\n");
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{:.17g},{:.17g},{:.17g}\n", i, x(i, 0), x(i, 1), x(i, 2));
  }
  return fmt::to_string(text);
}

}  // namespace

Records::Records(const RecordPaths& paths) {
  if (!paths.stats.empty()) stats_ = std::make_unique<Record>(paths.stats);
  if (!paths.positions.empty()) positions_ = std::make_unique<Record>(paths.positions);
  if (!paths.energies.empty()) energies_ = std::make_unique<EnergyLog>(paths.energies);
  if (!paths.trace.empty()) trace_ = std::make_unique<TraceLog>(paths.trace);
}

Records::~Records() = default;

std::vector<StepObserver*> Records::observers() const {
  std::vector<StepObserver*> result;
  if (energies_) result.push_back(energies_.get());
  if (trace_) result.push_back(trace_.get());
  return result;
}

bool Records::wanted() const { return stats_ || positions_ || energies_ || trace_; }

std::vector<std::string> Records::finish(const Simulation& simulation, const Statistics& statistics,
                                         const std::string& outcome, Ending ending,
                                         std::vector<std::string>& problems) {
  std::vector<std::string> names;
  if (energies_) energies_->file.finish(ending, names, problems);
  if (trace_) trace_->file.finish(ending, names, problems);
  if (positions_) {
    positions_->write(positions_csv(simulation.state().x));
    positions_->finish(ending, names, problems);
  }
  if (stats_) {
    stats_->write(statistics.to_json(outcome));
    stats_->finish(ending, names, problems);
  }
  return names;
}

namespace {

/// Restores the last state. Repeats its step first, for the step's estimates, if the state before it is stored.
/// @returns true if the step was repeated
bool restore_last(MotionReader& motion, Simulation& simulation) {
  const std::size_t last = motion.states() - 1;
  const bool repeats = !motion.header().imported && last > 0 && motion.step(last) - motion.step(last - 1) == 1;
  if (repeats) {
    simulation.restore(motion.state(last - 1));
    simulation.step();
  }
  simulation.restore(motion.state(last));
  return repeats;
}

}  // namespace

std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Records records(paths);
  Statistics statistics;
  Simulation simulation(scene.simulation);
  const bool repeated = restore_last(motion, simulation);
  std::vector<StepObserver*> observers = records.observers();
  observers.push_back(&statistics);
  for (StepObserver* observer : observers) observer->begin(simulation);
  const std::int64_t first = motion.last_step() == 0 ? 1 : 0;  // without steps, begin() has the whole motion
  for (std::int64_t step = first; step < motion.rows(); ++step) {
    const double time = static_cast<double>(step) * motion.header().step;
    for (StepObserver* observer : observers) observer->replay(motion.row(step), time, unknown);
  }
  if (repeated) statistics.finish(simulation);
  std::vector<std::string> problems;
  std::vector<std::string> names = records.finish(simulation, statistics, "completed", Ending::complete, problems);
  if (!problems.empty()) throw OutputError(fmt::format("{}", fmt::join(problems, "\n")));
  return names;
}

namespace {

constexpr std::size_t tasks_in_flight = 8;

/// Returns true if a frame needs the state after this step: it lies at the step's end or less than a step away.
bool is_near_frame(const FilmExtent& extent, std::int64_t step) {
  constexpr double nearly_a_step = 1 - 1e-10;
  const double time = static_cast<double>(step) * extent.step, reach = nearly_a_step * extent.step;
  return std::floor((time - reach) / extent.seconds_per_frame) + 1 <=
         std::ceil((time + reach) / extent.seconds_per_frame) - 1;
}

MotionFileWriter make_writer(const MotionOptions& options, const ResumePoint* from, const LoadedScene& scene,
                             const FilmExtent& extent) {
  if (from != nullptr) return MotionFileWriter(options.path, *from);
  const MotionHeader header{.steps = extent.steps,
                            .recorded = options.recorded,
                            .colliders = collider_kinds(make_system(scene.simulation).colliders_at(0))};
  return MotionFileWriter(options.path, header, scene);
}

}  // namespace

MotionRecorder::MotionRecorder(const MotionOptions& options, const ResumePoint* from, const LoadedScene& scene,
                               const FilmExtent& extent, const Statistics& statistics, std::function<void()> given_up)
    : options_(options),
      extent_(extent),
      statistics_(statistics),
      given_up_(std::move(given_up)),
      writer_(make_writer(options, from, scene, extent)),
      kept_(std::chrono::steady_clock::now()),
      tasks_(tasks_in_flight),
      begun_(from != nullptr),
      thread_([this] { write(); }) {}

MotionRecorder::~MotionRecorder() {
  tasks_.close();
  if (thread_.joinable()) thread_.join();
  if (!finished_) discard_if_empty();
}

/// Deletes the file if no step was done, since nothing is lost then.
void MotionRecorder::discard_if_empty() {
  if (statistics_.steps() == 0 && !begun_) writer_.discard();
}

void MotionRecorder::begin(const Simulation& simulation) {
  if (begun_) return;
  add(simulation, {});
  keep(simulation);
}

void MotionRecorder::after_step(const Simulation& simulation, const StepReport& report, double /*seconds*/) {
  add(simulation, report);
  const auto now = std::chrono::steady_clock::now();
  const bool last = simulation.state().step == extent_.steps;  // a complete motion needs no checkpoint
  if (last || std::chrono::duration<double>(now - kept_).count() < options_.checkpoint_seconds) return;
  keep(simulation);
  kept_ = now;
}

void MotionRecorder::add(const Simulation& simulation, const StepReport& report) {
  const std::int64_t step = simulation.state().step;
  tasks_.push([row = StepRow{.step = step,
                             .energies = simulation.energies(),
                             .iterations = report.iterations,
                             .converged = report.converged,
                             .redone = report.redone,
                             .substeps = report.substeps,
                             .estimate = report.estimate,
                             .residual = step == 0 ? 0 : simulation.residual(),
                             .error = step == 0 ? std::nullopt : statistics_.exactness().error_of(step),
                             .colliders = simulation.colliders(simulation.time()),
                             .cloths = simulation.cloth().pieces.size() > 1
                                           ? simulation.piece_energies()
                                           : std::vector<Energies>()}](MotionFileWriter& to) { to.add(row); });
  if (is_recorded(step)) tasks_.push([state = simulation.state()](MotionFileWriter& to) { to.add(state); });
}

bool MotionRecorder::is_recorded(std::int64_t step) const {
  if (step == 0 || step == extent_.steps) return true;
  return options_.recorded.every ? step % *options_.recorded.every == 0 : is_near_frame(extent_, step);
}

void MotionRecorder::keep(const Simulation& simulation) {
  tasks_.push([checkpoint = simulation.checkpoint(), times = statistics_.microseconds()](MotionFileWriter& to) {
    to.keep(checkpoint, times);
  });
}

void MotionRecorder::write() {
  try {
    while (const std::optional<Task> task = tasks_.pop()) (*task)(writer_);
    return;
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
  tasks_.close();
  given_up_();
}

MotionOutcome MotionRecorder::finish(bool whole, const Simulation* last, std::vector<std::string>& problems) {
  if (!whole && last != nullptr) keep(*last);
  tasks_.close();
  if (thread_.joinable()) thread_.join();
  MotionOutcome outcome{.complete = {}, .growing = {}, .file = options_.path};
  try {
    if (problem_.empty() && whole) outcome.complete = OutputFile{options_.path, writer_.finish()};
  } catch (const Error& error) {
    problem_ = error.what();
  }
  if (!problem_.empty()) problems.push_back(problem_);
  if (!outcome.complete) {
    discard_if_empty();
    if (statistics_.steps() > 0) outcome.growing = growing_name(options_.path).string();
  }
  finished_ = true;  // the statistics may have moved away from here on
  return outcome;
}

}  // namespace drape
