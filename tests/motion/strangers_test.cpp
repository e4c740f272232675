// Motions and checkpoints with valid sizes and checksums and arbitrary content.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "drape/core/error.hpp"
#include "tests/motion/recorded.hpp"
#include "tests/support/files.hpp"
#include "tests/support/opened_blocks.hpp"
#include "tests/support/random.hpp"

namespace drape::test {
namespace {

/// A motion of three steps with edited blocks.
class StrangersMotion : public testing::Test {
 protected:
  StrangersMotion() {
    scene_ = folder_.load(recorded_scene, {"time.duration=0.06", "look.texture=\"plaid.png\""});
    record(scene_, folder_.path("good.drape"));
    good_ = content(folder_.path("good.drape"));
  }

  /// Reads all of a motion and draws it, as drape render does.
  void draw(const std::string& bytes) {
    std::ofstream(folder_.path("bad.drape"), std::ios::binary) << bytes;
    const auto motion = std::make_shared<MotionReader>(folder_.path("bad.drape"));
    const MotionScene own(*motion);
    RunOptions options;
    options.recorded = motion;
    options.steps = motion->last_step();
    options.outputs = {folder_.path("bad.gif"), folder_.path("bad-{frame}.obj")};
    Progress progress;
    const RunResult result = run_scene(own.scene(), options, {}, progress);
    EXPECT_TRUE(result.problems.empty());
    const std::string obj = content(folder_.path("bad-0.obj"));
    EXPECT_EQ(obj.find("inf"), std::string::npos);
    EXPECT_EQ(obj.find("nan"), std::string::npos);
  }
  [[nodiscard]] std::string error_of(const OpenedBlocks& blocks) {
    return folder_.without_folder(usage_error([&] { draw(blocks.sealed()); }));
  }

  SceneFolder folder_;
  LoadedScene scene_;
  std::string good_;
};

TEST_F(StrangersMotion, IsReadWhereItWasOnlySealedAgain) {
  EXPECT_TRUE(OpenedBlocks(good_).sealed() == good_);
  EXPECT_EQ(error_of(OpenedBlocks(good_)), "(no error)");
}

/// Changes of compressed bytes, which can rarely be decompressed.
TEST_F(StrangersMotion, IsDrawnOrRefusedWhicheverByteOfAPayloadIsAnother) {
  constexpr std::size_t head_size = 16;
  const std::size_t begin = good_.find(state_tag);
  const std::uint64_t size = ByteReader(std::string_view(good_).substr(begin + 4)).whole();
  for (const std::size_t place : {8, 9, 12, 13, 16, 19, 34, 71, 96, 98}) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string payload = good_.substr(begin + head_size, size), bytes = good_;
      payload[place] = static_cast<char>(payload[place] ^ (1 << bit));
      bytes.replace(begin, head_size + size, block_head(state_tag, payload) + payload);
      const std::string message = folder_.without_folder(usage_error([&] { draw(bytes); }));
      EXPECT_TRUE(message == "(no error)" || message.starts_with("bad.drape: the file ")) << place << " " << message;
    }
  }
}

/// Sets every position in a motion. Values without a prediction are stored directly, shifted by one bit.
void set_places(OpenedBlocks& blocks, double value) {
  for (OpenedBlock& block : blocks.blocks) {
    if (block.tag != state_tag) continue;
    std::vector<std::uint64_t> words(block.words().size(), 0);
    std::fill_n(words.begin(), words.size() / 2, std::bit_cast<std::uint64_t>(value) << 1);
    block.head.replace(8, 8, 8, '\0');
    block.set_words(words);
  }
}

TEST_F(StrangersMotion, IsDrawnOrRefusedWhereverItIs) {
  for (const double place : {0.0, 1e-300, 1e-162, 1e-154, 1e-60, 1e19, 1e39, 1e89}) {
    OpenedBlocks blocks(good_);
    set_places(blocks, place);
    EXPECT_EQ(error_of(blocks), "(no error)") << place;
  }
  for (const double place : {1e154, 1e300}) {
    OpenedBlocks blocks(good_);
    set_places(blocks, place);
    EXPECT_TRUE(
        error_of(blocks).starts_with("bad.drape: the file holds a place or velocity that cannot be (block STAT"))
        << error_of(blocks);
  }
}

