#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/core/rgb.hpp"
#include "drape/core/warp_weft.hpp"
#include "drape/sim/tracks.hpp"

namespace drape::test {

/// Calls `visit` with the target of a key, if its type is one of these; otherwise returns an empty result.
template <class Result>
Result visit_target(const Key& key, auto visit) {
  Result result{};
  const auto attempt = [&]<class... Targets>() {
    static_cast<void>(((key.as<Targets>() != nullptr && (result = visit(*key.as<Targets>()), true)) || ...));
  };
  attempt.template
  operator()<bool*, int*, double*, std::string*, std::filesystem::path*, Rgb*, Choice, KeyframeList, VertexSelection,
             FormulaList, Eigen::Vector2i*, Eigen::Vector3d*, std::vector<int>*, std::optional<int>*,
             std::optional<double>*, std::optional<Rgb>*, std::optional<Eigen::Vector2i>*,
             std::optional<Eigen::Vector3d>*, std::optional<WarpWeft>*, std::shared_ptr<const SphereTrack>*>();
  return result;
}

}  // namespace drape::test
