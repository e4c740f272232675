// Untrusted goldens with valid checksums and arbitrary content: judged or refused.

#include <gtest/gtest.h>

#include <map>

#include "check/golden.hpp"
#include "check/manifest.hpp"
#include "core/bytes.hpp"
#include "drape/core/error.hpp"
#include "tests/check/checked_scene.hpp"
#include "tests/support/motion_bytes.hpp"
#include "tests/support/random.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

class TamperedGolden : public test::CheckedScene, public testing::WithParamInterface<int> {
 protected:
  TamperedGolden() {
    bless();
    manifest_ = test::content(golden() / "manifest.json");
    motion_ = test::content(golden() / "motion.bin");
  }

  /// Changes bits of a number in the motion, or a character in the manifest.
  void tamper(test::Random& random) const {
    std::string manifest = manifest_;
    if (random.below(2) == 0) {
      const std::size_t line = motion_.find('\n') + 1;
      Words words = unpack_words(std::string_view(motion_).substr(line), UINT64_MAX / 8);
      const auto place = static_cast<std::size_t>(random.below(static_cast<int>(words.size())));
      words[place] ^= std::uint64_t{1} << random.below(64);
      const std::string motion = test::motion_bytes(words);
      Hash before, after;
      before.add(motion_);
      after.add(motion);
      const std::size_t at = manifest.find(before.text());
      ASSERT_NE(at, std::string::npos);
      manifest.replace(at, before.text().size(), after.text());
      put(golden() / "motion.bin", motion);
    } else {
      put(golden() / "motion.bin", motion_);
      constexpr std::string_view characters = "0123456789-e.\"[]{},x";
      const auto place = static_cast<std::size_t>(random.below(static_cast<int>(manifest.size())));
      manifest[place] = characters[static_cast<std::size_t>(random.below(static_cast<int>(characters.size())))];
    }
    try {
      manifest = sealed_manifest(manifest);
    } catch (const std::invalid_argument&) {
      // It is no longer JSON.
    }
    put(golden() / "manifest.json", manifest);
  }

  std::string manifest_, motion_;
};

TEST_P(TamperedGolden, IsJudgedOrRefused) {
  test::Random random(static_cast<std::uint64_t>(GetParam()) + 1);
  const auto names = [&] {
    std::map<fs::path, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) all[entry.path()] = test::content(entry.path());
    }
    return all;
  };
  int judged = 0;
  for (int i = 0; i < test::tries(40); ++i) {
    tamper(random);
    const auto before = names();
    try {
      check();
      ++judged;
    } catch (const UsageError& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with(golden().string())) << error.what();
    }
    EXPECT_EQ(names(), before);
  }
  EXPECT_GT(judged, 0);
}

INSTANTIATE_TEST_SUITE_P(Few, TamperedGolden, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, TamperedGolden, testing::Range(1, 26));

}  // namespace
}  // namespace drape