TEST_F(StrangersMotion, HasFiniteNumbersInItsRows) {
  const OpenedBlocks good(good_);
  for (const std::size_t number : {0, 5, 17, 30, 41}) {
    OpenedBlocks blocks = good;
    OpenedBlock& rows = blocks.block(rows_tag);
    std::vector<std::uint64_t> words = rows.words();
    words[number] = std::bit_cast<std::uint64_t>(double{INFINITY});
    rows.set_words(words);
    EXPECT_TRUE(error_of(blocks).starts_with("bad.drape: the file h")) << number << ": " << error_of(blocks);
    EXPECT_NE(error_of(blocks).find("(block ROWS at byte "), std::string::npos) << error_of(blocks);
  }
}

TEST_F(StrangersMotion, HasNamesThatStayInItsFolder) {
  const auto refused = [&](const std::string& what, const std::string& by, const std::string& key) {
    OpenedBlocks blocks(good_);
    std::string& head = blocks.block(header_tag).plain;
    ASSERT_NE(head.find(what), std::string::npos) << head;
    head.replace(head.find(what), what.size(), by);
    EXPECT_TRUE(error_of(blocks).starts_with("bad.drape: block HEAD: " + key + ": expected a plain name"))
        << error_of(blocks);
  };
  for (const std::string name : {"..", "../x", "a\\u0000b", ".x", "a\\nb", "a/b", ""}) {
    refused("\"name\": \"scene\"", "\"name\": \"" + name + "\"", "name");
    refused("\"file-1.png\"", "\"" + name + "\"", "files");
  }
}

TEST_F(StrangersMotion, HasAllFilesOfItsScene) {
  const std::string elsewhere =
      folder_.write("private.png", content(std::string(DRAPE_SOURCE_DIR) + "/textures/plaid.png"));
  for (const std::string& name : {elsewhere, "../" + folder_.path().filename().string() + "/private.png"}) {
    OpenedBlocks blocks(good_);
    std::string& head = blocks.block(header_tag).plain;
    const std::string named = "texture\\\" = \\\"file-1.png";
    const std::size_t at = head.find(named);
    ASSERT_NE(at, std::string::npos) << head;
    head.replace(at, named.size(), "texture\\\" = \\\"" + name);
    EXPECT_NE(error_of(blocks).find("the file's scene names a file that is not in it: "), std::string::npos)
        << error_of(blocks);
  }
}

TEST_F(StrangersMotion, HasTheStepOfItsScene) {
  OpenedBlocks blocks(good_);
  std::string& head = blocks.block(header_tag).plain;
  head.replace(head.find("\"step\": 0.02"), 12, "\"step\": 0.04");
  EXPECT_EQ(error_of(blocks), "bad.drape: the file's scene has another time step than its motion");
}

/// Rows of all steps, or an index that claims them, would be drawn for ever.
TEST_F(StrangersMotion, HasRowsOfAllItsSteps) {
  OpenedBlocks blocks(good_);
  std::string& head = blocks.block(header_tag).plain;
  head.replace(head.find("\"steps\": 3"), 10, "\"steps\": 900000000003");
  OpenedBlock& rows = blocks.block(rows_tag);
  OpenedBlock last = rows;
  rows.head = ByteWriter().whole(0).whole(4).text();
  last.head = ByteWriter().whole(900'000'000'000).whole(4).text();
  OpenedBlock state = blocks.block(state_tag, 3);
  state.head.replace(0, 8, ByteWriter().whole(900'000'000'003).text());
  blocks.block(state_tag, 3) = state;
  blocks.blocks.insert(blocks.blocks.end() - 1, last);
  EXPECT_NE(error_of(blocks).find("does not have the rows of all steps"), std::string::npos) << error_of(blocks);
}

/// A motion with random bits flipped is drawn or refused.
class TamperedMotion : public StrangersMotion, public testing::WithParamInterface<int> {};

TEST_P(TamperedMotion, IsDrawnOrRefused) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 1);
  const OpenedBlocks good(good_);
  int drawn = 0;
  for (int i = 0; i < tries(40); ++i) {
    OpenedBlocks blocks = good;
    const int changes = 1 + random.below(3);
    for (int k = 0; k < changes; ++k) {
      blocks.change(static_cast<std::size_t>(random.below(1000)), static_cast<std::size_t>(random.below(1 << 20)),
                    static_cast<std::uint8_t>(1 << random.below(8)));
    }
    try {
      draw(blocks.sealed());
      ++drawn;
    } catch (const UsageError& error) {
      const std::string message = folder_.without_folder(error.what());
      EXPECT_TRUE(message.starts_with("bad.drape: ") || message.starts_with("the texture ")) << i << " " << message;
    }
  }
  EXPECT_GT(drawn, 0);
}

INSTANTIATE_TEST_SUITE_P(Few, TamperedMotion, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, TamperedMotion, testing::Range(1, 26));

/// An interrupted run with a complete checkpoint.
class StrangersCheckpoint : public testing::Test {
 protected:
  StrangersCheckpoint() {
    const LoadedScene scene = folder_.load(recorded_scene +
                                           "[effects.strain_limit]\nmax_stretch = 1.02\n[integrator]\nmethod = "
                                           "\"implicit\"\nscheme = \"sdirk2\"\n");
    record(scene, folder_.path("m.drape"), {}, 12);
    partial_ = content(folder_.path("m.drape.partial"));
    checkpoint_ = content(folder_.path("m.drape.checkpoint"));
  }
  /// Expects that resuming is refused and loses nothing.
  void expect_refused(const std::string& partial, const std::string& checkpoint, const std::string& file) {
    folder_.write("m.drape.partial", partial);
    folder_.write("m.drape.checkpoint", checkpoint);
    const std::string message = folder_.without_folder(usage_error([&] { resume(folder_.path("m.drape")); }));
    EXPECT_TRUE(message.starts_with(file + ": ")) << message;
    EXPECT_TRUE(content(folder_.path("m.drape.partial")) == partial);
    EXPECT_TRUE(content(folder_.path("m.drape.checkpoint")) == checkpoint);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("m.drape")));
  }

  SceneFolder folder_;
  std::string partial_, checkpoint_;
};

