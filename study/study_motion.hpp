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

/// A motion on a study's page, for interactive viewing.
struct StudyMotion {
  std::string label;               ///< makes a page of this motion alone; empty: no scene file has it
  std::string command;             ///< makes a page of this motion alone; empty: no scene has it
  html::PlayedMotion played = {};  ///< without frames if too large for a browser
};

/// Packs evenly spaced frames. Keeps every 2nd, 4th … frame so that at most 100 frames and 50 000 vertex positions
/// remain. Each motion adds some hundred kB to a page.
/// @param frames at least one
html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames);

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
std::optional<StudyMotion> record_study_motion(const StudyCase& what, const std::string& label,
                                               const std::stop_token& stop);

}  // namespace drape
