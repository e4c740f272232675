#include "check/name_difference.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "core/installation.hpp"
#include "core/machine.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

constexpr int position_bits = 29;        // bits below the largest coordinate of the cloth at rest
constexpr double compared_part = 0.1;    // share of the tolerance
constexpr int smallest_exponent = -900;  // exponent limit of all quanta, so that their multiples are normal numbers

constexpr double largest_multiple = 0x1p52;

// The constraints of these effects may hold by less than a rounding error.
constexpr std::array<std::string_view, 2> exact_effects{SelfCollision::name, StrainLimit::name};

/// Returns the largest power of two up to a number.
double power_below(double number) { return std::exp2(std::max(std::ilogb(number), smallest_exponent)); }

double nearest(double value, double quantum) {
  const double multiple = std::nearbyint(value / quantum);
  return std::abs(multiple) < largest_multiple ? multiple * quantum : value;  // larger values are multiples already
}

}  // namespace

RoundingUnits quanta_for(const SimulationSettings& settings, double motion_tolerance) {
  RoundingUnits quanta;
  quanta.compared = power_below(std::max(compared_part * motion_tolerance, least_quantum));
  const bool exact = std::any_of(settings.effects.begin(), settings.effects.end(), [](const Effect& effect) {
    return std::find(exact_effects.begin(), exact_effects.end(), effect.name()) != exact_effects.end();
  });
  if (exact) return quanta;
  const double extent = settings.cloth.positions.size() == 0 ? 1 : settings.cloth.positions.cwiseAbs().maxCoeff();
  const double fine = power_below(std::max(extent, 1e-200) * std::exp2(1 - position_bits));
  quanta.position = std::min(fine, quanta.compared);
  quanta.velocity = RoundingUnits::velocity_factor * quanta.position;
  return quanta;
}

Vertices rounded(const Vertices& values, double quantum, const std::vector<int>& exact_rows) {
  if (quantum == 0) return values;
  Vertices result = values.unaryExpr([quantum](double value) { return nearest(value, quantum); });
  for (const int row : exact_rows) result.row(row) = values.row(row);
  return result;
}

std::vector<double> rounded(std::vector<double> numbers, double quantum) {
  for (double& number : numbers) number = nearest(number, quantum);
  return numbers;
}

State rounded(const State& state, const std::vector<int>& pins, const RoundingUnits& quanta) {
  return {
      .x = rounded(state.x, quanta.position, pins), .v = rounded(state.v, quanta.velocity, pins), .step = state.step};
}

Machine this_machine(std::string renderer) {
  const BuildInfo& build = build_info();
  const MachineFacts facts = machine_facts();
  return {.drape = build.version,
          .compiler = build.compiler,
          .system = facts.system,
          .processor = facts.processor,
          .cpu_flags = fmt::format("{}", fmt::join(facts.flags, " ")),
          .kernels = std::string(kernels().name),
          .renderer = std::move(renderer)};
}

nlohmann::ordered_json to_json(const Machine& machine) {
  return {{"drape", machine.drape},         {"compiler", machine.compiler},   {"system", machine.system},
          {"processor", machine.processor}, {"cpu_flags", machine.cpu_flags}, {"kernels", machine.kernels},
          {"renderer", machine.renderer}};
}

std::string utc_now() {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

namespace {

using Plane = Eigen::ArrayXXd;  // columns × rows of the picture

constexpr double explained = 0.25;          // largest unexplained share of the squared difference
constexpr Eigen::Index farthest_shift = 6;  // search radius [pixels]
constexpr double steep = 24;                // smallest gradient of an edge [of 255]
constexpr double one_place = 0.1;           // largest share of the picture's area
constexpr double least_share = 0.02;        // smallest share of channels changed by another brightness

Plane luminance(const Image& image) {
  Plane plane(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      plane(x, y) = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];  // ITU-R BT.709
    }
  }
  return plane;
}

/// Returns central differences in x and y; 0 on the border.
std::array<Plane, 2> gradients(const Plane& plane) {
  std::array<Plane, 2> g{Plane::Zero(plane.rows(), plane.cols()), Plane::Zero(plane.rows(), plane.cols())};
  for (Eigen::Index y = 1; y + 1 < plane.cols(); ++y) {
    for (Eigen::Index x = 1; x + 1 < plane.rows(); ++x) {
      g[0](x, y) = (plane(x + 1, y) - plane(x - 1, y)) / 2;
      g[1](x, y) = (plane(x, y + 1) - plane(x, y - 1)) / 2;
    }
  }
  return g;
}

/// Returns the part of `plane` that stays inside under all shifts within the search radius, shifted by (dx, dy).
auto moved(const Plane& plane, int dx, int dy) {
  return plane.block(farthest_shift - dx, farthest_shift - dy, plane.rows() - 2 * farthest_shift,
                     plane.cols() - 2 * farthest_shift);
}

