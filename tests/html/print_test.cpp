#include <gtest/gtest.h>

#include <cmath>

#include "output/png_encoder.hpp"
#include "reports/chart.hpp"
#include "reports/components.hpp"
#include "reports/latex.hpp"
#include "reports/page.hpp"
#include "reports/players.hpp"
#include "reports/result_table.hpp"
#include "tests/html/html_page.hpp"

// Pages on paper, in a narrow window, and in the clipboard.

namespace drape::html {
namespace {

class Paper : public test::InBrowser {
 protected:
  void open_page(const Markup& content) { open(render({"kind", "title", "heading", {}, content, {}})); }

  void print(bool dark = false) {
    browser_->set_print(dark);
    browser_->set_width(paper_width);
  }

  /// Counts the visible elements of a selector.
  int seen(const std::string& selector) {
    return browser_->run("return [...document.querySelectorAll('" + selector +
                         "')].filter((e) => e.getClientRects().length).length");
  }

  /// Returns the clipboard's content after a press of the button.
  std::string copied(const std::string& selector) {
    browser_->run(
        "Object.defineProperty(navigator, 'clipboard', { configurable: true, value: { writeText: async (t) => { "
        "window.copied = t } } }); document.querySelector('" +
        selector + "').click()");
    return browser_->run("return window.copied");
  }
};

Markup wide_table() {
  Table wide{"Many columns", {{"method"}}, {{"quasi-newton"}}};
  for (int i = 0; i < 14; ++i) {
    wide.columns.push_back({"ε & cost_" + std::to_string(i), true});
    wide.rows.front().push_back("0.000" + std::to_string(100000 + i));
  }
  return table(wide);
}

/// Makes a chart of three curves, two of which coincide.
Chart sample_chart() {
  Chart chart{"What three methods cost.", "step [s]", "error [m]", Scale::logarithmic, Scale::logarithmic, {}, {}};
  for (const auto& [name, factor] : {std::pair("implicit", 1.0), std::pair("liu13", 1.0), std::pair("verlet", 8.0)}) {
    ChartSeries series{name, {}};
    for (int k = 0; k < 6; ++k) series.points.push_back({std::pow(10, -k), factor * std::pow(10, -k), "a point", ""});
    chart.series.push_back(series);
  }
  return chart;
}

TEST_F(Paper, HoldsWholeTablesOnWhite) {
  open_page(wide_table() + chart(sample_chart()) + command("Again", std::string(300, 'x')));
  for (const bool dark : {false, true}) {
    print(dark);
    EXPECT_EQ(
        browser_->run("return [...document.querySelectorAll('.scroll, .command code')].filter((e) => e.scrollWidth > "
                      "e.clientWidth + 1 && e.getClientRects().length).length"),
        0);
    EXPECT_LE(browser_->run("return document.documentElement.scrollWidth").get<int>(), paper_width);
    EXPECT_EQ(browser_->run("return getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)");
    EXPECT_EQ(browser_->run("return getComputedStyle(document.body).color"), "rgb(30, 31, 33)");
    EXPECT_EQ(seen("button"), 0);
  }
}

/// Counts the elements of a selector with more than one line.
int in_lines(test::Browser& browser, const std::string& selector) {
  return browser.run("return [...document.querySelectorAll('" + selector +
                     "')].filter((e) => { const r = document.createRange(); r.selectNodeContents(e); return new "
                     "Set([...r.getClientRects()].map((b) => Math.round(b.top))).size > 1 }).length");
}

TEST_F(Paper, BreaksNoNumberOfATableThatFits) {
  Table wide{"Many columns", {{"method"}}, {{"quasi-newton with sdirk2 and a long name"}}};
  for (int i = 0; i < 12; ++i) {
    wide.columns.push_back({"a quantity of the motion", true});
    wide.rows.front().push_back(i % 2 == 0 ? "8.33e-05" : "31.5");
  }
  open_page(table(wide));
  print();
  EXPECT_EQ(in_lines(*browser_, "td.number"), 0);
  EXPECT_LE(browser_->run("return document.documentElement.scrollWidth").get<int>(), paper_width);
}

TEST_F(Paper, BreaksNoLineWithinAnOptionOrANumber) {
  std::string words, line("drape");
  for (int i = 0; i < 40; ++i) {
    words += "at ε = 1e-05 m ";
    line += " --report out";
  }
  open_page(table({"A table", {{"what"}, {"found"}}, {{"a", words}, {"b", "few"}}}) + command("Again", line) +
            findings({{Tone::good, words}}));
  for (const int width : {360, 390, 500, 1200}) {
    browser_->set_width(width);
    EXPECT_EQ(in_lines(*browser_, ".whole"), 0) << width;
    EXPECT_LE(browser_->run("return document.documentElement.scrollWidth").get<int>(), width);
  }
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.whole').length"), 3 * 40);
  EXPECT_EQ(browser_->run("return document.querySelector('.command code').textContent"), line);
  print();
  EXPECT_EQ(in_lines(*browser_, ".whole"), 0);
}

TEST_F(Paper, KeepsACardsCellTogether) {
  const std::string words = "quasi-newton at ε = 1e-05 m, in 27 steps of 1e-03 s";
  open_page(table({"A table", {{"what"}, {"found in all of it"}}, {{"a", words}}}));
  browser_->set_width(390);
  EXPECT_EQ(browser_->run("return getComputedStyle(document.querySelector('td')).display"), "block");
  EXPECT_EQ(
      browser_->run("const r = document.createRange(), td = document.querySelector('td + td');"
                    "r.selectNodeContents(td); const left = Math.min(...[...r.getClientRects()].map((b) => b.left));"
                    "return left > td.getBoundingClientRect().left + 100"),
      true)
      << "all of it is beside its label";
}

TEST_F(Paper, LeavesDashesOutOfCards) {
  open_page(table({"A table of runs",
                   {{"run"}, {"what was found in it"}, {"time of it", true}},
                   {{"first one", "–", "0"}, {"second one", "some words of it", "–"}}}));
  const char* shown =
      "return [...document.querySelectorAll('td')].filter((e) => e.getClientRects().length).map((e) => "
      "e.textContent).join()";
  browser_->set_width(390);
  EXPECT_EQ(browser_->run(shown), "first one,0,second one,some words of it");
  browser_->set_width(1200);
  EXPECT_EQ(browser_->run(shown), "first one,–,0,second one,some words of it,–");
}

TEST_F(Paper, ShowsSomeMomentsOfAFilm) {
  std::vector<FilmMoment> moments;
  const std::string pixel = encode_png(Image(1, 1));
  for (int k = 0; k < 9; ++k) moments.push_back({"t = " + std::to_string(k), {pixel, pixel}});
  open_page(film("film", {"one", "other"}, moments));
  EXPECT_EQ(seen(".shown-moment"), 2);
  print();
  EXPECT_EQ(seen(".shown-moment"), 8);
  EXPECT_EQ(browser_->run("return document.querySelector('.panels figure').innerText.replace(/\\s+/g, ' ').trim()"),
            "one t = 0 t = 2 t = 5 t = 8");
}

TEST_F(Paper, ShowsTheStillsOfAnAnimation) {
  const std::string pixel = encode_png(Image(1, 1));
  open_page(animation(pixel, pixel, "A cloth"));
  EXPECT_EQ(seen("img[src^=\"data:image/gif\"]"), 1);
  EXPECT_EQ(seen("img[src^=\"data:image/png\"]"), 0);
  print();
  EXPECT_EQ(seen("img[src^=\"data:image/gif\"]"), 0);
  EXPECT_EQ(seen("img[src^=\"data:image/png\"]"), 1);
}

/// Lays the page out in columns of the size of a sheet, which break as sheets do, and returns the column in which each
/// element of a selector begins.
std::vector<int> columns_of(test::Browser& browser, const std::string& selector) {
  return browser.run(
      "document.body.style.cssText = 'width: 688px; height: 980px; max-width: none; margin: 0; column-width: 688px; "
      "column-gap: 12px; column-fill: auto';"
      "return [...document.querySelectorAll('" +
      selector +
      "')].filter((e) => e.getClientRects().length).map((e) => Math.round(e.getClientRects()[0].left / 700))");
}

TEST_F(Paper, FillsItsFirstSheet) {
  std::vector<ComparedPictures> moments(5);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    ComparedPictures& moment = moments[i];
    moment.size = {320, 240};
    moment.name = std::to_string(i);
    moment.caption = "Frame " + moment.name + ": what differs in it.";
    moment.expected = moment.actual = moment.difference = moment.error_map = encode_png(Image(320, 240));
    moment.worst = {{10, 10}};
  }
  // Begins as a check's page does.
  open_page(wide_table() + section(2, "a", "A scene",
                                   findings({{Tone::bad, "It changed."}}) + command("Again", "drape") +
                                       comparison("pictures", moments, 0)));
  print();
  const std::vector<int> columns = columns_of(*browser_, ".moment");
  ASSERT_EQ(columns.size(), 5U);
  EXPECT_EQ(columns[0], 0);
  EXPECT_EQ(columns[2], 0);
}

TEST_F(Paper, KeepsHeadingsWithWhatTheyAreOf) {
  const Markup sentences =
      paragraph("One sentence.") + paragraph("Another, of some length, so that it takes a line or two.");
  for (int filler = 0; filler < 30; ++filler) {
    Markup content;
    for (int i = 0; i < filler; ++i) content += note("A line of what comes before.");
    content += section(2, "a", "Of a diagram", sentences + chart(sample_chart())) +
               section(2, "b", "Of a table", sentences + wide_table());
    open_page(content);
    print();
    const std::vector<int> headings = columns_of(*browser_, "main h2"), charts = columns_of(*browser_, ".chart"),
                           tables = columns_of(*browser_, "main > section > .table");
    EXPECT_EQ(headings.at(0), charts.at(0)) << filler;
    EXPECT_EQ(headings.at(1), tables.at(0)) << filler;
  }
}

TEST_F(Paper, CopiesNothingThatASpreadsheetComputes) {
  open_page(table({"A table", {{"name"}, {"n", true}}, {{"=1+1", "-5"}, {"@SUM(A1)", "-1.5e-3"}, {"a|b", "–"}}}));
  EXPECT_EQ(copied("[data-form=CSV]"), "name,n\n'=1+1,-5\n'@SUM(A1),-1.5e-3\na|b,–\n");
  EXPECT_NE(copied("[data-form=Markdown]").find("| a\\|b | – |"), std::string::npos);
}

TEST_F(Paper, ShowsCardsInANarrowWindow) {
  Table answer{"What to take", {{"error"}, {"below 1 mm"}, {"below 0.1 mm"}}, {}};
  answer.rows = {{"whole [ms per second]", "quasi-newton, accuracy 1e-3: 12.4", "liu13, h = 0.001 s: 40.1"},
                 {"one step [µs]", "liu13, ε = 1e-4: 31.0", ""}};
  open_page(table(answer));
  keep_screenshots("cards");
  browser_->set_width(390);
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('td')].filter((c) => c.textContent && "
                          "c.getBoundingClientRect().right > 390).length"),
            0);
  EXPECT_EQ(browser_->run("return document.querySelector('.scroll').scrollWidth > 390"), false);
  EXPECT_EQ(browser_->run("return getComputedStyle(document.querySelector('td + td'), '::before').content"),
            "\"below 1 mm\"");
  browser_->set_width(1200);
  EXPECT_EQ(browser_->run("return getComputedStyle(document.querySelector('td + td')).display"), "table-cell");
}

