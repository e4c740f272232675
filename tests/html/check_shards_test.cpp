#include <gtest/gtest.h>

#include "check/html_report.hpp"
#include "check/manifest.hpp"
#include "check/report.hpp"
#include "tests/html/sample_check.hpp"

namespace drape {
namespace {

TEST(CheckArchive, HoldsAllThatReportsAreMadeOf) {
  const CheckReport whole = test::sample_check(true);
  ASSERT_GE(whole.scenes.size(), 3U);
  // Two shards: the first and last scene, and the others.
  std::vector<CheckShard> shards(2);
  for (CheckShard& shard : shards) {
    shard = {.report = whole, .places = {}, .scenes = whole.scenes.size(), .whole = false};
    shard.report.scenes.clear();
    shard.report.seconds = whole.seconds / 2;
  }
  for (std::size_t i = 0; i < whole.scenes.size(); ++i) {
    CheckShard& shard = shards[i == 0 || i + 1 == whole.scenes.size() ? 0 : 1];
    shard.places.push_back(i);
    shard.report.scenes.push_back(whole.scenes[i]);
  }
  for (CheckShard& shard : shards) shard = unpack_shard(pack_shard(shard), "check.cbor");
  const CheckShard merged = merge_shards(shards, {"one", "two"});
  EXPECT_EQ(merged.missing(), 0U);
  EXPECT_EQ(json_report(merged.report), json_report(whole));
  EXPECT_EQ(junit_report(merged.report), junit_report(whole));
  EXPECT_EQ(html_report(merged.report), html_report(whole));
}

}  // namespace
}  // namespace drape
