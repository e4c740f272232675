#pragma once

#include <functional>
#include <list>

#include "study/accuracy.hpp"
#include "study/film_judge.hpp"
#include "study/step_reference.hpp"

namespace drape {

/// Watches motions with an accuracy that was asked for, or with a fixed step, and finds what is wrong with them.
class MotionWatch {
 public:
  /// Refers to all of it.
  /// @param reference needed by watch()
  /// @param films     null: none are judged
  MotionWatch(const Scene& scene, const std::vector<double>& times, const StepReference* reference, FilmJudge* films)
      : scene_(scene), times_(times), reference_(reference), films_(films) {}

  /// What watches the motion of a point, and writes to it.
  std::function<void(const Simulation&, const StepReport&)> watch(MotionPoint& point, const StudyCase& what);

  /// Takes the steps that were watched again, in very small ones.
  /// @param points those whose local errors are wanted
  /// @returns false if it was stopped
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
