#pragma once

#include <functional>
#include <list>

#include "study/accuracy.hpp"
#include "study/film_judge.hpp"
#include "study/step_reference.hpp"

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
  std::function<void(const Simulation&, const StepReport&)> watch(MotionPoint& point, const StudyCase& what);

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

}  // namespace drape
