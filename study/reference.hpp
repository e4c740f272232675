#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"
#include "reports/players.hpp"
#include "run/progress.hpp"
#include "study/runs_file.hpp"

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

/// The distance of two shapes of a cloth, over its vertices [m].
struct Distance {
  double max = 0, rms = 0;
};
Distance distance(const Vertices& a, const Vertices& b);

/// Returns the settings with an implicit method that iterates until the change is at the level of rounding. Forces at a
/// vertex are known to ε·|x|·Σk, which moves it by at most h²/m times that.
SimulationSettings to_rounding(SimulationSettings settings, Method method);

/// A motion computed by Newton's method to rounding, and by quasi-Newton for comparison.
struct ReferenceMotion {
  std::vector<State> states;  ///< by Newton, at the requested steps
  std::vector<double> apart;  ///< largest distance of a vertex in the two motions, [k] after step k+1 [m]

  /// Returns their distance after a step; 0 before the first.
  [[nodiscard]] double apart_after(std::int64_t step) const {
    return step == 0 ? 0 : apart[static_cast<std::size_t>(step - 1)];
  }
  /// Returns the first step after which their distance exceeds the limit [m].
  [[nodiscard]] std::optional<std::int64_t> first_beyond(double limit) const;
};

/// Computes a reference motion. Stores the states of the steps in `keep`, ascending and at most `steps`.
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<ReferenceMotion> run_reference(const SimulationSettings& settings, std::int64_t steps,
                                             const std::vector<std::int64_t>& keep, const std::stop_token& stop,
                                             Progress& progress);

/// Returns the first step at which contact changes the motion by more than a limit [m]. It compares with the motion
/// without spheres, grounds, self-collision and strain limit. Nothing if there is no contact within `steps`.
/// @throws DivergedError
std::optional<std::int64_t> first_contact(const SimulationSettings& settings, std::int64_t steps, double limit,
                                          const std::stop_token& stop);

}  // namespace drape
