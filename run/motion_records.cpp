#include "run/motion_records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "core/error.hpp"

namespace drape {

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
