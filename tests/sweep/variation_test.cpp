#include "sweep/request.hpp"

#include <gtest/gtest.h>

#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

using Values = std::vector<std::string>;
using test::usage_error;

TEST(Values, AreSplitAtCommasOutsideOfBracketsAndQuotes) {
  EXPECT_EQ(parse_values("liu13,implicit"), (Values{"liu13", "implicit"}));
  EXPECT_EQ(parse_values("{ grid = [4, 4] },{ grid = [8, 8] }"), (Values{"{ grid = [4, 4] }", "{ grid = [8, 8] }"}));
  EXPECT_EQ(parse_values("\"a,b\",c"), (Values{"\"a,b\"", "c"}));
  EXPECT_EQ(parse_values(R"("a\"b,c",d)"), (Values{R"("a\"b,c")", "d"}));
  EXPECT_EQ(parse_values(R"("a\\",b)"), (Values{R"("a\\")", "b"}));
  EXPECT_EQ(parse_values(R"('a\',b)"), (Values{R"('a\')", "b"}));
}

TEST(Values, OfARangeHaveBothEnds) {
  EXPECT_EQ(parse_values("10..80/8"), (Values{"10", "20", "30", "40", "50", "60", "70", "80"}));
  EXPECT_EQ(parse_values("1e-1..1e-6/6log"), (Values{"0.1", "0.01", "0.001", "0.0001", "1e-05", "1e-06"}));
  EXPECT_EQ(parse_values("-1..1/3,7"), (Values{"-1", "0", "1", "7"}));
  EXPECT_EQ(parse_values("-0.1..0.2/4"), (Values{"-0.1", "0", "0.1", "0.2"}));
  EXPECT_EQ(parse_values("1e308..-1e308/5"), (Values{"1e+308", "5e+307", "0", "-5e+307", "-1e+308"}));
}

TEST(Values, OfARangeAreWholeNumbersWithoutExponent) {
  EXPECT_EQ(parse_values("10000..30000/3"), (Values{"10000", "20000", "30000"}));
  EXPECT_EQ(parse_values("-1e6..1e6/5"), (Values{"-1000000", "-500000", "0", "500000", "1000000"}));
  EXPECT_EQ(parse_values("1e4..1e6/3log"), (Values{"10000", "100000", "1000000"}));
  EXPECT_EQ(parse_values("1e12..3e12/3")[1], "2e+12");
}

TEST(Values, OfARangeHaveTheDigitsThatMeanSomething) {
  EXPECT_EQ(parse_values("10..400/5log"), (Values{"10", "25.15", "63.25", "159.1", "400"}));
  EXPECT_EQ(parse_values("1.23456789..2.23456789/3"), (Values{"1.23456789", "1.735", "2.23456789"}));
  const Values close = parse_values("100..100.01/5");
  EXPECT_EQ(close, (Values{"100", "100.0025", "100.005", "100.0075", "100.01"}));
}

TEST(Values, ThatOnlyLookLikeARangeAreNone) {
  EXPECT_EQ(parse_values("../mesh.obj"), (Values{"../mesh.obj"}));
  EXPECT_EQ(parse_values("a..b/3"), (Values{"a..b/3"}));
  for (const char* wrong : {"1..2", "1..2/1", "1..2/2.5", "1..x/3", "1../3", "1..2/200000"}) {
    EXPECT_NE(usage_error([&] { parse_values(wrong); }).find("FROM..TO/COUNT"), std::string::npos) << wrong;
  }
  EXPECT_NE(usage_error([] { parse_values("0..1/3log"); }).find("above 0"), std::string::npos);
}

TEST(Variation, IsNamedInWhatIsWrongWithIt) {
  EXPECT_EQ(as_varied("--set a.b=1: no\n--set a.b=2: no\nx.toml:1:1: no", {"a.b=1"}),
            "--vary a.b=1: no\n--set a.b=2: no\nx.toml:1:1: no");
  EXPECT_EQ(as_varied("m.drape differs:\na.b: 1, and 2 in --set", {"a.b=2"}),
            "m.drape differs:\na.b: 1, and 2 in --vary");
}

TEST(Combinations, AreTheProductInWhichTheLastChangesFastest) {
  const std::vector<Variation> varied{parse_variation("a=1,2"), parse_variation("b=x,y,z")};
  const std::vector<Values> all = combinations(varied);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[0], (Values{"1", "x"}));
  EXPECT_EQ(all[1], (Values{"1", "y"}));
  EXPECT_EQ(all[5], (Values{"2", "z"}));
  EXPECT_EQ(overrides_of(varied, all[5]), (Values{"a=2", "b=z"}));
  EXPECT_EQ(combinations({}).size(), 1U);
}

TEST(Combinations, AreZippedWhereKeysHaveAsManyValues) {
  const std::vector<Variation> varied{parse_variation("a=1,2"), parse_variation("b=x,y")};
  EXPECT_EQ(combinations(varied, true), (std::vector<Values>{{"1", "x"}, {"2", "y"}}));
  EXPECT_EQ(usage_error([] {
              combinations({parse_variation("a=1,2"), parse_variation("b=x")}, true);
            }),
            "--zip pairs values: a has 2 of them, b has 1");
}

TEST(Combinations, ThatNobodyCanRunAreRefused) {
  const Variation many = parse_variation("a=1..1000/1000");
  EXPECT_NE(usage_error([&] { combinations({many, many}); }).find("100000"), std::string::npos);
}

}  // namespace
}  // namespace drape
