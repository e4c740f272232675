#pragma once

#include <string>

#include "html/chart.hpp"

namespace drape {

/// Returns an empty series with its method's colour and marker, the same in every diagram. A name with an addition
/// ("liu13, report") makes it dashed, with open markers.
html::ChartSeries method_series(const std::string& name);

}  // namespace drape
