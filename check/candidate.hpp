#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check/golden.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What a failed check would have recorded, kept beside its report: REPORT/NAME/candidate.json and the golden in
/// REPORT/NAME/candidate.
struct Candidate {
  std::filesystem::path folder;      ///< REPORT/NAME/candidate
  std::string hash;                  ///< that report.json lists of it
  std::string name;                  ///< of the scene in the report
  std::filesystem::path scene_file;  ///< as it was given to the check
  std::string scene_digest;          ///< of the scene that was checked, see Scene::digest
  std::string program;               ///< that has computed it, see program_hash()
};

/// Keeps what can be accepted.
/// @returns its hash, which the report lists: what another check leaves in the folder has another one
/// @throws OutputError
std::string write_candidate(const std::filesystem::path& report, const std::string& name, const Scene& scene,
                            const Golden& golden, const std::vector<Png>& pictures);

/// Makes sure that what has a candidate's place beside a report, if anything, is one that drape has written.
/// @throws UsageError if it is something else, or a link leads out of the report's folder
void require_own_candidate(const std::filesystem::path& report, const std::string& name);

/// Forgets what an earlier check has left. @throws UsageError likewise; then nothing is removed
void remove_candidate(const std::filesystem::path& report, const std::string& name);

/// The candidates that a report lists, by name. What else is in its folder is another check's, and is left alone.
/// @param wanted names in the report, or scene files; empty: all
/// @throws UsageError if there is none of a name, or none at all, or report.json or a candidate is damaged
std::vector<Candidate> find_candidates(const std::filesystem::path& report, const std::vector<std::string>& wanted);

/// Looks whether a candidate may become the golden of its scene.
/// @param frames whose pictures are accepted; empty: everything
/// @throws UsageError if the scene or the program is not that of the check, if something is not as it was written, or
/// if
///         pictures are wanted alone of a motion that is another one than the golden
void require_acceptable(const Candidate& candidate, const std::vector<int>& frames);

/// Makes a candidate the golden of its scene, in one go, without computing anything.
/// @returns the golden's folder
/// @throws UsageError as require_acceptable(); OutputError
std::filesystem::path accept_candidate(const Candidate& candidate, const std::vector<int>& frames);

}  // namespace drape
