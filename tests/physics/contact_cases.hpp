#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "sim/effects/gravity.hpp"
#include "sim/effects/response.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {

/// A method, and how a surface's push enters its steps.
struct ContactCase {
  NamedMethod method;
  Response response;
};
inline std::string response_name(Response response) {
  return response == Response::explicit_force ? "explicit" : "implicit";
}
inline void PrintTo(const ContactCase& c, std::ostream* out) {
  *out << c.method.name << " " << response_name(c.response);
}

inline std::vector<ContactCase> contact_cases() {
  std::vector<ContactCase> all;
  for (const NamedMethod& method : all_methods) {
    all.push_back({method, Response::explicit_force});
    if (!method.is_explicit()) all.push_back({method, Response::implicit_energy});
  }
  return all;
}

/// Ends the name of a parametrised test with the method's and the response's.
inline std::string contact_case_name(const testing::TestParamInfo<ContactCase>& info) {
  return std::string(info.param.method.name) + "_" + response_name(info.param.response);
}

/// A cloth under gravity, solved to convergence, so that only the physics is left.
inline SimulationSettings contact_settings(const ContactCase& how, Cloth cloth, double step) {
  SimulationSettings result = setup(std::move(cloth), how.method, step);
  result.integrator.tolerance = 1e-13;
  result.integrator.max_iterations = 2000;
  result.effects = {Gravity{}};
  return result;
}

/// Vertices that no spring joins, of masses from 0.5 to 2 kg.
inline Cloth loose(const Vertices& positions) {
  Cloth cloth;
  cloth.positions = positions;
  cloth.velocities = Vertices::Zero(positions.rows(), 3);
  cloth.masses = Eigen::VectorXd::LinSpaced(positions.rows(), 0.5, 2);
  return cloth;
}

}  // namespace drape::test
