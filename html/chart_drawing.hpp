#pragma once

#include "html/chart.hpp"

namespace drape::html {

/// Purpose of a drawing.
enum class Medium {
  page,  ///< every point has its label and its command, even if only the line is visible
  file   ///< only visible parts
};

Diagram draw_chart(const Chart& chart, Medium medium);

}  // namespace drape::html
