#pragma once

#include <optional>
#include <string>

#include "core/rgb.hpp"
#include "overlay/pen.hpp"
#include "overlay/text_template.hpp"

namespace drape {

/// Position in a picture. In the order of the names in a scene.
enum class CaptionPlace { top_left, top, top_right, bottom_left, bottom, bottom_right };

/// A text on every picture of a film.
struct CaptionSettings {
  std::string text;     ///< text from the scene
  TextTemplate filled;  ///< template with all constant fields filled in
  CaptionPlace place = CaptionPlace::top_left;
  std::optional<int> size;   ///< font size [pixels]; absent: text_size() of the picture
  std::optional<Rgb> color;  ///< absent: black or white, whichever contrasts more with the background
  Backing backing = Backing::halo;
};

/// Content of the bands below the picture.
struct OverlaySettings {
  bool energies = false;
};

}  // namespace drape
