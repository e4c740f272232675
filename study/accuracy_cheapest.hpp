#pragma once

#include <string>
#include <vector>

#include "figures/result_table.hpp"
#include "study/accuracy.hpp"

namespace drape {

/// A method with a tolerance or a step, its error and its cost.
struct Offer {
  std::string method, at;  ///< "liu13", "ε = 0.001"
  double error = 0;        ///< [m]
  MedianInterval cost;     ///< cost, in the same unit for all offers
};

/// The cheapest offer with an error below a limit, and the cheapest of another method; null if there is none.
struct Cheapest {
  const Offer* first = nullptr;
  const Offer* next = nullptr;
};
Cheapest find_cheapest(const std::vector<Offer>& offers, double limit);

/// Returns the offers of all tolerances, with the error of a single step.
std::vector<Offer> solve_offers(const SceneAccuracy& scene);

/// Returns the study's answer: the cheapest method, its setting and cost, by kind and size of error.
ResultTable answer_table(const SceneAccuracy& scene);

/// Returns the same with the second cheapest method, one row each.
ResultTable cheapest_table(const SceneAccuracy& scene);

/// Returns "The cheapest below 1 mm is liu13 at ε = 0.001 m with 88.1 µs per step; below 0.1 mm it is …"
std::string describe_cheapest(const SceneAccuracy& scene);

}  // namespace drape
