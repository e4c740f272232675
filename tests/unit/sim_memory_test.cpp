#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "sim/linear/memory.hpp"

namespace drape::test {
namespace {

TEST(Memory, GrantsWhatFits) { EXPECT_NO_THROW(require_memory("a vector", 1e6)); }

TEST(Memory, RefusesMoreThanThereIsWithTheFigures) {
  try {
    require_memory("a factor", 2 * memory_left());
    FAIL() << "granted twice the memory there is";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("a factor would take"), std::string::npos) << message;
    EXPECT_NE(message.find("coarser cloth"), std::string::npos) << message;
  }
}

TEST(Memory, CountsWhatTheProcessHolds) {
  const double before = memory_left();
  const std::vector<char> held(64'000'000, 'x');
  EXPECT_LE(memory_left(), before - 60e6) << held.back();
}

}  // namespace
}  // namespace drape::test
