#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "drape/core/error.hpp"
#include "reports/chart.hpp"
#include "reports/diagram_files.hpp"
#include "reports/latex.hpp"
#include "reports/result_table.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

// Figures and tables of articles.

namespace drape {
namespace {

NamedChart sample_chart() {
  NamedChart named;
  named.name = "plot";
  named.chart = {.title = "Error against time, a title that an article replaces by its caption",
                 .x_title = "µs per step",
                 .y_title = "error [m]",
                 .x_scale = html::Scale::logarithmic,
                 .y_scale = html::Scale::logarithmic,
                 .series = {},
                 .levels = {{0.2, "reference"}}};
  for (const char* method : {"liu13", "implicit"}) {
    html::ChartSeries series = method_series(method);
    for (int i = 0; i < 5; ++i) series.points.push_back({10.0 + i, std::pow(0.5, i), "", ""});
    named.chart.series.push_back(std::move(series));
  }
  named.chart.series[1].points[2] = {NAN, NAN, "", ""};  // a gap
  return named;
}

double inches(const char* text) {
  const std::string length = text;
  EXPECT_TRUE(length.ends_with("in")) << length;
  return std::stod(length);
}

TEST(PaperFigure, HasTheWidthOfAColumnNoTitleAndASerif) {
  for (const FigureStyle style : {FigureStyle::paper, FigureStyle::paper_wide}) {
    const double width = paper_width(style);
    const std::string svg = html::paper_file(html::paper_chart(sample_chart().chart, width), width);
    tinyxml2::XMLDocument xml;
    ASSERT_EQ(xml.Parse(svg.c_str()), tinyxml2::XML_SUCCESS);
    EXPECT_DOUBLE_EQ(inches(xml.RootElement()->Attribute("width")), width);
    EXPECT_EQ(svg.find("class=\"heading\""), std::string::npos);
    EXPECT_NE(svg.find("Nimbus Roman"), std::string::npos);
    EXPECT_NE(svg.find(">error [m]<"), std::string::npos);
    EXPECT_NE(svg.find("rotate(-90)"), std::string::npos);
    EXPECT_EQ(svg.find("var("), std::string::npos);
  }
}

TEST(PaperFigure, KeepsTheFontSizeOfADrawingThatItScales) {
  html::Diagram half =
      html::still_chart(sample_chart().chart);  // 640 pixels wide, scaled to 3.3 in: 316.8 pixels, less margins
  const std::string svg = html::paper_file(half, 3.3);
  std::smatch scale, size;
  ASSERT_TRUE(std::regex_search(svg, scale, std::regex("scale\\((0\\.[0-9]+)\\)\" class=\"scaled\"")));
  ASSERT_TRUE(std::regex_search(svg, size, std::regex("\\.scaled text \\{ font-size: ([0-9.]+)px")));
  EXPECT_NEAR(std::stod(scale[1]) * std::stod(size[1]) * 72 / 96, 8, 0.01);
}

/// Files in the style of an article; skipped without the libraries that draw them.
class PaperFiles : public test::InScratchFolder {
 protected:
  void SetUp() override {
    try {
      const SvgPrinter printer;
    } catch (const OutputError& error) {
      GTEST_SKIP() << error.what();
    }
    ASSERT_EQ(write_chart(sample_chart(), folder_, FigureStyle::paper), "");
  }

  /// Compiles a document in the folder and returns its log.
  std::string log_of(const std::string& body, const std::string& packages) {
    put(path("paper.tex"),
        "\\documentclass[10pt]{article}\n" + packages + "\\begin{document}\n" + body + "\\end{document}\n");
    const int code = std::system(
        ("cd '" + folder_.string() + "' && pdflatex -interaction=nonstopmode -halt-on-error paper.tex >/dev/null 2>&1")
            .c_str());
    EXPECT_EQ(code, 0) << test::content(path("paper.log"));
    return test::content(path("paper.log"));
  }