TEST_F(StrangersCheckpoint, IsRefusedWherePartsAreMissingOrEmpty) {
  const OpenedBlocks good(checkpoint_);
  ASSERT_GE(good.blocks.size(), 6U);
  for (std::size_t k = 0; k < good.blocks.size(); ++k) {
    SCOPED_TRACE(good.blocks[k].tag);
    const bool rows = good.blocks[k].tag == rows_tag;
    OpenedBlocks without = good;
    without.blocks.erase(without.blocks.begin() + static_cast<std::ptrdiff_t>(k));
    const bool late = good.blocks[k].tag == "BOOK" || good.blocks[k].tag == "PULL" || good.blocks[k].tag == "HELD";
    expect_refused(partial_, without.sealed(), late ? "m.drape.partial" : "m.drape.checkpoint");
    OpenedBlocks empty = good;
    empty.blocks[k].plain.clear();
    if (!rows) empty.blocks[k].head.clear();
    expect_refused(partial_, empty.sealed(), good.blocks[k].tag == "PULL" ? "m.drape.partial" : "m.drape.checkpoint");
  }
}

TEST_F(StrangersCheckpoint, HasTheNumberOfSubstepsOfAnAccuracy) {
  const LoadedScene scene = folder_.load(recorded_scene, {"time.accuracy=1e-5"});
  std::filesystem::remove(folder_.path("m.drape.partial"));
  std::filesystem::remove(folder_.path("m.drape.checkpoint"));
  record(scene, folder_.path("m.drape"), {}, 12);
  partial_ = content(folder_.path("m.drape.partial"));
  const OpenedBlocks good(content(folder_.path("m.drape.checkpoint")));
  const auto cuts = std::ranges::find(good.blocks, std::string("CUTS"), [](const auto& block) { return block.tag; });
  ASSERT_NE(cuts, good.blocks.end());
  OpenedBlocks without = good;
  without.blocks.erase(without.blocks.begin() + (cuts - good.blocks.begin()));
  expect_refused(partial_, without.sealed(), "m.drape.partial");
}

TEST_F(StrangersCheckpoint, IsNotGoneOnFromWhereTheMotionIsDamaged) {
  std::uint64_t bit = 0;
  for (std::size_t at = 25; at < partial_.size(); at += 97) {
    std::string bytes = partial_;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (bit++ % 8)));
    expect_refused(bytes, checkpoint_, "m.drape.partial");
  }
  const OpenedBlocks good(partial_);
  for (const char* tag : {state_tag, rows_tag}) {  // with a valid checksum
    OpenedBlocks blocks = good;
    const auto is_wanted = [&](const OpenedBlock& block) { return block.tag == tag; };
    const auto found = std::ranges::find_if(blocks.blocks, is_wanted);
    if (found == blocks.blocks.end()) continue;
    std::ranges::fill(found->plain, '\x7f');
    OpenedBlocks checkpoint(checkpoint_);
    checkpoint.blocks.front().plain = ByteWriter().whole(blocks.sealed().size()).text();
    expect_refused(blocks.sealed(), checkpoint.sealed(), "m.drape.partial");
  }
  folder_.write("m.drape.partial", partial_);
  folder_.write("m.drape.checkpoint", checkpoint_);
  EXPECT_EQ(resume(folder_.path("m.drape")).outcome, Outcome::completed);
}

}  // namespace
}  // namespace drape::test
