#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "study/validation.hpp"

namespace drape {

/// A motion of a case's cloth, by drape or another simulator.
struct ObservedMotion {
  Cloth cloth;                       ///< cloth at the start of the case's scene
  std::vector<double> times;         ///< times of the states, ascending [s]
  std::vector<Vertices> positions;   ///< vertex positions at these times, n×3 [m]
  std::vector<Vertices> velocities;  ///< vertex velocities at these times, n×3 [m/s]; empty: unknown
  std::vector<double> elastic;       ///< energy of springs and bending at these times [J]; empty: unknown
};

/// Returns the names of all measures.
std::vector<std::string> measure_names();

/// Measures a motion.
/// @param measure one of measure_names()
/// @param given   numbers for the measure, by name
/// @returns quantities by name
/// @throws UsageError if the motion is too short, or lacks data that the measure needs
std::map<std::string, double> measure_motion(const std::string& measure, const ObservedMotion& motion,
                                             const std::map<std::string, double>& given);

/// File name of all measurements of a validation study.
inline constexpr const char* validation_runs_name = "runs.csv";

/// File name of the measurements of a shard.
inline constexpr const char* validation_shard_name = "validation-runs.csv";

/// Returns all measurements so far as a file of runs, see RunsWriter.
std::string validation_runs(const ValidationStudy& study);

/// Returns the recorded motions, see motions_csv().
std::string validation_motions(const ValidationStudy& study);

/// Copies the measurements of a file, and the motions beside it, into a planned study.
/// @param study planned with the same command as the file
/// @throws UsageError if the file is damaged or belongs to another study
void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study);

/// Returns the study in a file, with the runs that it has and the motions beside it.
/// @throws UsageError likewise
ValidationStudy validation_study(const std::filesystem::path& file);

/// A study merged from shards.
struct MergedValidation {
  ValidationStudy study;
  std::vector<Shard> missing;  ///< shards without measurements
};

/// Reads and merges the measurements of shards.
/// @param files at least one
/// @throws UsageError if a file is damaged, or they belong to different studies
MergedValidation merge_validation(const std::vector<std::filesystem::path>& files);

}  // namespace drape
