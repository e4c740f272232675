#pragma once

#include <string>
#include <vector>

#include "compare/compare_scenes.hpp"
#include "reports/diagram_files.hpp"

namespace drape {

/// A moment of a comparison on a page.
struct PageMoment {
  double time = 0;                    ///< [s]
  std::vector<std::string> pictures;  ///< PNG files, by panel
};

/// Returns the diagrams of a page: "energy", and "distance" for the distances to the first motion. Omits empty ones.
std::vector<NamedChart> comparison_charts(const CompareResult& result);

/// Returns a self-contained page: the motions in step, their figures, and their differing keys.
/// @param poster index of the moment shown before one is chosen
/// @param bar    PNG file of the colour bar; empty: there is none
std::string comparison_page(const CompareResult& result, const std::vector<PageMoment>& moments, std::size_t poster,
                            const std::string& bar, const std::string& command);

}  // namespace drape
