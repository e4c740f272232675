#pragma once

#include <optional>
#include <string>

#include "core/rgb.hpp"
#include "overlay/pen.hpp"
#include "overlay/text_template.hpp"

namespace drape {

/// Where in a picture something stands. The order is that of the names in a scene.
enum class CaptionPlace { top_left, top, top_right, bottom_left, bottom, bottom_right };

/// A text on every picture of a film.
struct CaptionSettings {
  std::string text;     ///< as the scene has it
  TextTemplate filled;  ///< the same, where what does not change with time is filled in already
  CaptionPlace place = CaptionPlace::top_left;
  std::optional<int> size;   ///< of the font [pixels]; absent: what suits the picture, see text_size()
  std::optional<Rgb> color;  ///< absent: black or white, whichever is read better on the background
  Backing backing = Backing::halo;
};

/// What stands in bands below the picture.
struct OverlaySettings {
  bool energies = false;
};

}  // namespace drape
