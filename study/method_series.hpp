#pragma once

#include <string>

#include "html/chart.hpp"

namespace drape {

/// An empty series in its method's colour and sign, which are the same in every diagram. Where the name says more than
/// the method ("liu13, report"), it is dashed and its signs are open.
html::ChartSeries method_series(const std::string& name);

}  // namespace drape
