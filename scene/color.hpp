#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/rgb.hpp"

namespace drape {

/// The names of the colours that have one: the sixteen basic colours of CSS, and orange.
std::span<const std::string> color_names();

/// Reads "#rrggbb", "#rgb" or one of color_names(). Nothing if it is none of these.
std::optional<Rgb> parse_color(std::string_view text);

/// "#rrggbb", each channel rounded to the nearest of 0…255.
std::string color_text(const Rgb& color);

}  // namespace drape
