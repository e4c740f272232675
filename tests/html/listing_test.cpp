#include <gtest/gtest.h>

#include <fmt/format.h>

#include "reports/listing.hpp"
#include "reports/page.hpp"
#include "tests/html/html_page.hpp"

namespace drape::html {
namespace {

class ListingOfEntries : public test::InBrowser {
 protected:
  void open_entries(std::size_t count, bool sortable = false) {
    Listing listing{"scenes", {"Checked scenes", {{"Scene"}, {"Verdict"}}, {}}, {}, sortable};
    for (std::size_t i = 0; i < count; ++i) {
      const std::string id = fmt::format("scene-{}", i), name = fmt::format("name{}", i);
      const std::string group = i < 2 ? "changed" : "passed";
      listing.table.rows.push_back({link("#" + id, name), group});
      const Markup content = paragraph("About " + name);
      listing.entries.push_back({id, group, section(2, id, name, i < 2 ? content : details("Pictures", content))});
    }
    open(render({"kind", "title", "heading", {}, html::listing(listing), {}}));
  }

  /// Returns the visible texts of a selector.
  std::string seen(const std::string& selector) {
    return browser_->run("return [...document.querySelectorAll('" + selector +
                         "')].filter((e) => e.getClientRects().length).map((e) => e.textContent).join()");
  }
};

TEST_F(ListingOfEntries, ShowsFewAtOnce) {
  open_entries(many_entries - 1);
  expect_sound();
  EXPECT_EQ(seen("h2"), "name0,name1,name2,name3,name4,How this was made");
  EXPECT_EQ(seen(".filters button"), "");
}

TEST_F(ListingOfEntries, OpensOneOfManyAndGoesBack) {
  open_entries(many_entries + 1);
  expect_sound();
  keep_screenshots("listing");
  browser_->set_width(1200);
  EXPECT_EQ(seen("main h2"), "");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name0,name1,name2,name3,name4,name5,name6");
  follow("tbody tr:nth-child(4) a");
  EXPECT_EQ(seen("main h2"), "name3");
  EXPECT_EQ(seen("tbody"), "");
  EXPECT_EQ(seen("main p"), "About name3") << "the details of an unchanged scene open with it";
  follow(".entry:not([hidden]) .entry-links a:last-child");
  EXPECT_EQ(seen("main h2"), "name4");
  follow(".entry:not([hidden]) .entry-links a");
  EXPECT_EQ(seen("main h2"), "");
  EXPECT_NE(seen("tbody"), "");
}

TEST_F(ListingOfEntries, HasFiltersByGroupAndName) {
  open_entries(many_entries + 1);
  EXPECT_EQ(seen(".filters button"), "all 7,changed 2,passed 5");
  browser_->click(".filters button:nth-child(2)");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name0,name1");
  browser_->click(".filters button:nth-child(1)");
  browser_->click(".filters input");
  browser_->press("E5");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name5");
}

TEST_F(ListingOfEntries, LeavesTheRowsWithAllOfTheWords) {
  open_entries(many_entries + 1);
  browser_->click(".filters input");
  browser_->press("PASS 3");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name3");
  browser_->press("x");
  EXPECT_EQ(seen("tbody tr td:first-child"), "");
}

TEST_F(ListingOfEntries, OpensTheEntryOfASortedRow) {
  open_entries(many_entries + 1, true);
  expect_sound();
  browser_->set_width(1200);
  browser_->click("th button");
  browser_->click("th button");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name6,name5,name4,name3,name2,name1,name0");
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.filters input').length"), 1) << "one field, not two";
  browser_->click(".filters button:nth-child(2)");
  EXPECT_EQ(seen("tbody tr td:first-child"), "name1,name0");
  follow("tbody tr:not([hidden]) a");
  EXPECT_EQ(seen("main h2"), "name1");
}

TEST_F(ListingOfEntries, PrintsAllOfThem) {
  open_entries(many_entries + 1);
  browser_->set_print(false);
  EXPECT_EQ(seen("tbody tr td:first-child"), "name0,name1,name2,name3,name4,name5,name6");
  EXPECT_EQ(seen("main h2"), "name0,name1") << "closed details are not printed, and so their headings are not";
  EXPECT_EQ(seen(".filters button"), "");
}

}  // namespace
}  // namespace drape::html
