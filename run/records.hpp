#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "run/statistics.hpp"
#include "run/step_observer.hpp"

namespace drape {

/// Where a run's records go; empty: not wanted.
struct RecordPaths {
  std::string stats;      ///< JSON, see Statistics::to_json
  std::string energies;   ///< CSV: step,time,total,kinetic,gravity,elastic, from step 0 on [s, J]
  std::string positions;  ///< CSV: vertex,x,y,z after the last step, 17 digits [m]
  std::string trace;      ///< CSV: step,time,iterations,residual,step_us, from step 1 on [s, N, µs]
};

/// Writes the records of a run. The files get their names when finish() is called, whatever the outcome of the run was;
/// without it nothing of them is left. One that cannot be written does not keep the others from it, nor the run.
class Records {
 public:
  /// Opens what is wanted, so that an unwritable folder is known before anything is computed.
  /// @throws OutputError if a file cannot be written
  explicit Records(const RecordPaths& paths);
  ~Records();

  /// What must watch the run for the records that are wanted.
  [[nodiscard]] std::vector<StepObserver*> observers() const;

  /// Whether any is wanted.
  [[nodiscard]] bool wanted() const;

  /// Completes every file, under the name that its ending gives it, and returns their names.
  /// @param problems gets a message for each that could not be written
  std::vector<std::string> finish(const Simulation& simulation, const Statistics& statistics,
                                  const std::string& outcome, Ending ending, std::vector<std::string>& problems);

 private:
  class Record;
  class EnergyLog;
  class TraceLog;

  std::unique_ptr<Record> stats_, positions_;
  std::unique_ptr<EnergyLog> energies_;
  std::unique_ptr<TraceLog> trace_;
};

}  // namespace drape
