// The choice of an instruction set is made once in a process, so each of these runs in one of its own.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "core/error.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape::test {
namespace {

/// Prints the name of the chosen version, or why there is none, and exits.
[[noreturn]] void choose(const char* isa) {
  if (isa == nullptr) {
    unsetenv("DRAPE_ISA");
  } else {
    setenv("DRAPE_ISA", isa, 1);
  }
  try {
    std::fprintf(stderr, "chosen: %s\n", kernels().name.data());
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(static_cast<int>(error.code()));
  }
  std::exit(0);
}

const Kernels& fastest() {
  const Kernels* best = nullptr;
  for (const Kernels* version : all_kernels()) {
    if (version->supported() != 0) best = version;
  }
  return *best;
}

class InstructionSetDeathTest : public testing::Test {
 protected:
  // Starts the program again for each of them: in this process the choice may be made already.
  InstructionSetDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(InstructionSetDeathTest, CanBeLimitedToTheBaseline) {
  EXPECT_EXIT(choose("sse2"), testing::ExitedWithCode(0), "chosen: sse2");
}

TEST_F(InstructionSetDeathTest, IsTheFastestUnlessLimited) {
  EXPECT_EXIT(choose(nullptr), testing::ExitedWithCode(0), "chosen: " + std::string(fastest().name));
}

TEST_F(InstructionSetDeathTest, IsNotLimitedByAnEmptyName) {
  EXPECT_EXIT(choose(""), testing::ExitedWithCode(0), "chosen: " + std::string(fastest().name));
}

TEST_F(InstructionSetDeathTest, IsNeverOneThatTheProcessorLacks) {
  const std::string largest(all_kernels().back()->name);
  EXPECT_EXIT(choose(largest.c_str()), testing::ExitedWithCode(0), "chosen: " + std::string(fastest().name));
}

TEST_F(InstructionSetDeathTest, IsRefusedUnderAWrongName) {
  EXPECT_EXIT(choose("avx3"), testing::ExitedWithCode(2), "DRAPE_ISA.*avx3.*sse2");
  EXPECT_EXIT(choose("sse2x"), testing::ExitedWithCode(2), "sse2x");
}

}  // namespace
}  // namespace drape::test
