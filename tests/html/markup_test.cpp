#include "reports/page.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "reports/chart.hpp"
#include "reports/components.hpp"
#include "tests/support/files.hpp"

namespace drape::html {
namespace {

TEST(Markup, EscapesTextAndAttributes) {
  EXPECT_EQ(element("p", {{"title", "a\"b"}}, "<script>&'").html(),
            "<p title=\"a&quot;b\">&lt;script&gt;&amp;&#39;</p>");
  EXPECT_EQ(Markup(std::string("a\0b", 3)).html(),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(Markup("\xFF").html(), "\xEF\xBF\xBD");  // a file name need not be UTF-8
}

TEST(Markup, ReplacesWhatIsNotUtf8) {
  const std::string none = "\xEF\xBF\xBD";
  for (const std::string good : {"é", "−", "😀", "\xEF\xBF\xBD"}) EXPECT_EQ(escape(good), good);
  EXPECT_EQ(escape("caf\xe9"), "caf" + none);                        // Latin-1
  EXPECT_EQ(escape("\xc0\xaf!"), none + none + "!");                 // overlong
  EXPECT_EQ(escape("\xed\xa0\x80"), none + none + none);             // half of a surrogate pair
  EXPECT_EQ(escape("\xf4\x90\x80\x80"), none + none + none + none);  // beyond U+10FFFF
  EXPECT_EQ(escape("\xef\xbf\xbe"), none + none + none);             // noncharacter, forbidden in XML
  EXPECT_EQ(escape("\xe2\x88"), none + none);                        // cut off
}

TEST(Markup, IsEscapedOnce) { EXPECT_EQ(element("p", element("b", "<")).html(), "<p><b>&lt;</b></p>"); }

TEST(Markup, LeavesOutAttributesWithoutAValue) {
  EXPECT_EQ(element("input", {{"checked?", ""}, {"hidden?", "hidden"}}).html(), "<input hidden>");
}

TEST(DataUri, HasTheBytesInBase64) {
  // RFC 4648, section 10.
  EXPECT_EQ(data_uri("a/b", "foobar"), "data:a/b;base64,Zm9vYmFy");
  EXPECT_EQ(data_uri("a/b", "foob"), "data:a/b;base64,Zm9vYg==");
  EXPECT_EQ(data_uri("a/b", "f"), "data:a/b;base64,Zg==");
  EXPECT_EQ(data_uri("a/b", "fooba"), "data:a/b;base64,Zm9vYmE=");
  EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
  EXPECT_EQ(data_uri("a/b", std::string("\xff\xef\xbe\0", 4)), "data:a/b;base64,/+++AA==");
}

TEST(Table, RefusesARowThatDoesNotFit) { EXPECT_THROW(table({"t", {{"a"}, {"b"}}, {{"1"}}}), std::invalid_argument); }

TEST(AxisMap, PlacesLinearValuesBetweenRoundTicks) {
  const AxisMap axis(Scale::linear, {0, 100});
  EXPECT_EQ(axis.ticks().front().label, "0");
  EXPECT_EQ(axis.ticks().back().label, "100");
  EXPECT_NEAR(axis.place(50), 0.5, 1e-12);
}

TEST(AxisMap, HasATwentiethOfRoomOnEitherSideOfTheValues) {
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    for (double low = 1; low < 50; low *= 1.13) {
      for (const double factor : {1.5, 4.0, 8.34, 97.0, 1234.0}) {
        const AxisMap axis(scale, {low, factor * low});
        EXPECT_NEAR(axis.place(low), 0.06, 0.0101) << low << " to " << factor * low;
        EXPECT_NEAR(axis.place(factor * low), 0.94, 0.0101) << low << " to " << factor * low;
      }
    }
  }
  const AxisMap time(Scale::linear, {0.02, 8.34});
  EXPECT_DOUBLE_EQ(time.place(0), 0.05) << "at a tick that nobody can tell from there";
  EXPECT_EQ(time.ticks().front().label, "0");
  EXPECT_DOUBLE_EQ(time.place(8.34), 0.95);
  EXPECT_EQ(time.ticks().back().label, "8");
}

TEST(AxisMap, HasThreeTicksAtLeast) {
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    for (const double factor : {1.001, 1.3, 2.0, 3.6, 8.0, 30.0, 1e3, 1e9}) {
      for (const double low : {1.0, 1.9, 3.7, 9.9}) {
        const AxisMap axis(scale, {low, factor * low});
        EXPECT_GE(axis.ticks().size(), 3U) << low << " " << factor;
        for (const AxisMap::Tick& tick : axis.ticks()) {
          EXPECT_GE(tick.place, -1e-9);
          EXPECT_LE(tick.place, 1 + 1e-9);
        }
      }
    }
  }
}

TEST(AxisMap, GivesEveryDecadeTheSameRoom) {
  const AxisMap axis(Scale::logarithmic, {1e-5, 1});
  EXPECT_NEAR(axis.place(1e-5), 0.05, 1e-9);
  EXPECT_NEAR(axis.place(1e-4), 0.05 + 0.9 / 5, 1e-9);
  EXPECT_NEAR(axis.place(1), 0.95, 1e-9);
  EXPECT_EQ(axis.ticks().front().label, "10⁻⁵");
}

TEST(AxisMap, HasTicksOfOneKind) {
  const AxisMap small(Scale::logarithmic, {1e-5, 1}), usual(Scale::logarithmic, {1e-3, 100});
  for (const AxisMap::Tick& tick : small.ticks()) {
    EXPECT_TRUE(tick.label.starts_with("10")) << tick.label;
  }
  for (const AxisMap::Tick& tick : usual.ticks()) {
    EXPECT_EQ(tick.label.find("⁻"), std::string::npos) << tick.label;
  }
}

TEST(AxisMap, WritesNumbersInOneWay) {
  const auto labels = [](double low, double high) {
    std::vector<std::string> texts;
    const AxisMap axis(Scale::linear, {low, high});
    for (const AxisMap::Tick& tick : axis.ticks()) texts.push_back(tick.label);
    return texts;
  };
  using List = std::vector<std::string>;
  EXPECT_EQ(labels(0, 1), (List{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels(-20000, 20000), (List{"−20000", "−10000", "0", "10000", "20000"}));
  EXPECT_EQ(labels(0, 8.34e-6), (List{"0", "2·10⁻⁶", "4·10⁻⁶", "6·10⁻⁶", "8·10⁻⁶"}));
  EXPECT_EQ(labels(0, 3e7), (List{"0", "0.5·10⁷", "1.0·10⁷", "1.5·10⁷", "2.0·10⁷", "2.5·10⁷", "3.0·10⁷"}));
}

TEST(AxisMap, KeepsAPlaceForZeroOnALogarithmicAxis) {
  const AxisMap axis(Scale::logarithmic, {0, 1e-6, 1e-3});
  EXPECT_EQ(axis.place(0), 0.05);
  EXPECT_GT(axis.place(1e-6), 0.1);
  EXPECT_EQ(axis.ticks().front().label, "0");
}

/// Returns the place of a level's label in a chart of one curve: "end" or "start", x and base, and y of its line.
std::array<std::string, 4> place_of_label(const std::vector<std::array<double, 2>>& points, double level) {
  Chart chart{.title = "t", .x_title = "x", .y_title = "y", .series = {}, .levels = {{level, "the limit here"}}};
  chart.series.push_back({"a", {}, false});
  for (const auto& [x, y] : points) chart.series.back().points.push_back({x, y, "", ""});
  const std::string svg = still_chart(chart).drawing.html();
  const std::size_t text = svg.rfind("<text", svg.find("the limit here")), line = svg.find("class=\"level\"");
  const auto attribute = [&](const std::string& name, std::size_t at) {
    const std::size_t begin = svg.find(name + "=\"", at) + name.size() + 2;
    return svg.substr(begin, svg.find('"', begin) - begin);
  };
  return {attribute("text-anchor", text), attribute("x", text), attribute("y", text), attribute("y1", line)};
}

TEST(Chart, PutsNoLabelAcrossACurve) {
  // A curve that is level and then crosses the label's line on the right: the label is left of that.
  const auto usual = place_of_label({{0, 0}, {1, 0}}, 0.5);
  EXPECT_EQ(usual[0], "end");
  const auto crossed = place_of_label({{0, 0}, {0.8, 0}, {0.9, 1}, {1, 0}}, 0.5);
  EXPECT_TRUE(crossed[0] == "start" && std::stod(crossed[1]) < 420) << crossed[1];
  // A curve along the line, just above it: the label is below.
  const auto along = place_of_label({{0, 0.52}, {1, 0.52}, {1, 0}, {1, 1}}, 0.5);
  EXPECT_GT(std::stod(along[2]), std::stod(usual[2])) << along[2];
}

TEST(Chart, PutsNoLabelAcrossItsOwnLine) {
  constexpr double large = 19,
                   capitals = 0.75;  // letters in a narrow window and on paper, and their height above the base
  for (const double level : {0.0, 0.3, 0.9, 1.0}) {
    const auto place = place_of_label({{0, 0}, {1, 0.1}}, level);
    const double base = std::stod(place[2]), line = std::stod(place[3]);
    EXPECT_TRUE(base < line || base - capitals * large > line) << level << ": " << base << " by " << line;
  }
}

TEST(Chart, HasWhatItsAxesHoldInAnyCase) {
  Chart chart{.title = "t", .x_title = "x", .y_title = "y", .series = {}, .levels = {}};
  chart.series.push_back({"a", {{0.4, 0.4, "", ""}, {0.5, 0.5, "", ""}}});
  chart.y_holds = {0, 1};
  const std::string svg = still_chart(chart).drawing.html();
  EXPECT_NE(svg.find(">0<"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">1.0<"), std::string::npos) << svg;
}

TEST(AxisMap, HoldsOneValueOrNone) {
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    for (const std::vector<double>& values : {std::vector<double>{}, {3}, {-INFINITY, NAN, 3, 3}}) {
      const AxisMap axis(scale, values);
      EXPECT_GE(axis.place(3), 0);
      EXPECT_LE(axis.place(3), 3);
      EXPECT_GE(axis.ticks().size(), 2U);
    }
  }
}

/// Returns CIE L*a*b* of a colour such as "#cc4400", as seen by eyes whose cones transform linear RGB by `eyes`.
std::array<double, 3> seen_as(const std::string& color, const std::array<std::array<double, 3>, 3>& eyes) {
  std::array<double, 3> linear{}, seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = std::stoi(color.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    linear[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) seen[i] += eyes[i][j] * linear[j];
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const auto [r, g, b] = seen;
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505), y = f(0.2126 * r + 0.7152 * g + 0.0722 * b),
               z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Machado, Oliveira and Fernandes 2009, severity 1. A difference of 2.3 is just noticeable side by side; thin, separate
// curves need several times that.
TEST(Colours, OfMethodsDifferForColourBlindEyes) {
  constexpr std::array<std::array<double, 3>, 3> protanope{
      {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
  constexpr std::array<std::array<double, 3>, 3> deuteranope{
      {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
  const std::string css = test::content(DRAPE_SOURCE_DIR "/reports/theme.css");
  for (const std::size_t theme : {css.find(":root"), css.rfind(":root")}) {
    std::vector<std::string> colors;
    for (int method = 0; method < 6; ++method) {
      const std::size_t at = css.find("--s" + std::to_string(method) + ": #", theme);
      ASSERT_NE(at, std::string::npos);
      colors.push_back(css.substr(at + 6, 7));
    }
    for (const auto& eyes : {protanope, deuteranope}) {
      for (std::size_t i = 0; i < colors.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const auto a = seen_as(colors[i], eyes), b = seen_as(colors[j], eyes);
          EXPECT_GT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 15) << colors[i] << " " << colors[j];
        }
      }
    }
  }
}

}  // namespace
}  // namespace drape::html
