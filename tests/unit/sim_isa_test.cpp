#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/sim/settings.hpp"
#include "sim/kernels/kernels.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

std::string fastest() {
  std::string best;
  for (const Kernels* version : all_kernels()) {
    if (version->supported() != 0) best = version->name;
  }
  return best;
}

/// The one of every processor that the program runs on.
std::string baseline() { return instruction_sets().front(); }

class InstructionSet : public testing::Test {
 protected:
  ~InstructionSet() override { limit_instruction_set(instruction_sets().back()); }
};

TEST_F(InstructionSet, IsTheFastestUnlessLimited) {
  EXPECT_EQ(instruction_set(), fastest());
  EXPECT_EQ(kernels().name, fastest());
}

TEST_F(InstructionSet, CanBeLimitedToTheBaseline) {
  limit_instruction_set(baseline());
  EXPECT_EQ(instruction_set(), baseline());
  EXPECT_EQ(kernels().name, baseline());
}

TEST_F(InstructionSet, IsNamedAfterTheProcessor) {
#if defined(__x86_64__)
  EXPECT_EQ(instruction_sets(), (std::vector<std::string>{"sse2", "avx2", "avx512"}));
#elif defined(__aarch64__)
  EXPECT_EQ(instruction_sets(), std::vector<std::string>{"neon"});
#else
  EXPECT_EQ(instruction_sets(), std::vector<std::string>{"generic"});
#endif
}

TEST_F(InstructionSet, IsNeverOneThatTheProcessorLacks) {
  limit_instruction_set(baseline());
  limit_instruction_set(instruction_sets().back());
  EXPECT_EQ(instruction_set(), fastest());
}

TEST_F(InstructionSet, IsNotTheEnvironments) {
  setenv("DRAPE_ISA", "none", 1);
  EXPECT_EQ(instruction_set(), fastest());
  unsetenv("DRAPE_ISA");
}

TEST_F(InstructionSet, IsRefusedUnderAWrongName) {
  for (const char* wrong : {"avx3", "sse2x", "neon2", ""}) {
    const std::string message = usage_error([&] { limit_instruction_set(wrong); });
    EXPECT_NE(message.find("'" + std::string(wrong) + "', expected one of " + baseline()), std::string::npos)
        << message;
  }
  EXPECT_EQ(instruction_set(), fastest()) << "it was refused";
}

}  // namespace
}  // namespace drape::test
