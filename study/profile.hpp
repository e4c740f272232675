#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// What each solver takes for each problem.
struct ProfileTimes {
  std::vector<std::string> problems, solvers;
  std::vector<std::vector<double>> times;  ///< [solver][problem]; infinite: not solved
  std::vector<std::string> misses = {};    ///< in words, those where a run did not come to its end
};

/// A solver's curve of a performance profile.
struct ProfileCurve {
  std::string solver;
  std::vector<double> ratios;  ///< its times by the best of any solver, of the problems that it solves, ascending
  std::size_t problems = 0;    ///< all

  /// ρ(τ): the share of the problems that it solves within τ times the best time.
  [[nodiscard]] double share(double tau) const;
};

/// Performance profiles: Dolan and Moré, "Benchmarking Optimization Software with Performance Profiles", Mathematical
/// Programming 91, 2002, definition (1.1). A problem that nobody solves counts too: no curve reaches 1.
std::vector<ProfileCurve> performance_profile(const ProfileTimes& times);

/// The errors at the first time that a problem asks for: a scene is so many problems [m].
inline constexpr std::array<double, 2> profile_targets{1e-3, 1e-4};

/// Of every method (a solver) on every scene with every target (a problem) the least median cost of a second of motion
/// among its runs with a fixed step or an accuracy that end below the target [ms].
/// @param notes gets a sentence about what is no problem, since its reference is not known well enough
ProfileTimes profile_times(const std::vector<SceneAccuracy>& scenes, std::vector<std::string>& notes);

/// The profiles of all scenes; nothing if there is no problem.
std::optional<StudySection> profile_section(const std::vector<SceneAccuracy>& scenes);

}  // namespace drape
