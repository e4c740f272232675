#pragma once

#include <array>
#include <string>
#include <string_view>

#include "sim/system.hpp"

namespace drape {

/// Makes states of a motion into bytes and back, to the bit: each as what differs from what those before it foretell.
/// docs/motion-file.md says how, in the words of whoever reads the bytes.
class StateCodec {
 public:
  /// @param vertices of the cloth
  /// @param step     h [s]
  StateCodec(Eigen::Index vertices, double step) : vertices_(vertices), step_(step) {}

  /// Forgets the states before, so that the next one can be read without them.
  void begin_group() { known_ = 0; }

  /// The next state, of a later step than the last one.
  std::string encode(const State& state);

  /// The inverse; the state holds until the next call.
  /// @throws std::invalid_argument, see packing.hpp
  const State& decode(std::string_view bytes);

 private:
  static constexpr int most_known = 4;  // of the states before the next one

  /// What a number is foretold from: an order of extrapolation, 0 (nothing) to 4, or for velocities one of those.
  enum Foretelling { by_way = 5, by_mean_way = 6 };

  /// The k-th state before the next one, from 1 on.
  [[nodiscard]] const State& before(int k) const {
    return states_[static_cast<std::size_t>((newest_ + 1 + most_known - k) % most_known)];
  }
  [[nodiscard]] std::array<double, most_known> weights(int order, std::int64_t step) const;
  /// Calls use(i, foretold) for every `stride`-th number of a field.
  template <class Use>
  void foretell(int how, bool velocities, const State& state, Eigen::Index stride, const Use& use) const;
  [[nodiscard]] int best(bool velocities, const State& state) const;
  /// The place for the next state; the oldest is forgotten.
  State& next_place();

  Eigen::Index vertices_;
  double step_;
  std::array<State, most_known> states_;  // a ring
  int newest_ = 0, known_ = 0;
};

}  // namespace drape
