#pragma once

#include <array>
#include <string>
#include <string_view>

#include "sim/system.hpp"

namespace drape {

/// Lossless codec from states of a motion to bytes: it stores each state as its difference from a prediction by
/// earlier states. docs/reference/motion-file.md describes the format for readers.
class StateCodec {
 public:
  /// @param vertices number of vertices of the cloth
  /// @param step     h [s]
  StateCodec(Eigen::Index vertices, double step) : vertices_(vertices), step_(step) {}

  /// Forgets all earlier states, so that the next one can be decoded alone.
  void begin_group() { known_ = 0; }

  /// Encodes the next state, of a later step than the last one.
  std::string encode(const State& state);

  /// Decodes the next state; valid until the next call.
  /// @throws std::invalid_argument, see packing.hpp
  const State& decode(std::string_view bytes);

 private:
  static constexpr int most_known = 4;  // number of earlier states used for prediction

  /// Method of prediction: an order of extrapolation, 0 (none) to 4, or for velocities one of these.
  enum Predictor { by_way = 5, by_mean_way = 6 };

  /// Returns the k-th state before the next one, from 1 on.
  [[nodiscard]] const State& before(int k) const {
    return states_[static_cast<std::size_t>((newest_ + 1 + most_known - k) % most_known)];
  }
  [[nodiscard]] std::array<double, most_known> weights(int order, std::int64_t step) const;
  /// Calls use(i, prediction) for every `stride`-th number of a field.
  template <class Use>
  void predict(int how, bool velocities, const State& state, Eigen::Index stride, const Use& use) const;
  [[nodiscard]] int best(bool velocities, const State& state) const;
  /// Returns the storage for the next state, which replaces the oldest.
  State& next_place();

  Eigen::Index vertices_;
  double step_;
  std::array<State, most_known> states_;  // ring buffer
  int newest_ = 0, known_ = 0;
};

}  // namespace drape
