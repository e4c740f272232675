#pragma once

#include "core/rgb.hpp"

namespace drape {

/// Returns a colour of "viridis", from dark blue (0) to yellow (1). Equal steps look equal, and remain distinct with
/// any kind of colour vision and in grey (S. van der Walt and N. Smith 2015, https://bids.github.io/colormap, public
/// domain). Values beyond 0 and 1 get the colours of the ends.
Rgb viridis(double value);

}  // namespace drape
