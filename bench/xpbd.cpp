#include "bench/xpbd.hpp"

#include <cmath>
#include <cstddef>

namespace drape::textbook {
namespace {

using Index = std::size_t;

/// Arrays of a colour's pass.
struct Pass {
  const int *first, *second;
  const double *rest, *compliance, *inverse_masses;
  double *x, *y, *z;
};

/// Moves the ends of all springs of a colour. No vertex occurs twice, so the loop has no dependencies.
#if defined(__x86_64__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
void project(const Pass& p, int count) {
  double *const x = p.x, *const y = p.y, *const z = p.z;
#pragma GCC ivdep
  for (int s = 0; s < count; ++s) {
    const int i = p.first[s], j = p.second[s];
    const double dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double push = (length - p.rest[s]) / (p.compliance[s] * length);
    const double mine = p.inverse_masses[i] * push, other = p.inverse_masses[j] * push;
    x[i] += mine * dx;
    y[i] += mine * dy;
    z[i] += mine * dz;
    x[j] -= other * dx;
    y[j] -= other * dy;
    z[j] -= other * dz;
  }
}

}  // namespace

Xpbd::Xpbd(const Cloth& cloth, const Settings& settings) : Stepper(cloth, settings) {
  const auto count = static_cast<Index>(cloth.vertex_count());
  inverse_masses_ = cloth.masses.array().inverse();
  for (const int pin : cloth.pins) inverse_masses_[pin] = 0;
  std::vector<std::vector<char>> used;  // by colour and vertex
  for (const Spring& spring : cloth.springs) {
    const auto i = static_cast<Index>(spring.i), j = static_cast<Index>(spring.j);
    Index color = 0;
    while (color < used.size() && (used[color][i] != 0 || used[color][j] != 0)) ++color;
    if (color == used.size()) {
      used.emplace_back(count, 0);
      colors_.emplace_back();
    }
    used[color][i] = used[color][j] = 1;
    colors_[color].first.push_back(spring.i);
    colors_[color].second.push_back(spring.j);
    colors_[color].rest.push_back(spring.rest_length);
    colors_[color].compliance.push_back(inverse_masses_[spring.i] + inverse_masses_[spring.j] +
                                        1 / (spring.stiffness * settings.step * settings.step));
  }
}

void Xpbd::step() {
  const double h = settings_.step;
  const Eigen::MatrixXd before = positions;
  const Eigen::ArrayXd free = (inverse_masses_ > 0).cast<double>();
  positions.array() += h * ((velocities.rowwise() + h * settings_.gravity.transpose()).array().colwise() * free);
  for (const Color& color : colors_) {
    project({color.first.data(), color.second.data(), color.rest.data(), color.compliance.data(),
             inverse_masses_.data(), positions.col(0).data(), positions.col(1).data(), positions.col(2).data()},
            static_cast<int>(color.first.size()));
  }
  velocities = std::pow(settings_.damping, h) / h * (positions - before);
}

}  // namespace drape::textbook
