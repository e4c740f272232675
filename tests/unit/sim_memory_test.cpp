#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "sim/linear/memory.hpp"

namespace drape::test {
namespace {

TEST(Memory, GrantsWhatFits) { EXPECT_NO_THROW(require_memory("a vector", 1e6)); }

TEST(Memory, RefusesMoreThanThereIsWithTheFigures) {
  try {
    require_memory("a factor", 2 * memory_limit());
    FAIL() << "granted twice the memory there is";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("a factor would take"), std::string::npos) << message;
    EXPECT_NE(message.find("coarser cloth"), std::string::npos) << message;
  }
}

// What is held already counts: all of the limit is too much for a process that holds something.
TEST(Memory, CountsWhatTheProcessHolds) { EXPECT_THROW(require_memory("a factor", memory_limit()), UsageError); }

}  // namespace
}  // namespace drape::test
