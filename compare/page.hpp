#pragma once

#include <string>
#include <vector>

#include "compare/compare_scenes.hpp"

namespace drape {

/// A moment of a comparison, as a page shows it.
struct PageMoment {
  double time = 0;                    ///< [s]
  std::vector<std::string> pictures;  ///< PNG files, by panel
};

/// A self-contained page: the motions in step, their figures, and in what they differ.
/// @param bar a PNG file that says what the colours mean; empty: they mean nothing
std::string comparison_page(const CompareResult& result, const std::vector<PageMoment>& moments, const std::string& bar,
                            const std::string& command);

}  // namespace drape
