#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/render/view.hpp"
#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"
#include "reports/players.hpp"
#include "study/runs_file.hpp"

namespace drape {

/// A motion on a study's page, for interactive viewing.
struct StudyMotion {
  std::string label;               ///< heading of the player, and its name for screen readers
  std::string command;             ///< command that makes a page of this motion alone; empty: no scene has it
  html::PlayedMotion played = {};  ///< without frames if too large for a browser
};

/// Packs evenly spaced frames. Keeps every 2nd, 4th … frame so that at most 100 frames and 50 000 vertex positions
/// remain. Each motion adds some hundred kB to a page.
/// @param frames at least one
/// @param first  as in MotionPacker::finish()
html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames, const View& first);

/// Recorder of a run's states for a study's page: evenly spaced, as many as pack_for_page() takes, for runs of any
/// length.
class StudyMotionRecorder {
 public:
  /// @param scene outlives the recorder
  explicit StudyMotionRecorder(const Scene& scene);

  /// Adds a state: call before the first step and after each step.
  void add(const Simulation& simulation);

  [[nodiscard]] html::PlayedMotion finish() const;

 private:
  const Scene& scene_;
  std::size_t most_;
  std::int64_t every_ = 1;  // steps between two frames
  std::vector<Frame> frames_;
};

/// Runs a case once more and records its motion, up to a divergence.
/// @returns nothing if stopped
std::optional<StudyMotion> record_study_motion(const StudyCase& study_case, const std::string& label,
                                               const std::stop_token& stop);

/// A motion on a study's page, with the part of the page that shows it: a picture's file, or a case.
struct ShownMotion {
  std::string part;
  StudyMotion motion;
};

/// Name of the file with the motions of a study's page, beside its runs.
inline constexpr const char* motions_name = "motions.csv";

/// Returns the motions as RunsWriter writes them, their numbers in base64.
std::string motions_csv(const std::vector<ShownMotion>& motions);

/// Reads the motions of a study, so that its page can be made again. A study without the file has none.
/// @throws UsageError "file:line: message" if the file is damaged
std::vector<ShownMotion> read_motions(const std::filesystem::path& file);

}  // namespace drape
