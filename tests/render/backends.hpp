#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "render/backend.hpp"
#include "render/gl/context.hpp"
#include "render/gl/inspect.hpp"

namespace drape::test {

/// Why a backend is not there; empty if it is.
inline std::string problem(GlBackend backend) {
  try {
    inspect_backend(backend);
    return {};
  } catch (const OutputError& error) {
    return error.what();
  }
}

#define SKIP_WITHOUT(backend) \
  if (const std::string why = drape::test::problem(backend); !why.empty()) GTEST_SKIP() << why

/// A test with each backend; skipped where this one is not there.
class WithBackend : public ::testing::TestWithParam<GlBackend> {
 protected:
  void SetUp() override { SKIP_WITHOUT(GetParam()); }
};

inline const auto both_backends = ::testing::Values(GlBackend::osmesa, GlBackend::egl);

inline std::string name_of_backend(const ::testing::TestParamInfo<GlBackend>& backend) {
  return backend_name(backend.param);
}

}  // namespace drape::test