  static bool has_package(const std::string& file) {
    return std::system(("kpsewhich " + file + " >/dev/null 2>&1").c_str()) == 0;
  }
};

TEST_F(PaperFiles, AreVectorsAndDataAndNoPixels) {
  EXPECT_FALSE(std::filesystem::exists(path("plot.png")));
  const std::string pdf = test::content(path("plot.pdf"));
  EXPECT_EQ(pdf.find("/Subtype /Image"), std::string::npos);
  std::smatch box;
  ASSERT_TRUE(std::regex_search(pdf, box, std::regex("/MediaBox \\[ ?0 0 ([0-9.]+) ([0-9.]+)")));
  EXPECT_NEAR(std::stod(box[1]), 3.3 * 72, 0.5);
  EXPECT_EQ(test::content(path("plot.dat")),
            "x0 y0 x1 y1\n10 1 10 1\n11 0.5 11 0.5\n12 0.25 nan nan\n13 0.125 13 0.125\n14 0.0625 14 0.0625\n");
}

TEST_F(PaperFiles, CompileWithPgfplots) {
  if (!has_package("pgfplots.sty")) GTEST_SKIP() << "pgfplots is not installed";
  const std::string log = log_of("\\noindent\\begin{minipage}{3.4in}\\input{plot.tikz.tex}\\end{minipage}\n",
                                 "\\usepackage{pgfplots}\n\\pgfplotsset{compat=1.18}\n");
  EXPECT_EQ(log.find("Overfull"), std::string::npos) << log;
  EXPECT_EQ(log.find("Package pgfplots Warning"), std::string::npos) << log;
  EXPECT_NE(log.find("Output written"), std::string::npos);
}

std::vector<ResultTable> tables() {
  ResultTable wide{"wide",
                   "Methods and tolerances: 14 columns",
                   {"method", "ε [m]", "iterations", "capped steps", "µs per step", "from", "to", "runs", "set-up [µs]",
                    "solve: max [m]", "RMS [m]", "‖∇g‖, relative", "motion at 0.2 s [m]", "flipped pairs"},
                   {},
                   {"A note & more."}};
  for (int i = 0; i < 3; ++i) {
    wide.rows.push_back({"quasi-newton, accuracy 1e-3"});
    for (std::size_t c = 1; c < wide.columns.size(); ++c) wide.rows.back().push_back("0.000123");
  }
  ResultTable words{"words",
                    "What to take",
                    {"error", "below 1 mm", "below 0.1 mm, WWWW MMMM %%%%"},
                    {{"whole motion [ms per second of motion]", "quasi-newton with accuracy = 1e-3: 12.4",
                      "liu13 with h = 0.001 s: 40.1 (ε = 10⁻⁷)"},
                     {"one step", "–", "semi-implicit <exact> → |WWWWWMMMMMmmmmm@@@@@@%%%%|"}},
                    {}};
  ResultTable small{"small", "Two columns", {"n", "name"}, {{"1", "a"}, {"-2.5", "b_c"}}, {}};
  ResultTable huge{"huge", "More than a page", {"run"}, {{"1"}}, {}};
  for (int c = 0; c < 40; ++c) {
    huge.columns.push_back("key.number_" + std::to_string(c));
    huge.rows.front().push_back("0.123456789");
  }
  return {wide, words, small, huge};
}

TEST_F(PaperFiles, TablesFitTheirColumn) {
  if (!has_package("booktabs.sty")) GTEST_SKIP() << "booktabs is not installed";
  std::string body;
  for (const ResultTable& table : tables()) {
    const std::string latex = to_latex(table);
    const bool narrow = latex.find("fits a column") != std::string::npos;
    put(path(table.name + ".tex"), latex);
    body += "\\noindent\\begin{minipage}{" + std::string(narrow ? "3.3in" : "7in") + "}\\input{" + table.name +
            ".tex}\\end{minipage}\n\n";
  }
  const std::string log =
      log_of(body, "\\usepackage{array,booktabs}\n\\setlength{\\textwidth}{7in}\n\\setlength{\\hoffset}{-1in}\n");
  EXPECT_EQ(log.find("Overfull \\hbox"), std::string::npos) << log;
}

TEST(LatexTable, WrapsOnlyWhereItMust) {
  const std::vector<ResultTable> all = tables();
  EXPECT_NE(to_latex(all[2]).find("\\begin{tabular}{@{}rl@{}}"), std::string::npos) << to_latex(all[2]);
  EXPECT_NE(to_latex(all[1]).find(">{\\raggedright\\arraybackslash{}}p{"), std::string::npos) << to_latex(all[1]);
  EXPECT_NE(to_latex(all[0]).find("fits a page of 7 in"), std::string::npos);
}

TEST(LatexTable, RepeatsTheLeadingColumnsInEveryPart) {
  const std::string latex = to_latex(tables()[3]);
  std::size_t parts = 0, heads = 0;
  for (std::size_t at = 0; (at = latex.find("\\begin{tabular}", at)) != std::string::npos; ++at) ++parts;
  for (std::size_t at = 0; (at = latex.find("\n  run & ", at)) != std::string::npos; ++at) ++heads;
  EXPECT_GT(parts, 1U);
  EXPECT_EQ(heads, parts);
  for (int c = 0; c < 40; ++c) {
    EXPECT_NE(latex.find(html::latex("key.number_" + std::to_string(c))), std::string::npos) << c;
  }
}

TEST(Pgfplots, IncludesHeldPointsLevelsAndNames) {
  NamedChart named = sample_chart();
  named.chart.x_holds = {1, 2};
  named.chart.series[0].name = "a_b & c";
  const std::string picture = pgfplots_picture(named, 3.3);
  EXPECT_NE(picture.find("xmode=log"), std::string::npos);
  EXPECT_NE(picture.find("width=3.3in"), std::string::npos);
  EXPECT_NE(picture.find("\\addlegendentry{a\\_b \\& c}"), std::string::npos);
  EXPECT_NE(picture.find("(1,"), std::string::npos);
  EXPECT_NE(picture.find("reference"), std::string::npos);
}

}  // namespace
}  // namespace drape
