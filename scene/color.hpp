#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/rgb.hpp"

namespace drape {

/// Returns the names of all named colours: the sixteen basic colours of CSS, and orange.
std::span<const std::string> color_names();

/// Reads "#rrggbb", "#rgb" or one of color_names(). Returns nothing for other texts.
std::optional<Rgb> parse_color(std::string_view text);

/// Returns "#rrggbb"; each channel is rounded to the nearest of 0…255.
std::string color_text(const Rgb& color);

}  // namespace drape
