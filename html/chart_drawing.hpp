#pragma once

#include "html/chart.hpp"

namespace drape::html {

/// What a drawing is for.
enum class Medium {
  page,  ///< every point is there with its label and its command, also where only the line is seen
  file   ///< what is seen
};

Diagram draw_chart(const Chart& chart, Medium medium);

}  // namespace drape::html
