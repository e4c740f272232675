#include "study/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape {
namespace {

html::Chart chart() {
  html::Chart c;
  c.title = "It's \"quoted\" \\ and 100 % ε";
  c.x_title = "x";
  c.y_title = "y";
  c.y_scale = html::Scale::logarithmic;
  c.series = {{"first", {{1, 10, "", ""}, {2, 100, "", ""}}}, {"second", {{1, 20, "", ""}, {3, 5, "", ""}}, false}};
  c.levels = {{50, "limit"}};
  return c;
}

class Gnuplot : public test::InScratchFolder {};

TEST_F(Gnuplot, DrawsBothFilesFromItsOwn) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot";
  EXPECT_EQ(write_plot(chart(), folder_, "plot"), "");
  EXPECT_NE(test::content(path("plot.svg")).find("<svg"), std::string::npos);
  EXPECT_TRUE(test::content(path("plot.png")).starts_with("\x89PNG"));
  // All four points are in the picture: the path of each series has its points.
  EXPECT_NE(test::content(path("plot.svg")).find("second"), std::string::npos);
  // Again by hand, as the folder is meant to be used.
  std::filesystem::remove(path("plot.svg"));
  EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && gnuplot plot.gp").c_str()), 0);
  EXPECT_TRUE(std::filesystem::exists(path("plot.svg")));
}

TEST_F(Gnuplot, IsSaidToBeMissingWhereItIs) {
  const std::string kept = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const std::string problem = write_plot(chart(), folder_, "plot");
  setenv("PATH", kept.c_str(), 1);
  EXPECT_NE(problem.find("apt-get install gnuplot-nox"), std::string::npos) << problem;
  EXPECT_NE(test::content(path("plot.csv")).find("\"second\",3,5"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(path("plot.gp")));
}

}  // namespace
}  // namespace drape
