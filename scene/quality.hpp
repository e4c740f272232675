#pragma once

#include <functional>

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Whether a document's quality is draft.
bool says_draft(const TomlValue& document);

/// Halves the columns and rows of a draft's grid of more than 20×20 cells, if no pin is chosen by its number or place:
/// corners, edges and borders are there on every grid. A grid that the command line gives stays.
/// @param document of a scene, after overrides
void coarsen_grid(TomlValue& document);

/// The cells that another scene has to have which draws a motion of this one.
inline Cells cells_of(const Scene& scene) {
  return scene.quality == Quality::draft ? Cells::of_draft : Cells::as_written;
}

/// Changes what trades time for detail as the scene's quality says, relative to its own values.
///   draft  half the size, at most 12.5 frames per second, one sample, no ambient occlusion, a tolerance that the scene
///          gives tenfold
///   print  twice the size, at most 8192 pixels, four samples, textures filtered 16-fold
/// A tolerance that follows from an accuracy stays. So does a value that the command line gives.
/// @param given whether the command line gives the value of a key, "video.size"
void apply_quality(Scene& scene, const std::function<bool(const char*)>& given);

}  // namespace drape
