#include <gtest/gtest.h>
#include <zlib.h>

#include <map>
#include <regex>

#include "output/registry.hpp"
#include "tests/support/written_motion.hpp"

// Reads an archive by its format's specification: from the directory at its end.

namespace drape::npz {
namespace {

using test::number_at;
using test::vertices_at;

/// Returns the entries of an archive by name, as listed in its directory.
std::map<std::string, std::string> entries(const std::string& zip) {
  std::map<std::string, std::string> found;
  const std::size_t end = zip.rfind("PK\x05\x06"), locator = zip.rfind("PK\x06\x07");
  EXPECT_EQ(end + 22, zip.size());
  EXPECT_EQ(locator + 20, end);
  const auto record = number_at<std::uint64_t>(zip, locator + 8);
  EXPECT_EQ(zip.substr(record, 4), "PK\x06\x06");
  const auto count = number_at<std::uint64_t>(zip, record + 32);
  std::size_t at = number_at<std::uint64_t>(zip, record + 48);
  EXPECT_EQ(at + number_at<std::uint64_t>(zip, record + 40), record);
  for (std::uint64_t i = 0; i < count; ++i) {
    EXPECT_EQ(zip.substr(at, 4), "PK\x01\x02");
    const auto name_size = number_at<std::uint16_t>(zip, at + 28), extra_size = number_at<std::uint16_t>(zip, at + 30);
    const std::string name = zip.substr(at + 46, name_size);
    const std::size_t extra = at + 46 + name_size;
    EXPECT_EQ(number_at<std::uint16_t>(zip, extra), 1);
    const auto size = number_at<std::uint64_t>(zip, extra + 4), stored = number_at<std::uint64_t>(zip, extra + 12);
    const auto local = number_at<std::uint64_t>(zip, extra + 20);
    EXPECT_EQ(size, stored);

    EXPECT_EQ(zip.substr(local, 4), "PK\x03\x04");
    EXPECT_EQ(zip.substr(local + 30, name_size), name);
    const std::size_t data = local + 30 + name_size + number_at<std::uint16_t>(zip, local + 28);
    const std::string bytes = zip.substr(data, size);
    const auto sum =
        static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    EXPECT_EQ(number_at<std::uint32_t>(zip, at + 16), sum) << name;
    EXPECT_EQ(number_at<std::uint32_t>(zip, local + 14), sum) << name;
    found[name] = bytes;
    at = extra + extra_size;
  }
  EXPECT_EQ(at, record);
  return found;
}

struct Array {
  std::string type, shape;  // as in the header: "'<f8'", "9, 20, 3"
  std::string data;
};

Array parsed(const std::string& npy) {
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t data = 10 + number_at<std::uint16_t>(npy, 8);
  EXPECT_EQ(data % 64, 0U);
  const std::string header = npy.substr(10, data - 10);
  static const std::regex dictionary(R"(\{'descr': (.*), 'fortran_order': False, 'shape': \((.*?),?\), \} *\n)");
  std::smatch match;
  EXPECT_TRUE(std::regex_match(header, match, dictionary)) << header;
  return {match[1], match[2], npy.substr(data)};
}

class Npz : public ::testing::Test {
 protected:
  [[nodiscard]] Array array(const std::string& name) const { return parsed(entries_.at(name + ".npy")); }

  void read(const std::string& file) { entries_ = entries(test::content(folder_.path(file))); }

  test::SceneFolder folder_;
  std::map<std::string, std::string> entries_;
};

TEST_F(Npz, HoldsTheMotionToTheBit) {
  const LoadedScene scene = folder_.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder_.path("x.npz")});
  EXPECT_EQ(result.outcome, Outcome::completed);
  ASSERT_EQ(frames.size(), 9U);
  read("x.npz");
  EXPECT_EQ(array("positions").shape, "9, 20, 3");
  EXPECT_EQ(array("velocities").shape, "9, 20, 3");
  EXPECT_EQ(array("positions").type, "'<f8'");
  EXPECT_EQ(array("times").shape, "9");
  EXPECT_EQ(array("energies").type, "[('total', '<f8'), ('kinetic', '<f8'), ('gravity', '<f8'), ('elastic', '<f8')]");
  EXPECT_EQ(array("spheres").shape, "9, 1, 4");
  EXPECT_EQ(array("grounds").shape, "9, 1, 4");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    EXPECT_EQ(vertices_at<double>(array("positions").data, k * 480, 20), frame.positions) << k;
    EXPECT_EQ(vertices_at<double>(array("velocities").data, k * 480, 20), frame.velocities) << k;
    EXPECT_EQ(number_at<double>(array("times").data, 8 * k), frame.time);
    EXPECT_EQ(number_at<std::int64_t>(array("frames").data, 8 * k), frame.index);
    EXPECT_EQ(number_at<double>(array("energies").data, 32 * k), frame.energies->total());
    EXPECT_EQ(number_at<double>(array("energies").data, 32 * k + 24), frame.energies->elastic);
    EXPECT_EQ(number_at<double>(array("spheres").data, 32 * k), std::get<SphereShape>(frame.colliders[0]).center.x());
    EXPECT_EQ(number_at<double>(array("spheres").data, 32 * k + 24), 0.3);
    EXPECT_EQ(number_at<double>(array("grounds").data, 32 * k + 24), -1.25);
  }
}

