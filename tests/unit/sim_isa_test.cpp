#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.hpp"
#include "sim/instruction_set.hpp"
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

class InstructionSet : public testing::Test {
 protected:
  ~InstructionSet() override { limit_instruction_set(instruction_sets().back()); }
};

TEST_F(InstructionSet, IsTheFastestUnlessLimited) {
  EXPECT_EQ(instruction_set(), fastest());
  EXPECT_EQ(kernels().name, fastest());
}

TEST_F(InstructionSet, CanBeLimitedToTheBaseline) {
  limit_instruction_set("sse2");
  EXPECT_EQ(instruction_set(), "sse2");
  EXPECT_EQ(kernels().name, "sse2");
}

TEST_F(InstructionSet, IsNeverOneThatTheProcessorLacks) {
  limit_instruction_set("sse2");
  limit_instruction_set(instruction_sets().back());
  EXPECT_EQ(instruction_set(), fastest());
}

TEST_F(InstructionSet, IsNotTheEnvironments) {
  setenv("DRAPE_ISA", "none", 1);
  EXPECT_EQ(instruction_set(), fastest());
  unsetenv("DRAPE_ISA");
}

TEST_F(InstructionSet, IsRefusedUnderAWrongName) {
  for (const char* wrong : {"avx3", "sse2x", ""}) {
    const std::string message = usage_error([&] { limit_instruction_set(wrong); });
    EXPECT_NE(message.find("'" + std::string(wrong) + "', expected one of sse2"), std::string::npos) << message;
  }
  EXPECT_EQ(instruction_set(), fastest()) << "it was refused";
}

}  // namespace
}  // namespace drape::test
