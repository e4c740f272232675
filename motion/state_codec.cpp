#include "motion/state_codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "motion/blocks.hpp"

namespace drape {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// Returns the difference of bits modulo 2⁶⁴, which is invertible. Zigzag encoding maps small differences of either
/// sign to small words: 0, −1, 1, −2, …
std::uint64_t difference(double value, double predicted) {
  const std::uint64_t d = bits(value) - bits(predicted);
  return d << 1 ^ (d >> 63 == 0 ? 0 : ~std::uint64_t{0});
}

double undone(std::uint64_t word, double predicted) {
  const std::uint64_t d = word >> 1 ^ ((word & 1) == 0 ? 0 : ~std::uint64_t{0});
  const auto value = std::bit_cast<double>(d + bits(predicted));
  if (!std::isfinite(value)) throw std::invalid_argument("holds a number that is not finite");
  return value;
}

}  // namespace

std::array<double, StateCodec::most_known> StateCodec::weights(int order, std::int64_t step) const {
  std::array<double, most_known> w{};
  for (int i = 0; i < order; ++i) {
    w[static_cast<std::size_t>(i)] = 1;
    for (int j = 0; j < order; ++j) {
      if (j == i) continue;
      w[static_cast<std::size_t>(i)] *=
          static_cast<double>(step - before(j + 1).step) / static_cast<double>(before(i + 1).step - before(j + 1).step);
    }
  }
  return w;
}

template <class Use>
void StateCodec::predict(int how, bool velocities, const State& state, Eigen::Index stride, const Use& use) const {
  const Eigen::Index count = 3 * vertices_;
  const auto field = [&](const State& s) { return velocities ? s.v.data() : s.x.data(); };
  if (how == by_way || how == by_mean_way) {
    const double* const x = state.x.data();
    const double* const x1 = before(1).x.data();
    const double* const v1 = before(1).v.data();
    const double duration = static_cast<double>(state.step - before(1).step) * step_;
    for (Eigen::Index i = 0; i < count; i += stride) {
      const double mean = (x[i] - x1[i]) / duration;
      use(i, how == by_way ? mean : 2 * mean - v1[i]);
    }
    return;
  }
  const std::array<double, most_known> w = weights(how, state.step);
  std::array<const double*, most_known> past{};
  for (int k = 0; k < how; ++k) past[static_cast<std::size_t>(k)] = field(before(k + 1));
  for (Eigen::Index i = 0; i < count; i += stride) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(how); ++k)
      sum = k == 0 ? w[k] * past[k][i] : sum + w[k] * past[k][i];
    use(i, sum);
  }
}

int StateCodec::best(bool velocities, const State& state) const {
  constexpr Eigen::Index looked_at = 512;  // sampled numbers
  const Eigen::Index stride = std::max<Eigen::Index>(1, 3 * vertices_ / looked_at);
  const double* const values = velocities ? state.v.data() : state.x.data();
  int best = 0;
  std::int64_t least = -1;
  for (int how = 0; how <= (velocities && known_ > 0 ? static_cast<int>(by_mean_way) : known_); ++how) {
    if (how > known_ && how < by_way) continue;
    std::int64_t cost = 0;
    predict(how, velocities, state, stride,
            [&](Eigen::Index i, double predicted) { cost += std::bit_width(difference(values[i], predicted)); });
    if (least >= 0 && cost >= least) continue;
    least = cost;
    best = how;
  }
  return best;
}

State& StateCodec::next_place() {
  newest_ = (newest_ + 1) % most_known;
  known_ = std::min(known_ + 1, most_known);
  return states_[static_cast<std::size_t>(newest_)];
}

std::string StateCodec::encode(const State& state) {
  const auto count = static_cast<std::size_t>(3 * vertices_);
  std::vector<std::uint64_t> words(2 * count);
  const int places = best(false, state), velocities = best(true, state);
  predict(places, false, state, 1, [&](Eigen::Index i, double predicted) {
    words[static_cast<std::size_t>(i)] = difference(state.x.data()[i], predicted);
  });
  predict(velocities, true, state, 1, [&](Eigen::Index i, double predicted) {
    words[count + static_cast<std::size_t>(i)] = difference(state.v.data()[i], predicted);
  });
  next_place() = state;
  return ByteWriter()
      .whole(static_cast<std::uint64_t>(state.step))
      .whole(static_cast<std::uint64_t>(places) + 256 * static_cast<std::uint64_t>(velocities))
      .bytes(pack_planes(words))
      .text();
}

const State& StateCodec::decode(std::string_view bytes) {
  ByteReader reader(bytes);
  State state;
  state.step = static_cast<std::int64_t>(reader.whole());
  const std::uint64_t how = reader.whole();
  const auto places = static_cast<int>(how % 256), velocities = static_cast<int>(how / 256 % 256);
  const bool by_places = velocities == by_way || velocities == by_mean_way;
  if (how >= 65536 || places > known_ || (velocities > known_ && !(by_places && known_ > 0))) {
    throw std::invalid_argument("has a state that is foretold from what is not there");
  }
  if (state.step < 0 || (known_ > 0 && state.step <= before(1).step)) {
    throw std::invalid_argument("has steps that are not in order");
  }
  const auto count = static_cast<std::size_t>(3 * vertices_);
  const std::vector<std::uint64_t> words = unpack_planes(reader.rest(), 2 * count);
  state.x.resize(vertices_, 3);
  state.v.resize(vertices_, 3);
  predict(places, false, state, 1, [&](Eigen::Index i, double predicted) {
    state.x.data()[i] = undone(words[static_cast<std::size_t>(i)], predicted);
  });
  predict(velocities, true, state, 1, [&](Eigen::Index i, double predicted) {
    state.v.data()[i] = undone(words[count + static_cast<std::size_t>(i)], predicted);
  });
  return next_place() = std::move(state);
}

}  // namespace drape
