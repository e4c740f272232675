#pragma once

#include <functional>

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Returns true if a document's quality is draft.
bool says_draft(const TomlValue& document);

/// Halves the columns and rows of a draft's grid of more than 20×20 cells. Grids with pins chosen by number or position
/// stay; corners, edges and borders exist on every grid. A grid from the command line stays too.
/// @param document document of a scene, after overrides
void coarsen_grid(TomlValue& document);

/// Returns the cells that another scene needs in order to draw a motion of this one.
inline Cells cells_of(const Scene& scene) {
  return scene.quality == Quality::draft ? Cells::of_draft : Cells::as_written;
}

/// Adjusts settings that trade time for detail to the scene's quality, relative to their values.
///   draft  half the size, at most 12.5 frames per second, one sample, no ambient occlusion, ten times the given
///          tolerance
///   print  twice the size, at most 8192 pixels, four samples, textures filtered 16-fold
/// A tolerance derived from an accuracy stays. Values from the command line stay.
/// @param given returns true if the command line gives a key, "video.size"
void apply_quality(Scene& scene, const std::function<bool(const char*)>& given);

}  // namespace drape
