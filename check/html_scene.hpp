#pragma once

#include <string>

#include "check/report.hpp"
#include "html/components.hpp"

// Parts of the HTML report for one scene.

namespace drape {

html::Tone tone_of(SceneVerdict verdict);
html::Tone tone_of(MotionVerdict verdict);
html::Tone tone_of(PictureVerdict verdict);

/// Returns the verdict as a word with its sign.
template <class Verdict>
html::Markup verdict_badge(Verdict verdict) {
  return html::badge(verdict_name(verdict), tone_of(verdict));
}

/// Returns the largest deviation of any vertex at any step [m]; 0 if there is none.
double largest_deviation(const Comparison& comparison);

/// Returns the largest FLIP error of any pixel in any frame.
double largest_flip(const Comparison& comparison);

/// Returns the whole section of a scene except its name and verdict.
/// @param id unique in the page, for the viewers
html::Markup scene_content(const SceneResult& scene, const std::string& id);

}  // namespace drape
