#include "check/golden.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "check/golden_folder.hpp"
#include "check/motion_file.hpp"
#include "output/png_encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/motion_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;
constexpr double quantum = 1e-7;
constexpr std::uint64_t enough = 1 << 20;  // words
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

std::vector<GoldenWindow> unpacked(std::string_view bytes) { return unpack_motion(bytes, quantum, enough); }

/// What is wrong with bytes that unpack_motion() refuses; empty if it does not.
std::string motion_refusal(std::string_view bytes, double of_quantum = quantum, std::uint64_t most_words = enough) {
  try {
    unpack_motion(bytes, of_quantum, most_words);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

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
  const std::vector<GoldenWindow> read = unpacked(pack_motion(windows, quantum));
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

TEST(MotionFile, StoresNoPositionsThatAreNotFiniteOrTooFarAway) {
  for (const double place : {nan, infinity, -1e12}) {
    std::vector<GoldenWindow> windows{window(0, 0, 3, 1)};
    windows[0].steps[0].x(0, 0) = place;
    EXPECT_THROW(pack_motion(windows, quantum), std::domain_error) << place;
    windows = {window(0, 0, 3, 0)};
    windows[0].start.x(0, 0) = place;
    EXPECT_THROW(pack_motion(windows, quantum), std::domain_error) << place;
  }
}

TEST(MotionFile, KeepsPositionsFromOneEndToTheOther) {
  // The differences of positions so far apart do not fit into 64 bits; what they are of does.
  std::vector<GoldenWindow> windows{window(0, 0, 1, 3)};
  for (std::size_t i = 0; i < 3; ++i) windows[0].steps[i].x.setConstant(i % 2 == 0 ? 8.9e11 : -8.9e11);
  const std::vector<GoldenWindow> read = unpacked(pack_motion(windows, quantum));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read[0].steps[i].x, windows[0].steps[i].x) << i;
}

TEST(MotionFile, RefusesWhatIsNotFinite) {
  // Of a number that is stored bit for bit, the file with another one is the one that pack_motion() makes of it.
  const std::vector<std::function<void(GoldenWindow&, double)>> places{
      [](GoldenWindow& w, double value) { w.start.v(1, 1) = value; },
      [](GoldenWindow& w, double value) { (*w.shown)(1, 1) = value; },
      [](GoldenWindow& w, double value) { w.time = value; },
      [](GoldenWindow& w, double value) { w.steps[0].energies.kinetic = value; },
      [](GoldenWindow& w, double value) { w.steps[0].energies.gravity = value; },
      [](GoldenWindow& w, double value) { w.steps[0].energies.elastic = value; }};
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const double value : {nan, infinity, -infinity}) {
      GoldenWindow bad = window(0, 0, 3, 1);
      bad.shown = bad.start.x;
      places[i](bad, value);
      EXPECT_EQ(motion_refusal(pack_motion({bad}, quantum)), "it holds a number that is not finite")
          << i << ": " << value;
    }
  }
}

TEST(MotionFile, RefusesPositionsThatAreTooFarAway) {
  GoldenWindow far = window(0, 0, 3, 1);
  far.start.x(1, 1) = 1e11;
  const std::string bytes = pack_motion({far}, quantum);
  EXPECT_EQ(motion_refusal(bytes), "");
  // A quantum from a damaged manifest.
  for (const double of_quantum : {1e-10, 1e-300, 5e-324, 0.0}) {
    EXPECT_EQ(motion_refusal(bytes, of_quantum), "it holds a position that is too far away") << of_quantum;
  }
  far = window(0, 0, 3, 1);
  far.shown = far.start.x;
  (*far.shown)(0, 0) = 1e300;
  EXPECT_EQ(motion_refusal(pack_motion({far}, quantum)), "it holds a position that is too far away");
}

/// A motion.bin with one vertex that is at the origin, and two steps whose positions have these differences.
std::string two_steps(std::uint64_t first, std::uint64_t second) {
  std::vector<std::uint64_t> words{2, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 4};  // whole numbers are stored as 2n or −2n − 1
  for (const std::uint64_t difference : {first, second}) {
    for (const std::uint64_t word : {std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{0}, difference,
                                     std::uint64_t{0}, std::uint64_t{0}}) {
      words.push_back(word);
    }
  }
  return test::motion_bytes(words);
}

TEST(MotionFile, RefusesStepsThatLeadOutOfAllBounds) {
  // 1 quantum away after a step, and 2 + 3 after the next.
  EXPECT_EQ(unpacked(two_steps(2, 6))[0].steps[1].x, (Vertices(1, 3) << 5 * quantum, 0, 0).finished());
  constexpr std::uint64_t largest = ~std::uint64_t{1}, smallest = ~std::uint64_t{0};  // ±2⁶³
  for (const std::uint64_t first : {largest, smallest}) {
    EXPECT_EQ(motion_refusal(two_steps(first, 0)), "it holds a position that is too far away") << first;
  }
  EXPECT_EQ(motion_refusal(two_steps(2, 6), 1e308), "it holds a position that is too far away");
}

