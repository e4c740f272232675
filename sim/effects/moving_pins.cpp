#include "sim/effects/moving_pins.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sim/keyframes.hpp"

namespace drape {
namespace {

/// What a keyframe's value says. In the order of the names that it can have.
enum Value : std::size_t { offset, position };

class MovingPins final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("pins", VertexSelection{&pins_}, "", "Which pins; each must be among those of [cloth].").must_be_given();
    keys.add("keyframes", KeyframeList{{"offset", "position"}, &keyframes_, &value_}, "s, m",
             "Where they are at which times: how far from where they start, or where the middle of all of them is. "
             "They start from where the cloth has them at 0 s, do not turn, and stay at the last keyframe.");
    keys.choice("interpolation", interpolation_, {"linear", "smooth"},
                "How they get from one keyframe to the next: at a steady speed, or without jumps of their speed.");
    keys.add("release", &release_, "s", "When they are let go, with the speed that they have; without it never.")
        .at_least(0);
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    const Cloth& cloth = settings.cloth;
    for (const int vertex : pins_) {
      if (std::ranges::binary_search(cloth.pins, vertex)) continue;
      problem("pins", fmt::format("vertex {} is not pinned; [cloth] pins must have it too", vertex));
      break;
    }
    if (pins_.empty()) problem("pins", "expected at least one");
    if (keyframes_.empty() && !release_) problem("", "give 'keyframes', 'release' or both: nothing happens without");
    for (const ActiveEffect& other : settings.effects) {
      if (other.effect.get() == this) break;
      check_overlap(other, problem);
    }
    if (pins_.empty() || keyframes_.empty() || keyframes_.front().time > 0) return;
    const double jump = (keyframes_.front().value - start(cloth)).norm();
    if (jump > largest_jump) {
      problem("keyframes",
              fmt::format("the pins start where the cloth has them, and the keyframe at 0 s is {:.3g} m away "
                          "from there: give it a later time",
                          jump));
    }
  }

  void install(System& system) const override {
    // Once they are released, the system is made for a cloth on which they are not pinned.
    const bool held =
        std::ranges::all_of(pins_, [&](int vertex) { return std::ranges::binary_search(system.cloth.pins, vertex); });
    if (!held) return;
    if (!keyframes_.empty()) system.pin_motions.push_back(motion(system.cloth));
    if (release_) {
      // The first step that begins at that time or later; times are products and must not miss it by their rounding.
      const double step = std::ceil(*release_ / system.step * (1 - 1e-12));
      if (step < most_steps) system.pin_releases.push_back({static_cast<std::int64_t>(step), pins_});
    }
  }

 private:
  static constexpr double largest_jump = 1e-6;  // [m]
  static constexpr double most_steps = 1e15;

  /// The value that a keyframe at 0 s has.
  [[nodiscard]] Eigen::Vector3d start(const Cloth& cloth) const {
    if (value_ == offset) return Eigen::Vector3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int vertex : pins_) sum += cloth.positions.row(vertex).transpose();
    return sum / static_cast<double>(pins_.size());
  }

  [[nodiscard]] PinMotion motion(const Cloth& cloth) const {
    std::vector<Keyframe> keyframes = keyframes_;
    if (keyframes.front().time > 0) keyframes.insert(keyframes.begin(), {0, start(cloth)});
    PinMotion motion{pins_, Vertices(static_cast<Eigen::Index>(pins_.size()), 3),
                     Keyframes(std::move(keyframes), interpolation_)};
    for (std::size_t k = 0; k < pins_.size(); ++k) {
      motion.base.row(static_cast<Eigen::Index>(k)) = cloth.positions.row(pins_[k]);
    }
    if (value_ == position) motion.base.rowwise() -= start(cloth).transpose();
    return motion;
  }

  void check_overlap(const ActiveEffect& other, const ProblemSink& problem) const {
    const auto* moving = dynamic_cast<const MovingPins*>(other.effect.get());
    if (moving == nullptr) return;
    for (const int vertex : pins_) {
      if (!std::ranges::binary_search(moving->pins_, vertex)) continue;
      problem("pins", fmt::format("vertex {} is in two tables [effects.moving_pins]: only one can move it", vertex));
      return;
    }
  }

  std::vector<int> pins_;
  std::vector<Keyframe> keyframes_;
  std::size_t value_ = offset;
  Interpolation interpolation_ = Interpolation::linear;
  std::optional<double> release_;
};

}  // namespace

std::unique_ptr<Effect> make_moving_pins() { return std::make_unique<MovingPins>(); }

}  // namespace drape
