#include "check/golden.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "check/motion_file.hpp"
#include "render/encode/png_encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;
constexpr double quantum = 1e-7;

GoldenWindow window(int frame, std::int64_t step, int vertices, int steps) {
  std::mt19937 generator(static_cast<unsigned>(frame + 1));
  std::uniform_real_distribution<double> uniform(-2, 2);
  const auto random = [&] { return Vertices(Vertices::NullaryExpr(vertices, 3, [&] { return uniform(generator); })); };
  GoldenWindow window;
  window.frame = frame;
  window.time = 0.04 * frame;
  window.start = {random(), random(), step};
  Vertices x = window.start.x;
  for (int i = 0; i < steps; ++i) {
    x += 1e-3 * random();
    window.steps.push_back({generator(), x, {.kinetic = uniform(generator), .gravity = -1 / 3., .elastic = 1e-17}});
  }
  return window;
}

void expect_same_bits(const Vertices& a, const Vertices& b) {
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())), 0);
}

TEST(MotionFile, KeepsStatesExactlyAndStepsToTheQuantum) {
  std::vector<GoldenWindow> windows{window(0, 0, 30, 5), window(7, 14, 30, 0), window(9, 18, 30, 20)};
  windows[1].frame.reset();
  windows[2].shown = windows[2].steps[0].x;
  windows[0].start.x(3, 1) = -0.0;
  const std::vector<GoldenWindow> read = unpack_motion(pack_motion(windows, quantum), quantum);
  ASSERT_EQ(read.size(), windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    EXPECT_EQ(read[i].frame, windows[i].frame);
    EXPECT_EQ(read[i].time, windows[i].time);
    EXPECT_EQ(read[i].start.step, windows[i].start.step);
    EXPECT_EQ(state_bits(read[i].start), state_bits(windows[i].start));
    ASSERT_EQ(read[i].steps.size(), windows[i].steps.size());
    for (std::size_t k = 0; k < read[i].steps.size(); ++k) {
      EXPECT_EQ(read[i].steps[k].bits, windows[i].steps[k].bits);
      EXPECT_EQ(read[i].steps[k].energies.elastic, windows[i].steps[k].energies.elastic);
      EXPECT_LE((read[i].steps[k].x - windows[i].steps[k].x).cwiseAbs().maxCoeff(), 0.5001 * quantum);
    }
  }
  expect_same_bits(read[2].picture_positions(), *windows[2].shown);
  expect_same_bits(read[0].picture_positions(), windows[0].start.x);
}

TEST(MotionFile, IsSmallerThanTheNumbersInIt) {
  const std::vector<GoldenWindow> windows{window(0, 0, 441, 20)};
  const std::size_t raw = sizeof(double) * 441 * 3 * (2 + 20);
  EXPECT_LT(pack_motion(windows, quantum).size(), raw / 2);
}

TEST(MotionFile, RefusesPositionsThatAreNotFinite) {
  std::vector<GoldenWindow> windows{window(0, 0, 3, 1)};
  windows[0].steps[0].x(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pack_motion(windows, quantum), std::domain_error);
}

TEST(MotionFile, RefusesEveryDamage) {
  const std::string good = pack_motion({window(0, 0, 12, 3)}, quantum);
  EXPECT_THROW(unpack_motion("", quantum), std::invalid_argument);
  EXPECT_THROW(unpack_motion("drape motion 1\n99999999999999\n", quantum), std::invalid_argument);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_THROW(unpack_motion(good.substr(0, i), quantum), std::invalid_argument) << "cut off at " << i;
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    try {
      // A bit that the compression does not use may flip: then the numbers are the same.
      EXPECT_EQ(pack_motion(unpack_motion(bad, quantum), quantum), good) << "byte " << i;
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, good.size() * 95 / 100);
}

class GoldenFolder : public test::InScratchFolder {
 protected:
  Golden golden() const {
    Golden golden;
    golden.scene_digest = "0123456789abcdef";
    golden.date = "2026-01-31T12:00:00Z";
    golden.machine.renderer = "llvmpipe \"256 bits\"";
    golden.size = {32, 24};
    golden.step = 0.02;
    golden.step_count = 100;
    golden.vertex_count = 12;
    golden.seconds_per_frame = 1.0 / 30;
    golden.camera.target = Eigen::Vector3d(0.1, 1.0 / 3, -2e-17);
    golden.view.position = {1.0 / 7, 0, 3};
    golden.windows = {window(0, 0, 12, 3), window(40, 80, 12, 3)};
    return golden;
  }

  Png picture() const { return encode_png(test::plain_image(32, 24, {1, 2, 3})); }
  fs::path folder() const { return folder_ / "scene.golden"; }
};

TEST_F(GoldenFolder, GivesBackWhatWasWritten) {
  const Golden written = golden();
  const std::uintmax_t size = write_golden(folder(), written, {picture(), picture()});
  EXPECT_EQ(size, fs::file_size(folder() / "manifest.json") + fs::file_size(folder() / "motion.bin") +
                      fs::file_size(golden_picture(folder(), 0)) + fs::file_size(golden_picture(folder(), 40)));
  const Golden read = read_golden(folder());
  EXPECT_EQ(read.scene_digest, written.scene_digest);
  EXPECT_EQ(read.date, written.date);
  EXPECT_EQ(read.machine.renderer, written.machine.renderer);
  EXPECT_EQ(read.size, written.size);
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.step_count, written.step_count);
  EXPECT_EQ(read.seconds_per_frame, written.seconds_per_frame);
  EXPECT_TRUE(same_camera(read.camera, written.camera));
  EXPECT_EQ(read.view.position, written.view.position);
  EXPECT_EQ(read.windows.size(), 2u);
  Camera moved = written.camera;
  moved.azimuth += 1e-9;
  EXPECT_FALSE(same_camera(read.camera, moved));
}

TEST_F(GoldenFolder, ReplacesAnOlderOneWhole) {
  Golden first = golden();
  write_golden(folder(), first, {picture(), picture()});
  put(folder() / "frames" / "0099.png", "old");
  write_golden(folder(), first, {picture(), picture()});
  EXPECT_EQ(file_count(), 4u);  // nothing old, nothing half-written
}

TEST_F(GoldenFolder, SaysWhichFileIsDamagedAndWhatToDo) {
  write_golden(folder(), golden(), {picture(), picture()});
  const auto message = [&] { return test::usage_error([&] { read_golden(folder()); }); };
  const std::string motion = test::content(folder() / "motion.bin");
  put(folder() / "motion.bin", motion.substr(0, motion.size() / 2));
  EXPECT_NE(message().find("motion.bin: it is damaged; restore it, or record it anew with drape bless"),
            std::string::npos)
      << message();
  put(folder() / "motion.bin", motion);
  EXPECT_EQ(message(), "(no error)");
  std::string manifest = test::content(folder() / "manifest.json");
  put(folder() / "manifest.json", "{");
  EXPECT_NE(message().find("manifest.json"), std::string::npos) << message();
  manifest.replace(manifest.find("\"vertices\": 12"), 14, "\"vertices\": 13");
  put(folder() / "manifest.json", manifest);
  EXPECT_NE(message().find("does not belong to the manifest"), std::string::npos) << message();
}

}  // namespace
}  // namespace drape
