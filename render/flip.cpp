#include "render/flip.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "drape/render/image.hpp"

namespace drape {
namespace {

using Plane = Eigen::ArrayXXd;        // a channel, columns × rows of the picture
using Planes = std::array<Plane, 3>;  // the channels of a colour space
using Kernel = Eigen::ArrayXd;        // 2·radius + 1 weights
using Color = Eigen::Vector3d;

// Constants of the paper, sections 4 and 5.
constexpr double color_exponent = 0.7;                                     // q_c
constexpr double feature_exponent = 0.5;                                   // q_f
constexpr double redistribution_color = 0.4, redistribution_error = 0.95;  // p_c, p_t
constexpr double feature_width = 0.082;                                    // w [degrees]

/// Returns the matrix from linear RGB to XYZ, for the primaries and white point of sRGB, in the authors' fractions.
const Eigen::Matrix3d& xyz_from_rgb() {
  static const Eigen::Matrix3d matrix = [] {
    Eigen::Matrix3d m;
    m << 10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794,  //
        2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897,     //
        1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382;
    return m;
  }();
  return matrix;
}

/// Returns the XYZ of white, linear RGB (1, 1, 1).
const Color& white() {
  static const Color xyz = xyz_from_rgb() * Color::Ones();
  return xyz;
}

/// Converts to the opponent space YCxCz, which resembles L*a*b* but is linear, as filters require.
Color opponent_from_rgb(const Color& rgb) {
  const Color t = (xyz_from_rgb() * rgb).cwiseQuotient(white());
  return {116 * t.y() - 16, 500 * (t.x() - t.y()), 200 * (t.y() - t.z())};
}

Color rgb_from_opponent(const Color& opponent) {
  static const Eigen::Matrix3d rgb_from_xyz = xyz_from_rgb().inverse();
  const double y = (opponent[0] + 16) / 116;
  const Color t{y + opponent[1] / 500, y, y - opponent[2] / 200};
  return rgb_from_xyz * t.cwiseProduct(white());
}

/// Converts to L*a*b* with colours that fade in the dark (Hunt's effect): a and b are multiplied by L/100.
Color hunt_lab_from_rgb(const Color& rgb) {
  constexpr double delta = 6. / 29;
  const Color t = (xyz_from_rgb() * rgb).cwiseQuotient(white()).unaryExpr([](double value) {
    return value > delta * delta * delta ? std::cbrt(value) : value / (3 * delta * delta) + 4. / 29;
  });
  const double lightness = 116 * t.y() - 16;
  return {lightness, 0.01 * lightness * 500 * (t.x() - t.y()), 0.01 * lightness * 200 * (t.y() - t.z())};
}

/// Returns the HyAB distance of two colours: city-block in lightness, Euclidean in colour.
double hyab(const Color& a, const Color& b) {
  const Color difference = a - b;
  return std::abs(difference[0]) + std::hypot(difference[1], difference[2]);
}

Planes opponent_planes(const Image& image) {
  static const std::array<double, 256> light = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgb_to_linear(static_cast<double>(i) / 255);
    return table;
  }();
  Planes planes;
  planes.fill(Plane(image.width, image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      const Color color = opponent_from_rgb({light[pixel[0]], light[pixel[1]], light[pixel[2]]});
      for (std::size_t c = 0; c < 3; ++c) planes[c](x, y) = color[static_cast<Eigen::Index>(c)];
    }
  }
  return planes;
}

/// Correlates rows with one kernel and columns with the other; border pixels are repeated outside.
Plane convolved(const Plane& plane, const Kernel& across, const Kernel& down) {
  const Eigen::Index radius = across.size() / 2, width = plane.rows(), height = plane.cols();
  Plane wide(width + 2 * radius, height), rows = Plane::Zero(width, height), result = Plane::Zero(width, height);
  wide.middleRows(radius, width) = plane;
  wide.topRows(radius).rowwise() = plane.row(0).eval();
  wide.bottomRows(radius).rowwise() = plane.row(width - 1).eval();
  for (Eigen::Index y = 0; y < height; ++y) {
    for (Eigen::Index k = 0; k < across.size(); ++k) rows.col(y) += across[k] * wide.col(y).segment(k, width);
  }
  for (Eigen::Index y = 0; y < height; ++y) {
    for (Eigen::Index k = -radius; k <= radius; ++k) {
      result.col(y) += down[k + radius] * rows.col(std::clamp<Eigen::Index>(y + k, 0, height - 1));
    }
  }
  return result;
}

/// Returns exp(−x²/scale) for x = −radius … radius, times `unit`.
Kernel bell(int radius, double scale, double unit) {
  const Kernel x = Kernel::LinSpaced(2 * radius + 1, -radius, radius) * unit;
  return (-x.square() / scale).exp();
}

/// Contrast sensitivity of the eye in one channel: the sum of two Gaussians a·√(π/b)·exp(−π²x²/b). All channels have a
/// common radius and are normalised to a sum of 1 (section 4.1).
struct Sensitivity {
  double a1, b1, a2, b2;

