#include "reports/listing.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "reports/players.hpp"

namespace drape::html {
namespace {

constexpr const char* list_id = "list";

Markup filter(const std::string& group, const std::string& label, std::size_t count, bool pressed) {
  return element("button", {{"type", "button"}, {"data-group", group}, {"aria-pressed", pressed ? "true" : "false"}},
                 fmt::format("{} {}", label, count));
}

/// Returns a button for each group with its number of entries, and a field for words of a row.
Markup filters(const Listing& listing) {
  std::vector<std::pair<std::string, std::size_t>> groups;
  for (const Listing::Entry& entry : listing.entries) {
    const auto found = std::ranges::find(groups, entry.group, &std::pair<std::string, std::size_t>::first);
    if (found == groups.end()) {
      groups.emplace_back(entry.group, 1);
    } else {
      ++found->second;
    }
  }
  Markup parts = filter("", "all", listing.entries.size(), true);
  for (const auto& [group, count] : groups) parts += filter(group, group, count, false);
  return element("div", {{"class", "filters"}},
                 parts + element("input", {{"type", "search"},
                                           {"placeholder", "Filter rows"},
                                           {"aria-label", "Filter rows"},
                                           {"autocomplete", "off"}}));
}

/// Returns links to the list and to the neighbours of an entry.
Markup links(const Listing& listing, std::size_t i) {
  Markup parts = link(fmt::format("#{}", list_id), "‹ All " + listing.kind);
  if (i > 0) parts += link("#" + listing.entries[i - 1].id, "Previous");
  if (i + 1 < listing.entries.size()) parts += link("#" + listing.entries[i + 1].id, "Next");
  return element("nav", {{"class", "entry-links"}, {"aria-label", "Other " + listing.kind}}, parts);
}

}  // namespace

Markup listing(const Listing& listing) {
  const bool many = listing.entries.size() >= many_entries;
  Markup sections;
  for (std::size_t i = 0; i < listing.entries.size(); ++i) {
    const Listing::Entry& entry = listing.entries[i];
    if (!many) {
      sections += entry.section;
      continue;
    }
    sections += element("div", {{"class", "entry"}, {"data-group", entry.group}}, links(listing, i) + entry.section);
  }
  const Markup overview = listing.sortable ? sortable_table(listing.table) : table(listing.table);
  if (!many) return overview + sections;
  return element("div", {{"class", "listing"}},
                 element("div", {{"class", "list"}, {"id", list_id}}, filters(listing) + overview) + sections);
}

}  // namespace drape::html