TEST(MotionFile, RefusesNumbersOfNothing) {
  const std::vector<std::uint64_t> good{2, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(motion_refusal(test::motion_bytes(good)), "");
  constexpr std::size_t count = 0, frame = 1, step = 3, vertices = 4, shown = 11, steps = 12;
  for (const std::size_t place : {count, frame, step, vertices, shown, steps}) {
    for (const std::uint64_t value : {3ULL, 1ULL << 33, 1ULL << 62, ~0ULL, ~1ULL}) {  // −2, 2³², 2⁶¹, −2⁶³, 2⁶³ − 1
      std::vector<std::uint64_t> bad = good;
      bad[place] = value;
      if (place == step && (value == 1ULL << 33 || value == 1ULL << 62)) continue;  // the manifest knows better
      EXPECT_NE(motion_refusal(test::motion_bytes(bad)), "") << place << ": " << value;
    }
  }
}

TEST(MotionFile, UnpacksNoMoreThanItMay) {
  const std::string bytes = pack_motion({window(0, 0, 12, 3)}, quantum);
  const std::uint64_t words = most_motion_words(1, 12, 3);
  EXPECT_EQ(motion_refusal(bytes, quantum, words), "");
  EXPECT_EQ(motion_refusal(bytes, quantum, words / 2), "it holds more than belongs to the manifest beside it");
}

TEST(MotionFile, RefusesEveryDamage) {
  const std::string good = pack_motion({window(0, 0, 12, 3)}, quantum);
  EXPECT_NE(motion_refusal(""), "");
  EXPECT_NE(motion_refusal("drape motion 1\n99999999999999\n"), "");
  EXPECT_EQ(motion_refusal(good + "x"), "it is damaged");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_NE(motion_refusal(good.substr(0, i)), "") << "cut off at " << i;
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    try {
      // A bit that the compression does not use may flip: then the numbers are the same.
      EXPECT_EQ(pack_motion(unpacked(bad), quantum), good) << "byte " << i;
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
  EXPECT_NE(message().find("manifest.json: is no JSON"), std::string::npos) << message();
  manifest.replace(manifest.find("\"vertices\": 12"), 14, "\"vertices\": 13");
  put(folder() / "manifest.json", manifest);
  EXPECT_NE(message().find("does not belong to the manifest"), std::string::npos) << message();
}

TEST_F(GoldenFolder, SaysWhichFileIsNone) {
  const auto message = [&] { return test::usage_error([&] { read_golden(folder()); }); };
  for (const char* name : {"manifest.json", "motion.bin"}) {
    const fs::path file = folder() / name;
    const auto expect = [&](const std::string& problem) {
      EXPECT_EQ(message(), file.string() + ": " + problem + "; restore it, or record it anew with drape bless");
      fs::remove_all(folder());
      write_golden(folder(), golden(), {picture(), picture()});
      fs::remove(file);
    };
    fs::remove_all(folder());
    write_golden(folder(), golden(), {picture(), picture()});
    fs::remove(file);
    expect("is missing");
    fs::create_directory(file);
    expect("is a folder, not a file");
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    expect("is no regular file");
    fs::create_symlink("/dev/zero", file);
    expect("is no regular file");
    fs::create_symlink(file, file);
    EXPECT_NE(message().find(file.string() + ": cannot be read"), std::string::npos) << message();
    fs::remove(file);
    std::ofstream(file).close();
    fs::resize_file(file, std::uintmax_t{1} << 40);
    EXPECT_NE(message().find(file.string() + ": the file is too large"), std::string::npos) << message();
  }
}

TEST_F(GoldenFolder, RefusesFilesThatDoNotBelongTogether) {
  const auto message = [&](const Golden& of) {
    fs::remove_all(folder());
    write_golden(folder(), of, {picture(), picture()});
    return test::usage_error([&] { read_golden(folder()); });
  };
  EXPECT_EQ(message(golden()), "(no error)");
  Golden other = golden();
  other.windows[1].steps[2].energies.kinetic += 1e-9;
  message(other);
  const std::string motion = test::content(folder() / "motion.bin");
  message(golden());
  put(folder() / "motion.bin", motion);
  EXPECT_NE(test::usage_error([&] { read_golden(folder()); }).find("does not belong to the manifest"),
            std::string::npos);

  Golden backwards = golden();
  std::swap(backwards.windows[0], backwards.windows[1]);
  EXPECT_NE(message(backwards).find("windows that are not in order"), std::string::npos);

  // Two windows pass through the same step; their hashes tell that the second does not begin where the first one went.
  Golden overlapping = golden();
  overlapping.windows[1].start.step = 2;
  EXPECT_NE(message(overlapping).find("two windows have another state at the same step"), std::string::npos);
  overlapping.windows[0].steps[1].bits = state_bits(overlapping.windows[1].start);
  overlapping.windows[0].steps[2].bits = overlapping.windows[1].steps[0].bits;
  EXPECT_EQ(message(overlapping), "(no error)");
}

}  // namespace
}  // namespace drape
