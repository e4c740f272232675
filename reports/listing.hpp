#pragma once

#include <string>
#include <vector>

#include "reports/components.hpp"
#include "reports/page.hpp"

namespace drape::html {

/// A list whose entries open one at a time.
struct Listing {
  std::string kind;  ///< plural noun of the entries: "scenes"
  Table table;       ///< a row per entry, which begins with a link to the entry's section
  struct Entry {
    std::string id;     ///< id of the section's heading, the target of the link
    std::string group;  ///< name of the filter that shows the entry: "changed"
    Markup section;
  };
  std::vector<Entry> entries;  ///< in the order of the rows
  bool sortable = false;       ///< the table can be sorted by any column
};

/// Fewest entries for which a page opens them one at a time.
inline constexpr std::size_t many_entries = 6;

/// Returns the table and the sections. With many entries, the table has filters by group and by words, and a section
/// opens in place of the table. In print and without scripts everything is visible.
Markup listing(const Listing& listing);

}  // namespace drape::html
