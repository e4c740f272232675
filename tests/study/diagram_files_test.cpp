#include "reports/diagram_files.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <opencv2/core.hpp>

#include "drape/core/error.hpp"
#include "reports/chart.hpp"
#include "study/stability_map.hpp"
#include "tests/support/files.hpp"
#include "tests/support/read_picture.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape {
namespace {

NamedChart sample() {
  NamedChart named;
  named.name = "plot";
  named.chart.title = "It's \"quoted\" \\ <b>&amp; and 100 % ε";
  named.chart.x_title = "x, y";
  named.chart.y_title = "y \"[m]\"";
  named.chart.y_scale = html::Scale::logarithmic;
  html::ChartSeries first = method_series("liu13"), second = method_series("liu13, \"<report>\"");
  first.points = {{1, 10, "", ""}, {NAN, NAN, "", ""}, {2, 100, "", "", {{1.5, 2.5}}}};
  second.points = {{1, 20, "", ""}, {3, 5, "", ""}};
  named.chart.series = {first, second};
  named.chart.levels = {{50, "limit & more"}};
  return named;
}

std::string sample_svg() { return html::svg_file(html::still_chart(sample().chart)); }

/// Returns the texts of an element and its descendants, in order.
std::vector<std::string> texts(const tinyxml2::XMLElement& element) {
  std::vector<std::string> all;
  if (std::string(element.Name()) == "text") all.emplace_back(element.GetText());
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::vector<std::string> inner = texts(*child);
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

TEST(DiagramFile, IsXmlWithEveryWordAndNoVariables) {
  const std::string svg = sample_svg();
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(svg.c_str()), tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement& root = *xml.RootElement();
  EXPECT_STREQ(root.Name(), "svg");
  EXPECT_STREQ(root.Attribute("xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_EQ(svg.find("var("), std::string::npos);
  const std::vector<std::string> found = texts(root);
  for (const std::string& words : {sample().chart.title, sample().chart.x_title, sample().chart.y_title,
                                   std::string("liu13, \"<report>\""), std::string("limit & more")}) {
    EXPECT_EQ(std::count(found.begin(), found.end(), words), 1) << words;
  }
}

TEST(DiagramFile, GivesAMethodItsColourAndSignWhateverElseIsShown) {
  const html::ChartSeries alone = method_series("quasi-newton"), report = method_series("quasi-newton, report");
  EXPECT_EQ(alone.style, report.style);
  EXPECT_FALSE(alone.other);
  EXPECT_TRUE(report.other);
  EXPECT_NE(alone.style, method_series("liu13").style);
  EXPECT_NE(method_series("implicit").style, method_series("semi-implicit").style);
}

TEST(DiagramFile, HasItsPointsAsCsv) {
  EXPECT_EQ(to_csv(points_table(sample())),
            "series,\"x, y\",\"y \"\"[m]\"\"\",from,to\n"
            "liu13,1,10,,\n"
            "liu13,2,100,1.5,2.5\n"
            "\"liu13, \"\"<report>\"\"\",1,20,,\n"
            "\"liu13, \"\"<report>\"\"\",3,5,,\n");
}

TEST(DiagramFile, NamesThePlacesOfAnAxisWithoutNumbers) {
  NamedChart named = sample();
  named.chart.x_names = {"left", "middle", "right", "top"};
  EXPECT_NE(to_csv(points_table(named)).find("\nliu13,middle,10,,\nliu13,right,100,"), std::string::npos)
      << to_csv(points_table(named));
}

TEST(DiagramFile, HasAllItsPointsAsCsvAndNotTooManyForAText) {
  NamedChart many = sample();
  many.chart.series[0].points.clear();
  for (int i = 0; i < 1001; ++i) many.chart.series[0].points.push_back({static_cast<double>(i), 1, "", ""});
  const test::ScratchFolder folder;
  write_chart(many, folder.path());
  const auto lines = [&](const char* form) {
    const std::string text = test::content(folder.path() / (std::string("plot") + form));
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(".csv"), 1 + 1001 + 2);
  EXPECT_LT(lines(".tex"), 220);
  EXPECT_GT(lines(".tex"), 150);
  const std::string markdown = test::content(folder.path() / "plot.md");
  for (const char* end : {"| liu13 | 0 | 1 |", "| liu13 | 1000 | 1 |"}) {
    EXPECT_NE(markdown.find(end), std::string::npos) << end;
  }
  EXPECT_NE(markdown.find("all of them are in plot.csv"), std::string::npos);
}

TEST(DiagramFile, OfAStabilityMapHasItsCellsAsATable) {
  StabilityMap map;
  map.steps = {0.01, 0.1};
  map.stiffnesses = {100, 1e6};
  map.limits = {1, 0.01};
  map.cells = {{0.01, 100, StabilityOutcome::stable, 0.0123, 0},
               {0.1, 100, StabilityOutcome::not_converged, 0.5, 3},
               {0.01, 1e6, StabilityOutcome::converged, 0.2, 0},
               {0.1, 1e6, StabilityOutcome::blown_up, 7, 0}};
  const ResultTable table = map_table(map);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"stiffness of the springs [N/m]", "0.01 s", "0.1 s"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"100", "0.012", "0.5*"}, {"1e+06", "0.2", "×"}}));
}

TEST(SvgPrinter, ThatIsMissingSaysWhatToInstall) {
  for (std::size_t i = 0; i < SvgPrinter::library_names().size(); ++i) {
    std::vector<std::string> names = SvgPrinter::library_names();
    names[i] = "libthatisnotthere.so.1";
    try {
      const SvgPrinter printer(names);
      FAIL() << "no error";
    } catch (const OutputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("libthatisnotthere.so.1"), std::string::npos) << message;
      EXPECT_NE(message.find(std::string("apt-get install ") + SvgPrinter::packages()), std::string::npos) << message;
    }
  }
}

