#include <gtest/gtest.h>

#include <cmath>

#include "core/files.hpp"
#include "run/outputs.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape {
namespace {

/// Returns a strip of three squares, whose ends are bent up by an angle.
Vertices bent(double angle) {
  Vertices x(8, 3);
  for (int i = 0; i < 2; ++i) {
    x.row(Eigen::Index{4} * i) << -std::cos(angle), i, std::sin(angle);
    x.row(4 * i + 1) << 0, i, 0;
    x.row(4 * i + 2) << 1, i, 0;
    x.row(4 * i + 3) << 1 + std::cos(angle), i, std::sin(angle);
  }
  return x;
}

/// Makes the cloth of the strip.
Cloth strip() {
  Cloth cloth;
  for (int i = 0; i < 3; ++i) {
    cloth.triangles.push_back({i, i + 1, i + 4});
    cloth.triangles.push_back({i + 5, i + 4, i + 1});
  }
  return cloth;
}

int chosen_of(const std::vector<double>& angles) {
  const Cloth cloth = strip();
  FilmInfo film;
  film.cloth = &cloth;
  Poster poster(film);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    Frame frame;
    frame.index = static_cast<int>(k);
    // Shape counts, not position.
    frame.positions = bent(angles[k]).rowwise() + static_cast<double>(k) * Eigen::RowVector3d(5, -3, 2);
    Image image(1, 1);
    image.pixels[0] = static_cast<std::uint8_t>(k);
    poster.see(frame, image);
  }
  EXPECT_EQ(poster.image()->pixels[0], poster.frame());
  return poster.frame();
}

TEST(Poster, IsOfTheFrameInWhichTheClothIsBentMost) {
  EXPECT_EQ(chosen_of({0, 0.3, 1.2, 0.7}), 2);
  EXPECT_EQ(chosen_of({0, -0.3, -2.5, 0.7}), 2);  // up or down, and beyond a right angle
}

/// Writes a film of four frames, of which the third is bent most.
std::string film_of(const std::string& file, bool start_at_poster, const std::vector<int>& order) {
  const Cloth cloth = strip();
  FilmInfo film;
  film.cloth = &cloth;
  film.expected_frames = 4;
  film.width = film.height = 32;
  Outputs outputs({file}, film, false, start_at_poster);
  for (int k = 0; k < 4; ++k) {
    Frame frame;
    frame.index = k;
    frame.positions = bent(std::vector{0.0, 0.3, 1.2, 0.7}[static_cast<std::size_t>(k)]);
    Image image(32, 32);
    image.at(4 * order[static_cast<std::size_t>(k)], 9)[0] = 200;
    outputs.add({frame, image});
  }
  outputs.finish(Ending::complete);
  return read_file(file, 1 << 20);
}

// A looping film stays the same when it starts at another frame.
TEST(Poster, CanBeWhereALoopBegins) {
  const test::ScratchFolder folder;
  for (const char* extension : {".gif", ".webp", ".apng"}) {
    const std::string file = (folder.path() / "film").string() + extension;
    const std::string rotated = film_of(file, true, {0, 1, 2, 3});
    EXPECT_EQ(rotated, film_of(file, false, {2, 3, 0, 1})) << extension;
    EXPECT_NE(rotated, film_of(file, false, {0, 1, 2, 3})) << extension;
  }
}

TEST(Poster, IsOfTheFirstFrameOfSeveral) {
  EXPECT_EQ(chosen_of({0, 0, 0}), 0);
  EXPECT_EQ(chosen_of({0, 0.5, 0.5 + 1e-12}), 1);
}

TEST(Poster, GoesBesideEachFilm) {
  FilmInfo film;
  film.scene = "flag";
  EXPECT_EQ(poster_files({"out/{scene}.gif", "a.b.webp", "{frame}.png", "still.png", "x.npz"}, film),
            (std::vector<std::string>{"out/flag.poster.png", "a.b.poster.png"}));
}

}  // namespace
}  // namespace drape