TEST_F(Paper, LeavesATableThatFitsANarrowWindowATable) {
  open_page(table({"Small", {{"method"}, {"µs", true}}, {{"liu13", "0.5"}, {"implicit", "12.5"}}}));
  browser_->set_width(390);
  EXPECT_EQ(browser_->run("return getComputedStyle(document.querySelector('td')).display"), "table-cell");
  EXPECT_EQ(browser_->run("const s = document.querySelector('.scroll'); return s.scrollWidth <= s.clientWidth"), true);
}

TEST_F(Paper, LabelsACardsCellsByTheTextOfTheirHeads) {
  const std::string words(30, 'w');
  open_page(
      table({"Runs", {{"run"}, {code("a.b") + " = <2>"}}, {{words, badge("completed", Tone::good) + " and more"}}}));
  browser_->set_width(390);
  EXPECT_EQ(browser_->run("return getComputedStyle(document.querySelector('td + td'), '::before').content"),
            "\"a.b = <2>\"");
  // A cell of several pieces stays beside its label.
  EXPECT_EQ(browser_->run("const td = document.querySelector('td + td');"
                          "return td.children.length === 1 && td.firstElementChild.getBoundingClientRect().left > "
                          "td.getBoundingClientRect().left + 100"),
            true);
}

TEST_F(Paper, HasOneMenuToCopyADiagramOrItsPoints) {
  open_page(chart(sample_chart()));
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.copies').length"), 1);
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('.copies button')].map((b) => b.textContent).join()"),
            "SVG,PNG,CSV,Markdown,LaTeX");
  // A closed block has a layout, but is not painted.
  const auto shown = [&] {
    return browser_->run(
        "return [...document.querySelectorAll('.copies button')].filter((b) => b.checkVisibility()).length");
  };
  EXPECT_EQ(shown(), 0);
  browser_->click(".copies summary");
  EXPECT_EQ(shown(), 5);
  EXPECT_TRUE(copied("[data-form=CSV]").starts_with("Series,step [s],error [m]\nimplicit,1,1\n"))
      << copied("[data-form=CSV]");
  EXPECT_EQ(shown(), 0) << "open after a choice";
  browser_->click(".copies summary");
  browser_->click("h1");
  EXPECT_EQ(shown(), 0) << "open after a click elsewhere";
}

