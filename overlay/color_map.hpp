#pragma once

#include "core/rgb.hpp"

namespace drape {

/// The colours of "viridis", from dark blue (0) to yellow (1): equal steps look equal, and are told apart with any kind
/// of colour vision and in gray (S. van der Walt and N. Smith 2015, https://bids.github.io/colormap, in the public
/// domain). Values beyond 0 and 1 have the colours of the ends.
Rgb viridis(double value);

}  // namespace drape
