#pragma once

#include <string>
#include <utility>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A self-contained page: no network, no other file.
struct Page {
  std::string title;                                 ///< title of the window
  std::string kind;                                  ///< a small line above the heading: "drape check"
  Markup heading;                                    ///< result in one sentence
  Markup introduction;                               ///< text under the heading
  Markup content;                                    ///< sections
  std::vector<std::pair<std::string, Markup>> foot;  ///< machine, versions, revision: names and values
};

/// Returns the complete file.
std::string render(const Page& page);

/// Returns lines about this build and this machine for the foot of the page.
std::vector<std::pair<std::string, std::string>> provenance();

}  // namespace drape::html
