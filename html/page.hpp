#pragma once

#include <string>
#include <utility>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A page that needs nothing but itself: no network, no other file.
struct Page {
  std::string title;                                 ///< of the window
  std::string kind;                                  ///< a small line above the heading: "drape check"
  Markup heading;                                    ///< the finding in one sentence
  Markup introduction;                               ///< under the heading
  Markup content;                                    ///< sections
  std::vector<std::pair<std::string, Markup>> foot;  ///< machine, versions, revision: names and values
};

/// The complete file.
std::string render(const Page& page);

/// The foot's lines about this build and this machine.
std::vector<std::pair<std::string, std::string>> provenance();

}  // namespace drape::html