TEST_F(Paper, HasDiagramsAndCommandsAsWideAsItsText) {
  open_page(paragraph(std::string(2000, 'x') + " y") + chart(sample_chart()) + command("Again", "drape"));
  for (const int width : {390, 1200}) {
    browser_->set_width(width);
    EXPECT_EQ(browser_->run("return new Set(['main > p', '.chart', '.chart > svg', '.command'].map((s) => "
                            "Math.round(document.querySelector(s).getBoundingClientRect().width))).size"),
              1)
        << width;
  }
}

TEST_F(Paper, PrintsNoHeadingOfWhatIsNotPrinted) {
  open_page(section(2, "a", "Closed", details("Turn the cloth", paragraph("A player."))) +
            section(2, "b", "Open", paragraph("Text.")));
  EXPECT_EQ(seen("main h2"), 2);
  print();
  EXPECT_EQ(seen("main h2"), 1);
}

TEST_F(Paper, TakesTablesFromTheClipboard) {
  open_page(table({"A table", {{"method"}, {"ε_1, %", true}}, {{"a, \"b\"", "0.5"}}}));
  EXPECT_EQ(copied("[data-form=CSV]"), "method,\"ε_1, %\"\n\"a, \"\"b\"\"\",0.5\n");
  EXPECT_EQ(copied("[data-form=Markdown]"), "| method | ε\\_1, % |\n| --- | ---: |\n| a, \"b\" | 0.5 |\n");
  const std::string latex = copied("[data-form=LaTeX]");
  EXPECT_NE(latex.find("\\begin{tabular}{@{}lr@{}}\n  \\toprule\n  method & $\\varepsilon$\\_1, \\% \\\\\n"),
            std::string::npos)
      << latex;
}

