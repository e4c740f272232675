#include "check/choose_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace drape {
namespace {

constexpr std::size_t most_chosen = 12;
constexpr std::size_t close_part = 50;  // closer than 1/50 of the film, frames look alike

class FrameChoice {
 public:
  explicit FrameChoice(std::size_t frames) : close_(static_cast<int>(frames / close_part)) {}

  void offer(int frame, const std::string& why) {
    const auto near = std::find_if(chosen_.begin(), chosen_.end(),
                                   [&](const ChosenFrame& other) { return std::abs(other.frame - frame) <= close_; });
    if (near != chosen_.end()) {
      near->why += near->frame == frame ? "; " + why : fmt::format("; {} at frame {}", why, frame);
    } else if (chosen_.size() < most_chosen) {
      chosen_.push_back({frame, why});
    }
  }

  std::vector<ChosenFrame> take() {
    std::sort(chosen_.begin(), chosen_.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return std::move(chosen_);
  }

 private:
  int close_;
  std::vector<ChosenFrame> chosen_;
};

void offer_contacts(const FilmFacts& film, FrameChoice& choice) {
  for (std::size_t body = 0; body < film.bodies.size(); ++body) {
    const auto touches = [&](const FrameProperties& frame) { return (frame.touched >> body & 1) != 0; };
    const auto first = std::find_if(film.frames.begin(), film.frames.end(), touches);
    if (first == film.frames.end()) continue;
    choice.offer(static_cast<int>(first - film.frames.begin()), "first contact with " + film.bodies[body]);
  }
}

void offer_releases(const FilmFacts& film, FrameChoice& choice) {
  for (std::size_t k = 1; k < film.frames.size(); ++k) {
    const std::size_t before = film.frames[k - 1].pins, now = film.frames[k].pins;
    if (now >= before) continue;
    choice.offer(static_cast<int>(k),
                 before - now == 1 ? "a pin is released" : fmt::format("{} pins are released", before - now));
  }
}

void offer_extremes(const FilmFacts& film, FrameChoice& choice) {
  const auto offer = [&](double FrameProperties::*fact, const char* most, const char* least) {
    const auto [lowest, highest] = std::minmax_element(film.frames.begin(), film.frames.end(),
                                                       [&](const auto& a, const auto& b) { return a.*fact < b.*fact; });
    if (!((*lowest).*fact < (*highest).*fact)) return;  // constant
    choice.offer(static_cast<int>(highest - film.frames.begin()), most);
    if (least != nullptr) choice.offer(static_cast<int>(lowest - film.frames.begin()), least);
  };
  offer(&FrameProperties::change, "the picture changes most", nullptr);
  offer(&FrameProperties::kinetic, "most kinetic energy", nullptr);
  offer(&FrameProperties::elastic, "most elastic energy", nullptr);
  offer(&FrameProperties::area, "largest area on screen", "smallest area on screen");
}

}  // namespace

std::vector<ChosenFrame> choose_frames(const FilmFacts& film) {
  FrameChoice choice(film.frames.size());
  choice.offer(0, "the start");
  offer_contacts(film, choice);
  offer_releases(film, choice);
  offer_extremes(film, choice);
  return choice.take();
}

}  // namespace drape
