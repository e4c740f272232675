#include "study/accuracy_report.hpp"

#include <gtest/gtest.h>

#include "tests/study/invented_study.hpp"

namespace drape {
namespace {

TEST(Cheapest, IsTheLeastCostlyBelowTheLimitAndTheNextIsOfAnotherMethod) {
  const std::vector<Offer> offers{{"a", "1", 1e-2, {1, 1, 1}},
                                  {"a", "2", 1e-4, {5, 5, 5}},
                                  {"a", "3", 1e-5, {6, 6, 6}},
                                  {"b", "1", 1e-4, {7, 7, 7}},
                                  {"b", "2", 1e-7, {9, 9, 9}}};
  EXPECT_EQ(find_cheapest(offers, 1e-3).first, &offers[1]);
  EXPECT_EQ(find_cheapest(offers, 1e-3).next, &offers[3]);
  EXPECT_EQ(find_cheapest(offers, 1e-6).first, &offers[4]);
  EXPECT_EQ(find_cheapest(offers, 1e-6).next, nullptr);
  EXPECT_EQ(find_cheapest(offers, 1e-9).first, nullptr);
  // A tighter tolerance with the same iterations is not cheaper, whatever the measured times.
  const std::vector<Offer> same{{"a", "1", 1e-4, {5, 5, 5}}, {"a", "2", 1e-4, {4, 4, 4}}};
  EXPECT_EQ(find_cheapest(same, 1e-3).first, &same[0]);
}

// For the invented runs: with an accuracy of 1e-4 m Newton's method reaches 50 µm in 90 ms; Verlet 0.4 mm in 5 ms.
TEST(Cheapest, IsTheAnswerOfTheStudy) {
  const StudyReport report = accuracy_report(test::invented_study());
  ASSERT_TRUE(report.answer);
  ASSERT_EQ(report.answer->tables.size(), 2U) << "one for each scene";
  const ResultTable& answer = report.answer->tables.front();
  EXPECT_EQ(answer.columns,
            (std::vector<std::string>{"error", "below 1 mm", "below 0.1 mm", "below 10 µm", "below 1 µm"}));
  EXPECT_EQ(answer.rows.front(),
            (std::vector<std::string>{"whole, at 0.2 s [ms per second of motion]", "verlet, h = 0.01 s: 5.00",
                                      "implicit, accuracy = 0.0001 m: 90.0", "none of those run",
                                      "unknown: the reference is not accurate enough"}));
  EXPECT_EQ(first_answer(test::invented_study().scenes.front()),
            "Below 1 mm, verlet at h = 0.01 s costs least: 5.00 ms per second of motion (whole, at 0.2 s)");
  const std::string page = to_page(report);
  EXPECT_LT(page.find("What to take"), page.find(">Findings<"));
}

}  // namespace
}  // namespace drape
