#include <gtest/gtest.h>

#include "check/html_report.hpp"
#include "check/manifest.hpp"
#include "check/report.hpp"
#include "tests/html/sample_check.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

/// Returns two shards of a check: the first and last scene, and the others.
std::vector<CheckShard> two_shards(const CheckReport& whole) {
  std::vector<CheckShard> shards;
  for (const std::size_t number : {1, 2}) {
    CheckShard& shard = shards.emplace_back(
        CheckShard{.report = whole, .places = {}, .scenes = whole.scenes.size(), .shard = {number, 2}});
    shard.report.scenes.clear();
    shard.report.seconds = whole.seconds / 2;
  }
  for (std::size_t i = 0; i < whole.scenes.size(); ++i) {
    CheckShard& shard = shards[i == 0 || i + 1 == whole.scenes.size() ? 0 : 1];
    shard.places.push_back(i);
    shard.report.scenes.push_back(whole.scenes[i]);
  }
  return shards;
}

std::string refusal(const std::vector<CheckShard>& shards) {
  return test::usage_error([&] { merge_shards(shards, {"one", "two"}); });
}

TEST(CheckArchive, HoldsAllThatReportsAreMadeOf) {
  const CheckReport whole = test::sample_check(true);
  ASSERT_GE(whole.scenes.size(), 3U);
  std::vector<CheckShard> shards = two_shards(whole);
  for (CheckShard& shard : shards) shard = unpack_shard(pack_shard(shard), "check.cbor");
  const CheckReport merged = merge_shards(shards, {"one", "two"});
  EXPECT_EQ(merged.missing, 0U);
  EXPECT_EQ(json_report(merged), json_report(whole));
  EXPECT_EQ(junit_report(merged), junit_report(whole));
  EXPECT_EQ(html_report(merged), html_report(whole));
}

TEST(CheckArchive, RefusesShardsOfAnotherNumberOrProgram) {
  const CheckReport whole = test::sample_check(true);
  std::vector<CheckShard> shards = two_shards(whole);
  EXPECT_EQ(refusal(shards), "(no error)");
  shards[1].shard = {2, 3};
  EXPECT_EQ(refusal(shards), "two and one are not of one check");
  shards[1].shard = {3, 2};
  EXPECT_NE(test::usage_error([&] { unpack_shard(pack_shard(shards[1]), "check.cbor"); }).find("damaged"),
            std::string::npos);
  shards = two_shards(whole);
  shards[1].report.machine.drape = "0.0.1";
  EXPECT_NE(refusal(shards).find("two by drape 0.0.1, "), std::string::npos) << refusal(shards);
}

TEST(CheckArchive, TakesAShardOnce) {
  const CheckReport whole = test::sample_check(true);
  std::vector<CheckShard> shards = two_shards(whole);
  shards[1].shard.number = 1;
  const CheckReport merged = merge_shards(shards, {"one", "two"});
  EXPECT_EQ(merged.scenes.size(), 2U);
  EXPECT_EQ(merged.missing, whole.scenes.size() - 2);
}

TEST(CheckArchive, WithoutAShardHasNotPassed) {
  const CheckReport whole = test::sample_check(false);
  ASSERT_TRUE(whole.passed());
  const CheckReport merged = merge_shards({two_shards(whole)[0]}, {"one"});
  EXPECT_FALSE(merged.passed());
  const std::string said = "1 of 3 scenes are in none of the shards";
  ASSERT_EQ(describe_missing(merged), said);
  EXPECT_NE(html_report(merged).find(said), std::string::npos);
  EXPECT_NE(json_report(merged).find("\"passed\": false"), std::string::npos);
  EXPECT_NE(junit_report(merged).find("errors=\"1\""), std::string::npos);
  EXPECT_NE(junit_report(merged).find("<error message=\"" + said), std::string::npos);
  EXPECT_NE(github_summary(merged).find("### drape check: 2 scenes are as they were, " + said), std::string::npos);
}

}  // namespace
}  // namespace drape