TEST_F(Npz, HoldsTheMeshAsItIs) {
  const LoadedScene scene = folder_.load(test::moving_scene);
  test::write_motion(scene, {folder_.path("x.npz")});
  read("x.npz");
  const Array faces = array("faces"), uvs = array("uvs");
  const auto& triangles = scene.simulation.cloth.triangles;
  EXPECT_EQ(faces.shape, std::to_string(triangles.size()) + ", 3");
  EXPECT_EQ(uvs.shape, std::to_string(triangles.size()) + ", 3, 2");
  for (std::size_t corner = 0; corner < 3 * triangles.size(); ++corner) {
    EXPECT_EQ(number_at<std::int32_t>(faces.data, 4 * corner), triangles[corner / 3][corner % 3]);
    EXPECT_EQ(number_at<float>(uvs.data, 8 * corner + 4), scene.uvs[corner][1]);
  }
  EXPECT_EQ(vertices_at<double>(array("rest").data, 0, 20), scene.simulation.cloth.rest);
}

TEST_F(Npz, SaysWhichVerticesBelongToWhichCloth) {
  const std::string rest = "stiffness = 10\nmesh = { grid = ";
  const LoadedScene scene =
      folder_.load("[[cloth]]\nname = \"shirt\"\n" + rest + "[2, 1] }\n[[cloth]]\nname = \"cap\"\n" + rest +
                   "[1, 1] }\n[time]\nstep = 0.01\nduration = 0.01\n[effects.gravity]\n");
  test::write_motion(scene, {folder_.path("x.npz")});
  read("x.npz");
  const Array names = array("cloth_names"), cloths = array("cloths");
  EXPECT_EQ(names.type, "'<U5'");
  EXPECT_EQ(names.shape, "2");
  std::u32string text;
  for (std::size_t k = 0; k < 10; ++k) text += static_cast<char32_t>(number_at<std::uint32_t>(names.data, 4 * k));
  EXPECT_EQ(text, std::u32string(U"shirtcap\0\0", 10));
  EXPECT_EQ(cloths.type, "'<i4'");
  EXPECT_EQ(cloths.shape, "10");
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(number_at<std::int32_t>(cloths.data, 4 * i), i < 6 ? 0 : 1) << i;

  test::write_motion(folder_.load(test::moving_scene), {folder_.path("one.npz")});
  read("one.npz");
  EXPECT_EQ(entries_.count("cloths.npy"), 0U);
}

TEST_F(Npz, HasTheFramesThatThereAreWhereTheMotionEndsEarly) {
  Cloth cloth;
  cloth.rest = Vertices::Zero(2, 3);
  FilmInfo film;
  film.cloth = &cloth;
  film.expected_frames = 1000;
  const AnySink any = make_sink(folder_.path("x.npz"), film);
  Frame frame;
  frame.positions = frame.velocities = Vertices::Constant(2, 3, 0.5);
  for (frame.index = 0; frame.index < 3; ++frame.index) std::get<std::unique_ptr<MotionWriter>>(any)->add(frame);
  const std::vector<OutputFile> files = std::get<std::unique_ptr<MotionWriter>>(any)->finish(Ending::early);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].path, folder_.path("x.partial.npz"));
  read("x.partial.npz");
  EXPECT_EQ(array("positions").shape, "3, 2, 3");
  EXPECT_EQ(array("positions").data.size(), 3U * 2 * 3 * 8);
  EXPECT_EQ(array("spheres").shape, "3, 0, 4");
  EXPECT_EQ(array("faces").shape, "0, 3");
  EXPECT_EQ(folder_.file_count(), 1U);
}

TEST_F(Npz, TheSameMotionGivesTheSameBytes) {
  const LoadedScene scene = folder_.load(test::moving_scene);
  test::write_motion(scene, {folder_.path("a.npz"), folder_.path("b.npz")});
  EXPECT_EQ(test::content(folder_.path("a.npz")), test::content(folder_.path("b.npz")));
}

}  // namespace
}  // namespace drape::npz
