#include "html/markup.hpp"

#include <gtest/gtest.h>

#include "html/chart_axis.hpp"
#include "html/components.hpp"

namespace drape::html {
namespace {

TEST(Markup, EscapesTextAndAttributes) {
  EXPECT_EQ(element("p", {{"title", "a\"b"}}, "<script>&'").html(),
            "<p title=\"a&quot;b\">&lt;script&gt;&amp;&#39;</p>");
  EXPECT_EQ(Markup(std::string("a\0b", 3)).html(),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(Markup("\xFF").html(), "\xEF\xBF\xBD");  // the name of a file need not be UTF-8
}

TEST(Markup, IsEscapedOnce) { EXPECT_EQ(element("p", element("b", "<")).html(), "<p><b>&lt;</b></p>"); }

TEST(Markup, LeavesOutAttributesWithoutAValue) {
  EXPECT_EQ(element("input", {{"checked?", ""}, {"hidden?", "hidden"}}).html(), "<input hidden>");
}

TEST(DataUri, HasTheBytesInBase64) {
  // RFC 4648, section 10.
  EXPECT_EQ(data_uri("a/b", "foobar"), "data:a/b;base64,Zm9vYmFy");
  EXPECT_EQ(data_uri("a/b", "foob"), "data:a/b;base64,Zm9vYg==");
  EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
}

TEST(Table, RefusesARowThatDoesNotFit) { EXPECT_THROW(table({"t", {{"a"}, {"b"}}, {{"1"}}}), std::invalid_argument); }

TEST(AxisMap, PlacesLinearValuesBetweenRoundTicks) {
  const AxisMap axis(Scale::linear, {0, 97});
  EXPECT_EQ(axis.ticks().front().label, "0");
  EXPECT_EQ(axis.ticks().back().label, "100");
  EXPECT_NEAR(axis.place(50), 0.5, 1e-12);
}

TEST(AxisMap, GivesEveryDecadeTheSameRoom) {
  const AxisMap axis(Scale::logarithmic, {1e-5, 1});
  EXPECT_NEAR(axis.place(1e-5), 0, 1e-9);
  EXPECT_NEAR(axis.place(1e-4), 0.2, 1e-9);
  EXPECT_NEAR(axis.place(1), 1, 1e-9);
  EXPECT_EQ(axis.ticks().front().label, "10⁻⁵");
}

TEST(AxisMap, KeepsAPlaceForZeroOnALogarithmicAxis) {
  const AxisMap axis(Scale::logarithmic, {0, 1e-6, 1e-3});
  EXPECT_EQ(axis.place(0), 0);
  EXPECT_GT(axis.place(1e-6), 0.05);
  EXPECT_EQ(axis.ticks().front().label, "0");
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

}  // namespace
}  // namespace drape::html