  [[nodiscard]] Plane apply(const Plane& plane, double pixels_per_degree) const {
    constexpr double pi = std::numbers::pi, widest = 0.04;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
    const Kernel first = bell(radius, b1 / (pi * pi), 1 / pixels_per_degree);
    Plane sum = a1 * std::sqrt(pi / b1) * convolved(plane, first, first);
    double total = a1 * std::sqrt(pi / b1) * first.sum() * first.sum();
    if (a2 != 0) {
      const Kernel second = bell(radius, b2 / (pi * pi), 1 / pixels_per_degree);
      sum += a2 * std::sqrt(pi / b2) * convolved(plane, second, second);
      total += a2 * std::sqrt(pi / b2) * second.sum() * second.sum();
    }
    return sum / total;
  }
};

constexpr std::array<Sensitivity, 3> sensitivities{
    {{1, 0.0047, 0, 0}, {1, 0.0053, 0, 0}, {34.1, 0.04, 13.5, 0.025}}};  // achromatic, red-green, blue-yellow

/// Returns a picture as perceived: filtered, clamped to the display's range, in a perceptually uniform space.
Planes perceived(const Planes& opponent, double pixels_per_degree) {
  Planes planes;
  for (std::size_t c = 0; c < 3; ++c) planes[c] = sensitivities[c].apply(opponent[c], pixels_per_degree);
  for (Eigen::Index i = 0; i < planes[0].size(); ++i) {
    const Color rgb = rgb_from_opponent({planes[0](i), planes[1](i), planes[2](i)});
    const Color lab = hunt_lab_from_rgb(rgb.cwiseMax(0).cwiseMin(1));
    for (std::size_t c = 0; c < 3; ++c) planes[c](i) = lab[static_cast<Eigen::Index>(c)];
  }
  return planes;
}

/// Returns the magnitudes of edges and points in a picture's lightness (section 4.3), by the first and second
/// derivative of a Gaussian. Positive weights are normalised to a sum of 1, negative ones to −1.
std::array<Plane, 2> features(const Plane& achromatic, double pixels_per_degree) {
  const double deviation = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const Kernel x = Kernel::LinSpaced(2 * radius + 1, -radius, radius);
  const Kernel gauss = bell(radius, 2 * deviation * deviation, 1);
  const Plane lightness = (achromatic + 16) / 116;
  const auto magnitude = [&](const Kernel& derivative) -> Plane {
    const double positive = derivative.max(0).sum(), negative = -derivative.min(0).sum();
    const Kernel along = derivative.max(0) / positive + derivative.min(0) / negative, aside = gauss / gauss.sum();
    return (convolved(lightness, along, aside).square() + convolved(lightness, aside, along).square()).sqrt();
  };
  return {magnitude(-x * gauss), magnitude((x.square() / (deviation * deviation) - 1) * gauss)};
}

/// Maps exponentiated colour distances to [0, 1]; small distances get most of the range (section 4.2).
double redistributed(double distance) {
  static const double largest =
      std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), color_exponent);
  const double knee = redistribution_color * largest;
  if (distance < knee) return redistribution_error / knee * distance;
  return redistribution_error + (distance - knee) / (largest - knee) * (1 - redistribution_error);
}

}  // namespace

double default_pixels_per_degree() { return 0.7 * 3840 / 0.7 * std::numbers::pi / 180; }

ErrorMap flip_error(const Image& reference, const Image& test, double pixels_per_degree) {
  if (reference.width != test.width || reference.height != test.height) {
    throw std::invalid_argument("flip_error() needs two pictures of the same size");
  }
  const Planes opponent_a = opponent_planes(reference), opponent_b = opponent_planes(test);
  const Planes a = perceived(opponent_a, pixels_per_degree), b = perceived(opponent_b, pixels_per_degree);
  const auto features_a = features(opponent_a[0], pixels_per_degree);
  const auto features_b = features(opponent_b[0], pixels_per_degree);

  ErrorMap map{.width = reference.width, .height = reference.height, .values = {}};
  map.values.reserve(static_cast<std::size_t>(a[0].size()));
  for (Eigen::Index i = 0; i < a[0].size(); ++i) {  // planes are column-major, columns × rows: the picture's own order
    const double distance = hyab({a[0](i), a[1](i), a[2](i)}, {b[0](i), b[1](i), b[2](i)});
    const double color = redistributed(std::pow(distance, color_exponent));
    const double edges = std::abs(features_a[0](i) - features_b[0](i));
    const double points = std::abs(features_a[1](i) - features_b[1](i));
    const double feature = std::pow(std::max(edges, points) / std::numbers::sqrt2, feature_exponent);
    map.values.push_back(static_cast<float>(std::pow(color, 1 - feature)));
  }
  return map;
}

Image magma(const ErrorMap& map) {
  cv::Mat bytes(map.height, map.width, CV_8UC1), bgr;
  std::transform(map.values.begin(), map.values.end(), bytes.begin<std::uint8_t>(),
                 [](float value) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.F, 1.F))); });
  cv::applyColorMap(bytes, bgr, cv::COLORMAP_MAGMA);
  Image image(map.width, map.height);
  cv::cvtColor(bgr, cv::Mat(map.height, map.width, CV_8UC3, image.pixels.data()), cv::COLOR_BGR2RGB);
  return image;
}

}  // namespace drape
