#include "study/method_series.hpp"

#include <algorithm>

#include "scene/method_names.hpp"

namespace drape {

html::ChartSeries method_series(const std::string& name) {
  // Additions to a method's name, such as a source or a scheme, keep its colour and marker, but are dashed.
  const std::string method = name.substr(0, std::min(name.find(','), name.find("-sdirk2")));
  const auto* const place = std::find(method_names.begin(), method_names.end(), method);
  html::ChartSeries series{name, {}};
  series.style = static_cast<std::size_t>(place - method_names.begin());
  series.other = method != name;
  return series;
}

}  // namespace drape
