#include "run/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <limits>
#include <utility>

#include "drape/core/error.hpp"

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

std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Records records(paths);
  Statistics statistics;
  Simulation simulation(scene.simulation);
  simulation.restore(motion.state(motion.states() - 1));
  std::vector<StepObserver*> observers = records.observers();
  observers.push_back(&statistics);
  for (StepObserver* observer : observers) observer->begin(simulation);
  const std::int64_t first = motion.last_step() == 0 ? 1 : 0;  // without steps, begin() has the whole motion
  for (std::int64_t step = first; step < motion.rows(); ++step) {
    const double time = static_cast<double>(step) * motion.header().step;
    for (StepObserver* observer : observers) observer->replay(motion.row(step), time, unknown);
  }
  std::vector<std::string> problems;
  std::vector<std::string> names = records.finish(simulation, statistics, "completed", Ending::complete, problems);
  if (!problems.empty()) throw OutputError(fmt::format("{}", fmt::join(problems, "\n")));
  return names;
}

}  // namespace drape
