#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drape {

struct SceneResult;

/// Properties of a scene and its film that may differ from the golden's.
enum class Property { mesh, vertices, step, steps, size, frame_time, frames, speed, rate, film_size, samples };

/// A property that differs from the golden's: one number, a size [pixels], or the numbers of frames; for a mesh none.
struct Difference {
  Property of = Property::mesh;
  std::vector<double> golden, now;
};

/// First steps that take too long.
struct SlowSteps {
  std::int64_t steps = 0;
  double ratio = 0;  ///< their time relative to the golden one
};

/// Kinds of findings.
enum class FindingKind {
  error,  ///< the scene was not judged; the text is a message
  no_golden,
  first_golden,  ///< there was no golden; this check recorded it
  recorded,
  recorded_again,
  method,        ///< SceneFinding::golden is the recorded method, the text today's
  vertex_order,  ///< the vertices were matched by the first frame
  incomparable,  ///< because of SceneFinding::difference
  motion,        ///< SceneResult::windows
  pictures,
  film,          ///< SceneResult::film
  slow,          ///< SceneResult::time
  not_timed,     ///< time was not compared, as it depends on the instruction set
  whole_motion,  ///< SceneResult::end_to_end
  whole_pictures,
  same_motion,   ///< only the pictures changed
  same_windows,  ///< neither changed
  elsewhere,     ///< SceneResult::recorded_on
  scene_changed,
  overrides,    ///< the text is the options
  no_candidate  ///< the text is the error that prevents a candidate
};

/// A fact that a check found.
struct SceneFinding {
  FindingKind kind = FindingKind::error;
  std::string text = {}, golden = {};
  Difference difference = {};
};

/// Returns a finding without capital and full stop: "the motion changed at step 37 by 2.1 mm at vertex 213". Empty if
/// the result lacks the values of that kind.
std::string sentence(const SceneResult& scene, const SceneFinding& finding);

/// Returns the sentences of all findings, most important first.
std::vector<std::string> sentences(const SceneResult& scene);

}  // namespace drape
