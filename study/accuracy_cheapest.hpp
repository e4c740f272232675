#pragma once

#include <string>
#include <vector>

#include "figures/result_table.hpp"
#include "study/accuracy.hpp"

namespace drape {

/// A method, with its tolerance or its step, that keeps an error below a limit, and what that costs.
struct Offer {
  std::string method, at;  ///< "liu13", "ε = 0.001"
  double error = 0;        ///< [m]
  MedianInterval cost;     ///< in the same unit for all
};

/// The cheapest offer whose error is below the limit, and the cheapest of another method; null where there is none.
struct Cheapest {
  const Offer* first = nullptr;
  const Offer* next = nullptr;
};
Cheapest find_cheapest(const std::vector<Offer>& offers, double limit);

/// What the tolerances offer for the error of a step.
std::vector<Offer> solve_offers(const SceneAccuracy& scene);

/// The answer of the study: by kind of error, and by how large it may be, the method to take, its setting and its cost.
ResultTable answer_table(const SceneAccuracy& scene);

/// The same with the next best, a line each.
ResultTable cheapest_table(const SceneAccuracy& scene);

/// "The cheapest below 1 mm is liu13 at ε = 0.001 m with 88.1 µs per step; below 0.1 mm it is …"
std::string describe_cheapest(const SceneAccuracy& scene);

}  // namespace drape