/// Tests that draw; skipped without the libraries.
class Printed : public test::InScratchFolder {
 protected:
  void SetUp() override {
    try {
      printer_ = std::make_unique<SvgPrinter>();
    } catch (const OutputError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  /// Returns true if there is a font, without which text is not drawn.
  [[nodiscard]] bool has_font() const { return printer_->pdf(sample_svg()).find("/FontFile") != std::string::npos; }

  std::unique_ptr<SvgPrinter> printer_;
};

TEST_F(Printed, PngHasTwiceTheSizeAndItsText) {
  const std::string svg = sample_svg();
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(svg.c_str()), tinyxml2::XML_SUCCESS);
  const cv::Mat picture = test::decoded_picture(printer_->png(svg, 2));
  EXPECT_EQ(picture.cols, 2 * xml.RootElement()->IntAttribute("width"));
  EXPECT_EQ(picture.rows, 2 * xml.RootElement()->IntAttribute("height"));
  const auto inked = [](const cv::Mat& image) {
    return std::count_if(image.begin<cv::Vec3b>(), image.end<cv::Vec3b>(),
                         [](const cv::Vec3b& pixel) { return pixel[0] < 128 || pixel[1] < 128 || pixel[2] < 128; });
  };
  // Removes the text by renaming every text element to one that is not drawn.
  std::string mute = svg;
  for (std::size_t at = 0; (at = mute.find("text", at)) != std::string::npos; at += 4) {
    if (mute[at - 1] == '<' || mute[at - 1] == '/') mute.replace(at, 4, "desc");
  }
  const auto without = inked(test::decoded_picture(printer_->png(mute, 2)));
  EXPECT_GT(without, 1000);
  if (!has_font()) GTEST_SKIP() << "no font";
  EXPECT_GT(inked(picture), without + 2000);
}

TEST_F(Printed, PdfIsAVersionThatEveryLatexTakesAndHasItsFonts) {
  const std::string pdf = printer_->pdf(sample_svg());
  EXPECT_TRUE(pdf.starts_with("%PDF-1.4"));
  EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  if (!has_font()) GTEST_SKIP() << "no font";
  EXPECT_NE(pdf.find("/Type /Font"), std::string::npos);
  EXPECT_EQ(pdf.find("/Subtype /Image"), std::string::npos);  // vector graphics only
}

TEST_F(Printed, RefusesWhatIsNoSvg) { EXPECT_THROW(static_cast<void>(printer_->pdf("<svg")), OutputError); }

TEST_F(Printed, DiagramIsThereInEveryFormat) {
  const std::string name = "x';system(\"touch pwned\");#";
  EXPECT_EQ(write_diagram(html::still_chart(sample().chart), folder_, name), "");
  EXPECT_EQ(test::content(path(name + ".svg")), sample_svg());
  EXPECT_TRUE(test::content(path(name + ".pdf")).starts_with("%PDF"));
  EXPECT_TRUE(test::content(path(name + ".png")).starts_with("\x89PNG"));
  EXPECT_EQ(file_count(), 3U);
}

}  // namespace
}  // namespace drape
