#pragma once

#include <gtest/gtest.h>

#include <string>

#include "drape/core/error.hpp"
#include "drape/render/settings.hpp"
#include "render/gl/context.hpp"

namespace drape::test {

/// Returns why a backend is unavailable; empty if it is available.
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

/// A test with each backend; skipped if the backend is unavailable.
class WithBackend : public ::testing::TestWithParam<GlBackend> {
 protected:
  void SetUp() override { SKIP_WITHOUT(GetParam()); }
};

inline const auto both_backends = ::testing::Values(GlBackend::osmesa, GlBackend::egl);

inline std::string name_of_backend(const ::testing::TestParamInfo<GlBackend>& backend) {
  return backend_name(backend.param);
}

}  // namespace drape::test
