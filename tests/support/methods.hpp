#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>

#include "sim/settings.hpp"

namespace drape::test {

struct NamedMethod {
  Method method;
  const char* name;
};

/// Every method. A new one is tested by everything that is parametrised over methods once it stands here.
inline constexpr std::array all_methods{
    NamedMethod{Method::semi_implicit, "SemiImplicit"},
    NamedMethod{Method::implicit, "Implicit"},
    NamedMethod{Method::liu13, "Liu13"},
};

/// Those that minimise the implicit step, all but the first.
inline constexpr auto implicit_methods = [] {
  std::array<NamedMethod, all_methods.size() - 1> rest{};
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = all_methods[i + 1];
  return rest;
}();

inline void PrintTo(const NamedMethod& method, std::ostream* out) { *out << method.name; }

/// Ends the name of a parametrised test with the method's.
inline std::string method_name(const testing::TestParamInfo<NamedMethod>& info) { return info.param.name; }

}  // namespace drape::test