TEST_F(Paper, TakesDiagramsFromTheClipboard) {
  open_page(chart(sample_chart()));
  const std::string svg = copied("[data-form=SVG]");
  EXPECT_NE(svg.find("xmlns=\"http://www.w3.org/2000/svg\""), std::string::npos);
  EXPECT_NE(svg.find("stroke: rgb("), std::string::npos);  // the file has no style sheet
  EXPECT_EQ(svg.find("data-label"), std::string::npos);
}

TEST_F(Paper, TakesPicturesOfDiagramsFromTheClipboard) {
  open_page(chart(sample_chart()));
  browser_->run(
      "Object.defineProperty(navigator, 'clipboard', { configurable: true, value: { write: async ([item]) => {"
      "const picture = await createImageBitmap(await item.getType('image/png'));"
      "window.taken = [picture.width, picture.height] } } }); document.querySelector('[data-form=PNG]').click()");
  nlohmann::json taken;
  for (int tries = 0; taken.is_null() && tries < 100; ++tries) {
    taken = browser_->run("return new Promise((done) => setTimeout(() => done(window.taken ?? null), 50))");
  }
  EXPECT_EQ(taken, browser_->run("const b = document.querySelector('.chart > svg').getBoundingClientRect();"
                                 "return [Math.floor(2 * b.width), Math.floor(2 * b.height)]"));
}

