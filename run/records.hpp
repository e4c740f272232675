#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "run/statistics.hpp"
#include "run/step_observer.hpp"

namespace drape {

/// Paths of a run's records; empty: not wanted.
struct RecordPaths {
  std::string stats;      ///< JSON, see Statistics::to_json
  std::string energies;   ///< CSV: step,time,total,kinetic,gravity,elastic, from step 0 on [s, J]
  std::string positions;  ///< CSV: vertex,x,y,z after the last step, 17 digits [m]
  std::string trace;      ///< CSV: step,time,iterations,residual,step_us, from step 1 on [s, N, µs]
};

/// Writer of a run's records. The files get their names in finish(), whether or not the run succeeded; without that
/// call no file is left. A record that cannot be written stops neither the others nor the run.
class Records {
 public:
  /// Opens the files early, so that an unwritable folder is reported before the simulation starts.
  /// @throws OutputError if a file cannot be written
  explicit Records(const RecordPaths& paths);
  ~Records();

  /// Returns the observers that the wanted records need.
  [[nodiscard]] std::vector<StepObserver*> observers() const;

  /// Returns true if any record is wanted.
  [[nodiscard]] bool wanted() const;

  /// Completes every file, with a name that depends on `ending`, and returns the names.
  /// @param problems gets a message for each record that could not be written
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
