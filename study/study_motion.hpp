#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "html/motion_player.hpp"
#include "sim/frame.hpp"
#include "sim/simulation.hpp"
#include "study/case.hpp"

namespace drape {

/// A motion on the page of a study, to turn and to play.
struct StudyMotion {
  std::string label;               ///< "liu13, k = 18 N/m"
  std::string command;             ///< makes a page of this motion alone; empty: no scene has it
  html::PlayedMotion played = {};  ///< without frames if a browser cannot hold it
};

/// Packs frames that are evenly spaced. Takes every second, fourth … of them where they are more than 100, or more than
/// 50 000 positions of vertices, so a page grows by some hundred kB for each motion.
/// @param frames at least one
html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames);

/// Keeps states of a run for the page of a study: evenly spaced, and so many as pack_for_page() takes, however long the
/// run is.
class StudyMotionRecorder {
 public:
  /// @param scene outlives it
  explicit StudyMotionRecorder(const Scene& scene);

  /// Takes the state before the first step, and that after each step.
  void add(const Simulation& simulation);

  [[nodiscard]] html::PlayedMotion finish() const;

 private:
  const Scene& scene_;
  std::size_t most_;
  std::int64_t every_ = 1;  // steps between two frames
  std::vector<Frame> frames_;
};

/// Runs a case once more and keeps its motion. A motion that diverges ends there.
/// @returns nothing if it was stopped
std::optional<StudyMotion> record_study_motion(const StudyCase& what, const std::string& label,
                                               const std::stop_token& stop);

}  // namespace drape
