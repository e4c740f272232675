#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <string>

#include "drape/render/settings.hpp"
#include "study/accuracy.hpp"
#include "study/accuracy_report.hpp"
#include "study/animation.hpp"
#include "study/reference.hpp"
#include "study/report.hpp"

namespace drape {

/// Observer of motions with an accuracy or a fixed step, which computes their errors.
class MotionWatch {
 public:
  /// Keeps references to all arguments.
  /// @param reference required by watch()
  /// @param films     null: films are not compared
  MotionWatch(const Scene& scene, const std::vector<double>& times, const StepReference* reference, FilmJudge* films)
      : scene_(scene), times_(times), reference_(reference), films_(films) {}

  /// Returns an observer of a point's motion, which writes to the point.
  std::function<void(const Simulation&, const StepReport&)> watch(MotionPoint& point, const StudyCase& study_case);

  /// Computes the true local errors of the observed steps, by very small steps from the same states.
  /// @param points to which the local errors are written
  /// @returns false if stopped
  bool find_local_errors(std::vector<MotionPoint>& points, std::vector<std::string>& notes, const std::stop_token& stop,
                         Progress& progress) const;

 private:
  struct Step {
    State before;
    Vertices after;
  };
  struct Watched {
    const MotionPoint* point;
    State before;
    std::vector<Step> steps;
  };

  const Scene& scene_;
  const std::vector<double>& times_;
  const StepReference* reference_;
  FilmJudge* films_;
  std::list<Watched> watched_;
};

/// Checks that the lists of a scene read from a file have matching sizes, so that a report can be made.
/// @returns the first defect as a sentence without a full stop; empty: none
std::string unsound_in(const SceneAccuracy& scene);

/// The property in which the panels of an animation differ.
enum class AnimatedBy { tolerances, methods, steps };
inline constexpr std::array<const char*, 3> animated_by_names{"tolerances", "methods", "steps"};

/// Animates a studied scene: up to four tolerances of one method, the methods at one tolerance, or up to four time
/// steps of one method.
/// @param folder for the results
/// @returns nothing if stopped, or with fewer than two panels
/// @throws OutputError
std::optional<StudyPicture> animate_accuracy(const SceneAccuracy& accuracy, AnimatedBy by,
                                             const std::filesystem::path& folder, GlBackend backend,
                                             const std::stop_token& stop, Progress& progress);

/// Name of the file with a study's measurements, in its results folder.
inline constexpr const char* runs_name = "runs.csv";

/// Returns all measurements of a study, as RunsWriter writes them. read_runs() restores the study, which gives the same
/// report. The format is described in docs/reference/study-data.md.
std::string runs_csv(const AccuracyStudy& study);

/// Writes a study's measurements, and the motions of its animations, into the folder of its results.
/// @throws OutputError
void write_runs(const AccuracyStudy& study, const std::filesystem::path& folder);

/// Reads a study from the folder of its results, with the animations and their motions.
/// @throws UsageError "file:line: message" if the file is missing, truncated or of another kind
AccuracyStudy read_runs(const std::filesystem::path& folder);

}  // namespace drape
