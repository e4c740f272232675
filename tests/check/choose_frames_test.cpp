#include "check/draw_frames.hpp"

#include <gtest/gtest.h>

namespace drape::choose {
namespace {

/// Makes a film of 200 frames without events.
FilmFacts quiet_film() {
  FilmFacts film;
  film.bodies = {"the sphere", "the ground"};
  film.frames.resize(200);
  for (FrameProperties& frame : film.frames) frame.pins = 4;
  return film;
}

std::string why(const std::vector<ChosenFrame>& chosen, int frame) {
  for (const ChosenFrame& one : chosen) {
    if (one.frame == frame) return one.why;
  }
  return "(not chosen)";
}

TEST(ChooseFrames, TakesTheStartOfAFilmInWhichNothingHappens) {
  const auto chosen = choose_frames(quiet_film());
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].frame, 0);
  EXPECT_EQ(chosen[0].why, "the start");
}

TEST(ChooseFrames, TakesWhatHappens) {
  FilmFacts film = quiet_film();
  for (std::size_t k = 50; k < 200; ++k) film.frames[k].touched = 1;
  for (std::size_t k = 120; k < 130; ++k) film.frames[k].touched = 3;
  for (std::size_t k = 80; k < 200; ++k) film.frames[k].pins = 2;
  film.frames[100].change = 5;
  film.frames[150].kinetic = 3;
  film.frames[165].elastic = 3;
  film.frames[180].area = 9;
  film.frames[190].area = -1;
  const auto chosen = choose_frames(film);
  EXPECT_EQ(why(chosen, 50), "first contact with the sphere");
  EXPECT_EQ(why(chosen, 120), "first contact with the ground");
  EXPECT_EQ(why(chosen, 80), "2 pins are released");
  EXPECT_EQ(why(chosen, 100), "the picture changes most");
  EXPECT_EQ(why(chosen, 150), "most kinetic energy");
  EXPECT_EQ(why(chosen, 165), "most elastic energy");
  EXPECT_EQ(why(chosen, 180), "largest area on screen");
  EXPECT_EQ(why(chosen, 190), "smallest area on screen");
  EXPECT_EQ(chosen.size(), 9u);
  for (std::size_t i = 1; i < chosen.size(); ++i) EXPECT_LT(chosen[i - 1].frame, chosen[i].frame);
}

TEST(ChooseFrames, TellsWhatIsCloseTogetherOnce) {
  FilmFacts film = quiet_film();
  for (std::size_t k = 50; k < 200; ++k) film.frames[k].touched = 1;
  film.frames[50].change = 5;
  film.frames[52].kinetic = 3;
  const auto chosen = choose_frames(film);
  EXPECT_EQ(chosen.size(), 2u);
  EXPECT_EQ(why(chosen, 50),
            "first contact with the sphere; the picture changes most; most kinetic energy at frame 52");
}

TEST(ChooseFrames, TakesADozenAtMost) {
  FilmFacts film = quiet_film();
  for (std::size_t k = 0; k < 200; ++k) film.frames[k].pins = 300 - k;
  EXPECT_EQ(choose_frames(film).size(), 12u);
}

}  // namespace
}  // namespace drape::choose
