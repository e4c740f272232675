#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/accuracy.hpp"
#include "study/report.hpp"

namespace drape {

/// Returns the exponent p of the best fit y = c xᵖ: the least-squares slope of the points' logarithms. Points that are
/// not positive are ignored.
/// @returns NaN with fewer than two different x
double fitted_exponent(const std::vector<std::array<double, 2>>& points);

/// The time of each solver for each problem.
struct ProfileTimes {
  std::vector<std::string> problems, solvers;
  std::vector<std::vector<double>> times;  ///< [solver][problem]; infinite: not solved
  std::vector<std::string> misses = {};    ///< descriptions of the runs that ended early
};

/// A solver's curve of a performance profile.
struct ProfileCurve {
  std::string solver;
  std::vector<double> ratios;  ///< times relative to the best solver, over the solved problems, ascending
  std::size_t problems = 0;    ///< number of all problems

  /// Returns ρ(τ): the share of problems solved within τ times the best time.
  [[nodiscard]] double share(double tau) const;
};

/// Computes performance profiles: Dolan and Moré, "Benchmarking Optimization Software with Performance Profiles",
/// Mathematical Programming 91, 2002, definition (1.1). Unsolved problems count too: they keep all curves below 1.
std::vector<ProfileCurve> performance_profile(const ProfileTimes& times);

/// Target errors at the first time; each scene gives one problem per target [m].
inline constexpr std::array<double, 2> profile_targets{1e-3, 1e-4};

/// Returns the least median cost of a second of motion, for every method (solver) on every scene and target (problem).
/// Considers runs with a fixed step or an accuracy that end below the target [ms].
/// @param notes gets a sentence about each problem dropped because of an inaccurate reference
ProfileTimes profile_times(const std::vector<SceneAccuracy>& scenes, std::vector<std::string>& notes);

/// Returns the profiles of all scenes; nothing without problems.
std::optional<StudySection> profile_section(const std::vector<SceneAccuracy>& scenes);

}  // namespace drape
