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

TEST(Markup, ReplacesWhatIsNotUtf8) {
  const std::string none = "\xEF\xBF\xBD";
  for (const std::string good : {"é", "−", "😀", "\xEF\xBF\xBD"}) EXPECT_EQ(escape(good), good);
  EXPECT_EQ(escape("caf\xe9"), "caf" + none);                        // Latin-1
  EXPECT_EQ(escape("\xc0\xaf!"), none + none + "!");                 // overlong
  EXPECT_EQ(escape("\xed\xa0\x80"), none + none + none);             // half of a surrogate pair
  EXPECT_EQ(escape("\xf4\x90\x80\x80"), none + none + none + none);  // beyond U+10FFFF
  EXPECT_EQ(escape("\xef\xbf\xbe"), none + none + none);             // no character, which XML forbids
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
  const AxisMap axis(Scale::linear, {0, 97});
  EXPECT_EQ(axis.ticks().front().label, "0");
  EXPECT_EQ(axis.ticks().back().label, "100");
  EXPECT_NEAR(axis.place(50), 0.5, 1e-12);
}

TEST(AxisMap, EndsWhereTheValuesEndOrAtATickThatIsNear) {
  const AxisMap time(Scale::linear, {0.02, 8.34});
  EXPECT_EQ(time.place(0), 0);
  EXPECT_EQ(time.ticks().front().label, "0");
  EXPECT_EQ(time.place(8.34), 1);
  EXPECT_EQ(time.ticks().back().label, "8");
  const AxisMap cost(Scale::logarithmic, {1.2, 35});
  EXPECT_EQ(cost.place(1), 0);
  EXPECT_EQ(cost.place(35), 1);
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