/// Finds the best whole-pixel shift, and the remaining fraction by linearisation (Lucas and Kanade 1981).
std::string name_shift(const Plane& expected, const Plane& actual) {
  if (expected.rows() <= 4 * farthest_shift || expected.cols() <= 4 * farthest_shift) return {};
  const Plane target = moved(actual, 0, 0);
  const double unmoved = (target - moved(expected, 0, 0)).square().sum();
  Eigen::Vector2d whole = Eigen::Vector2d::Zero();
  double best = unmoved;
  for (int dy = -farthest_shift; dy <= farthest_shift; ++dy) {
    for (int dx = -farthest_shift; dx <= farthest_shift; ++dx) {
      const double left = (target - moved(expected, dx, dy)).square().sum();
      if (left < best) {
        best = left;
        whole = {dx, dy};
      }
    }
  }
  const Plane base = moved(expected, static_cast<int>(whole[0]), static_cast<int>(whole[1]));
  const std::array<Plane, 2> g = gradients(base);
  const Plane difference = target - base;
  Eigen::Matrix2d normal;
  normal << g[0].square().sum(), (g[0] * g[1]).sum(), (g[0] * g[1]).sum(), g[1].square().sum();
  if (normal.determinant() <= 0) return {};
  const Eigen::Vector2d part = normal.inverse() * Eigen::Vector2d((g[0] * difference).sum(), (g[1] * difference).sum());
  const double left = (difference - g[0] * part[0] - g[1] * part[1]).square().sum();
  // The picture moves against the gradient.
  const Eigen::Vector2d shift = whole - part;
  if (!(left < explained * unmoved) || part.norm() > 1 || shift.norm() < 0.005) return {};
  const auto along = [](double way, const char* forth, const char* back) {
    return fmt::format("{:.2g} pixels {}", std::abs(way), way < 0 ? back : forth);
  };
  const bool sideways = std::abs(shift[0]) >= 0.1 * shift.norm(), upright = std::abs(shift[1]) >= 0.1 * shift.norm();
  return "a shift by " + (sideways ? along(shift[0], "to the right", "to the left") : "") +
         (sideways && upright ? " and " : "") + (upright ? along(shift[1], "down", "up") : "");
}

/// Fits one brightness factor to all changed channels.
std::string name_brightness(const Image& expected, const Image& actual) {
  double changed = 0, product = 0, square = 0, all = 0;
  const auto visit = [&](auto&& add) {
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
      if (expected.pixels[i] != actual.pixels[i]) add(double{1} * expected.pixels[i], double{1} * actual.pixels[i]);
    }
  };
  visit([&](double a, double b) {
    changed += 1;
    product += a * b;
    square += a * a;
    all += (b - a) * (b - a);
  });
  const double factor = product / square;
  double left = 0;
  visit([&](double a, double b) { left += (b - factor * a) * (b - factor * a); });
  if (changed < least_share * static_cast<double>(expected.pixels.size()) || !(left < explained * all)) return {};
  return fmt::format("a brightness {:.2g} % {}", 100 * std::abs(factor - 1), factor > 1 ? "higher" : "lower");
}

/// Fits one new colour to all pixels of the same old colour.
std::string name_colors(const Image& expected, const Image& actual) {
  constexpr int levels = 32;  // levels per channel
  struct Bin {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    double square = 0, count = 0;
  };
  std::vector<Bin> bins(std::size_t{levels} * levels * levels);
  double all = 0;
  for (std::size_t i = 0; i < expected.pixels.size(); i += 3) {
    const std::uint8_t *p = &expected.pixels[i], *q = &actual.pixels[i];
    const Eigen::Array3d difference(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    Bin& bin = bins[(p[0] / 8 * std::size_t{levels} + p[1] / 8) * levels + p[2] / 8];
    bin.sum += difference;
    bin.square += difference.square().sum();
    bin.count += 1;
    all += difference.square().sum();
  }
  double left = 0;
  for (const Bin& bin : bins) left += bin.count > 0 ? bin.square - bin.sum.square().sum() / bin.count : 0;
  return left < explained * all ? "different colours in the same places" : "";
}

std::string name_edges(const Plane& expected, const Plane& actual) {
  const std::array<Plane, 2> a = gradients(expected), b = gradients(actual);
  const Plane steepest = a[0].abs().max(a[1].abs()).max(b[0].abs()).max(b[1].abs());
  const Plane square = (actual - expected).square();
  const double elsewhere = (steepest < steep / 2).select(square, 0).sum();
  return elsewhere < 0.1 * square.sum() ? "edges only: of lines, outlines or a texture" : "";
}

std::string name_place(const Plane& expected, const Plane& actual) {
  Eigen::Index left = expected.rows(), right = -1, top = expected.cols(), bottom = -1;
  for (Eigen::Index y = 0; y < expected.cols(); ++y) {
    for (Eigen::Index x = 0; x < expected.rows(); ++x) {
      if (expected(x, y) == actual(x, y)) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  if (right < 0) return {};
  const Eigen::Index width = right - left + 1, height = bottom - top + 1;
  if (static_cast<double>(width * height) > one_place * static_cast<double>(expected.size())) return {};
  return fmt::format("one place only: {}x{} pixels at column {}, row {}", width, height, left, top);
}

}  // namespace

std::string classify_difference(const Image& expected, const Image& actual) {
  if (expected == actual) return {};
  const Plane a = luminance(expected), b = luminance(actual);
  for (const std::string& name :
       {name_place(a, b), name_shift(a, b), name_brightness(expected, actual), name_colors(expected, actual)}) {
    if (!name.empty()) return name;
  }
  return name_edges(a, b);
}

std::string name_other_machine(const Machine& recorded, const Machine& here) {
  std::string text;
  const auto add = [&](const char* what, const std::string& there, const std::string& now) {
    if (there.empty() || now.empty() || there == now) return;
    text += fmt::format("{}{} ({}; here {})", text.empty() ? "with " : ", ", what, there, now);
  };
  add("a different renderer", recorded.renderer, here.renderer);
  add("a different instruction set", recorded.kernels, here.kernels);
  add("a different version of drape", recorded.drape, here.drape);
  add("a different compiler", recorded.compiler, here.compiler);
  add("a different processor", recorded.processor, here.processor);
  return text;
}

}  // namespace drape
