#include "import/motion_source.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {

void fail_import(const std::string& name, const std::string& message) {
  throw UsageError(shown(name) + ": " + escape_controls(message));
}

void require_finite(const std::string& name, const Vertices& x) {
  constexpr double furthest = 1e100;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double value = x(v, axis);
      if (std::abs(value) <= furthest) continue;
      fail_import(name,
                  fmt::format("vertex {} has the {} coordinate {}; expected a finite number", v, "xyz"[axis], value));
    }
  }
}

}  // namespace drape