TEST_F(Paper, TakesLatexAsFilesHaveIt) {
  const std::string signs = "\\ ~^&%$#_{}<>|µε∇‖→×·≈°²³−–½…";
  open_page(table({"A table", {{"a"}}, {{signs}}}));
  const std::string copy = copied("[data-form=LaTeX]");
  EXPECT_NE(copy.find("  " + latex(signs) + " \\\\\n"), std::string::npos) << copy;
}

TEST_F(Paper, WrapsTablesForLatexAsFilesDo) {
  ResultTable small{"", "A & b", {"method", "µs"}, {{"liu13", "0.5"}, {"a -- b", "–"}}, {}};
  ResultTable words{"", "Words", {"error", "below 1 mm"}, {}, {}};
  words.rows = {{"whole motion [ms per second of motion]", "quasi-newton with an accuracy of 1e-3 and 12.4 steps"},
                {"one STEP ≤ ‖∇g‖", ""}};
  ResultTable wide{"", "Wide", {"method", "step"}, {{"liu13", "0.1"}, {"liu13", "0.2"}}, {}};
  for (int c = 0; c < 30; ++c) {
    wide.columns.push_back("quantity number " + std::to_string(c));
    for (auto& row : wide.rows) row.push_back("0.123456");
  }
  for (const ResultTable& one : {small, words, wide}) {
    open_page(to_html(one));
    EXPECT_EQ(copied("[data-form=LaTeX]"), to_latex(one));
  }
}

TEST_F(Paper, ShowsEveryComparedPicture) {
  const std::string pixel = encode_png(Image(1, 1));
  ComparedPictures same, other;
  same.name = "0", other.name = "40";
  same.expected = other.expected = other.actual = other.difference = pixel;
  same.size = other.size = {1, 1};
  open_page(comparison("pictures", {same, other}, 1));
  EXPECT_EQ(seen(".moment img"), 3);
  print();
  EXPECT_EQ(seen(".moment img"), 4);
}

TEST_F(Paper, SaysWhichCurveLiesBeneathAnother) {
  open_page(chart(sample_chart()));
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('.legend li')].map((e) => e.textContent).join()"),
            "implicit (beneath liu13),liu13,verlet");
}

// Text boxes have room for descenders, which digits lack.
TEST_F(Paper, LabelsOfAnAxisDoNotCollideInANarrowWindow) {
  Chart long_labels = sample_chart();
  for (ChartSeries& series : long_labels.series) {
    for (ChartPoint& p : series.points) p.x = 1e-4 * (1 + p.x);  // 1, 2, 5 times a power of ten
  }
  open_page(chart(sample_chart()) + chart(long_labels));
  for (const int width : {390, 1200}) {
    browser_->set_width(width);
    EXPECT_EQ(
        browser_->run("let count = 0; for (const svg of document.querySelectorAll('.chart > svg')) {"
                      "const boxes = [...svg.querySelectorAll('text')].filter((t) => t.getClientRects().length)"
                      ".map((t) => t.getBoundingClientRect());"
                      "boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => { if (a.left < b.right && b.left < "
                      "a.right && a.top < b.bottom - 3 && b.top < a.bottom - 3) ++count })) } return count"),
        0)
        << width;
  }
}

}  // namespace
}  // namespace drape::html
