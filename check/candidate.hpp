#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check/golden.hpp"
#include "drape/scene/scene.hpp"

namespace drape {

/// A possible new golden, kept by a failed check beside its report: REPORT/NAME/candidate.json, and the golden in
/// REPORT/NAME/candidate.
struct Candidate {
  std::filesystem::path folder;      ///< REPORT/NAME/candidate
  std::string hash;                  ///< hash of the manifest, as listed in report.json
  std::string name;                  ///< name of the scene in the report
  std::filesystem::path scene_file;  ///< path as given to the check
  std::string scene_digest;          ///< digest of the checked scene, see SceneSource::digest
  std::string program;               ///< hash of the drape program that computed it
};

/// Writes a candidate.
/// @returns the candidate's hash for the report, which no other check's candidate has
/// @throws OutputError
std::string write_candidate(const std::filesystem::path& report, const std::string& name, const LoadedScene& scene,
                            const Golden& golden, const std::vector<Png>& pictures);

/// Checks that any files already at the candidate's path were written by drape.
/// @throws UsageError if other files are there, or if a link leads out of the report's folder
void require_own_candidate(const std::filesystem::path& report, const std::string& name);

/// Removes an earlier check's candidate.
/// @throws UsageError as require_own_candidate(), before anything is removed
void remove_candidate(const std::filesystem::path& report, const std::string& name);

/// Returns the candidates listed in a report, by name. Ignores other checks' candidates in its folder.
/// @param wanted names in the report, or scene files; empty: all
/// @throws UsageError for an unknown name, no candidates, or a damaged report.json or candidate
std::vector<Candidate> find_candidates(const std::filesystem::path& report, const std::vector<std::string>& wanted);

/// Checks that a candidate may become the golden of its scene.
/// @param frames numbers of the pictures to accept; empty: everything
/// @throws UsageError if the scene, the program or the candidate has changed since the check
/// @throws UsageError if `frames` is not empty and the motion differs from the golden one
void require_acceptable(const Candidate& candidate, const std::vector<int>& frames);

/// Makes a candidate the golden of its scene, atomically and without simulating.
/// @returns the golden's folder
/// @throws UsageError as require_acceptable()
/// @throws OutputError
std::filesystem::path accept_candidate(const Candidate& candidate, const std::vector<int>& frames);

}  // namespace drape
