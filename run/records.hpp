#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "run/statistics.hpp"

namespace drape {

/// Paths of a run's records; empty: not wanted.
struct RecordPaths {
  std::string stats;  ///< JSON, see Statistics::to_json
  std::string
      energies;  ///< CSV: step,time,total,kinetic,gravity,elastic, and of each of several cloths, from step 0 on [s, J]
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

/// Writes the records of a complete motion from its file, without simulating it again. A motion file has no step times:
/// they are empty in the trace and null in the statistics.
/// @param scene of the motion
/// @returns the names of the files written
/// @throws UsageError  if the motion is damaged
/// @throws OutputError if a record cannot be written
std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths);

}  // namespace drape
