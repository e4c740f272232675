#pragma once

#include <string>
#include <vector>

#include "compare/compare_scenes.hpp"
#include "figures/diagram_files.hpp"

namespace drape {

/// A moment of a comparison, as a page shows it.
struct PageMoment {
  double time = 0;                    ///< [s]
  std::vector<std::string> pictures;  ///< PNG files, by panel
};

/// The diagrams of a page, as far as there is anything to draw: "energy", and how far motions are from the first,
/// "distance".
std::vector<NamedChart> comparison_charts(const CompareResult& result);

/// A self-contained page: the motions in step, their figures, and in what they differ.
/// @param bar a PNG file that says what the colours mean; empty: they mean nothing
std::string comparison_page(const CompareResult& result, const std::vector<PageMoment>& moments, const std::string& bar,
                            const std::string& command);

}  // namespace drape
