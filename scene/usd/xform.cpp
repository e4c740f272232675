#include "scene/usd/xform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "scene/usd/value.hpp"

namespace drape {
namespace {

constexpr std::string_view reset_stack = "!resetXformStack!";
constexpr std::string_view invert_prefix = "!invert!";
constexpr std::string_view operation_prefix = "xformOp:";

Eigen::Affine3d rotation(std::string_view axes, const std::vector<double>& degrees) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (const char axis : axes) {
    // The first axis named acts first. Angles are ordered x, y, z for any order of axes; a single axis has one angle.
    const auto index = static_cast<std::size_t>(axis - 'X');
    const double angle = degrees[axes.size() == 1 ? 0 : index] * std::numbers::pi / 180;
    result = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis - 'X')) * result;
  }
  return result;
}

const UsdValue* operation_order(const UsdPrim& prim) {
  const UsdAttribute* order = prim.find("xformOpOrder");
  return order == nullptr || !order->value ? nullptr : &*order->value;
}

/// A transform operation of a prim, such as xformOp:rotateXYZ.
class Operation {
 public:
  /// @param name the `index`-th of xformOpOrder, without !invert!
  Operation(const UsdPrim& prim, std::string_view name, std::size_t index) : attribute_(prim.find(name)) {
    const std::string_view after = name.substr(std::min(name.size(), operation_prefix.size()));
    kind_ = after.substr(0, after.find(':'));
    if (!name.starts_with(operation_prefix) || attribute_ == nullptr) {
      usd_value_place(*operation_order(prim), index)
          .fail(fmt::format("the prim {} has no operation {}", in_quotes(prim.name), in_quotes(name)));
    }
    const std::size_t components = expected_components();
    if (components == 0) {
      attribute_->place.fail(
          fmt::format("unknown operation {}: expected xformOp:translate, scale, rotateX, rotateY, rotateZ, "
                      "rotateXYZ or another order of these, orient or transform",
                      in_quotes(name)));
    }
    if (attribute_->is_array || attribute_->components != components) {
      attribute_->place.fail(fmt::format("{}: expected a type of {} numbers, found {}{}", name, components,
                                         attribute_->type, attribute_->is_array ? "[]" : ""));
    }
  }

  [[nodiscard]] Eigen::Affine3d at(double time) const {
    const std::vector<double> v = usd_numbers_at(*attribute_, time);
    if (v.empty()) return Eigen::Affine3d::Identity();
    if (kind_ == "translate") return Eigen::Affine3d(Eigen::Translation3d(v[0], v[1], v[2]));
    if (kind_ == "scale") return Eigen::Affine3d(Eigen::Scaling(v[0], v[1], v[2]));
    if (kind_ == "orient") return Eigen::Affine3d(usd_quaternion(v.data()));
    if (kind_ != "transform") return rotation(kind_.substr(6), v);
    return usd_affine(v.data(), place());
  }

  [[nodiscard]] SourcePlace place() const {
    return attribute_->first() != nullptr ? attribute_->first()->place : attribute_->place;
  }

 private:
  [[nodiscard]] std::size_t expected_components() const {
    if (kind_ == "transform") return 16;
    if (kind_ == "orient") return 4;
    if (kind_ == "translate" || kind_ == "scale") return 3;
    if (!kind_.starts_with("rotate")) return 0;
    std::string axes(kind_.substr(6));
    if (axes == "X" || axes == "Y" || axes == "Z") return 1;
    std::sort(axes.begin(), axes.end());
    return axes == "XYZ" ? 3 : 0;
  }

  const UsdAttribute* attribute_;
  std::string_view kind_;
};

bool resets_stack(const UsdPrim& prim) {
  const UsdValue* order = operation_order(prim);
  return order != nullptr &&
         std::find(order->strings.begin(), order->strings.end(), reset_stack) != order->strings.end();
}

/// Returns the transform from prim to parent coordinates. The last operation of the order acts first.
Eigen::Affine3d local_transform(const UsdPrim& prim, double time) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  const UsdValue* order = operation_order(prim);
  if (order == nullptr) return result;
  for (std::size_t i = 0; i < order->strings.size(); ++i) {
    std::string_view name = order->strings[i];
    if (name == reset_stack) continue;
    const bool inverted = name.starts_with(invert_prefix);
    if (inverted) name.remove_prefix(invert_prefix.size());
    const Operation operation(prim, name, i);
    const Eigen::Affine3d matrix = operation.at(time);
    if (inverted && !(std::abs(matrix.linear().determinant()) > 0)) {
      operation.place().fail(fmt::format("{} cannot be inverted", name));
    }
    result = result * (inverted ? matrix.inverse() : matrix);
  }
  return result;
}

}  // namespace

Eigen::Affine3d usd_affine(const double* m, const SourcePlace& place) {
  Eigen::Affine3d result;
  result.matrix() = Eigen::Map<const Eigen::Matrix4d>(m);  // rows of USD's matrix become columns
  if (result.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    place.fail("the matrix is not affine: its last column must be 0, 0, 0, 1");
  }
  return result;
}

Eigen::Affine3d world_transform(const UsdStage& stage, const UsdPath& path, double time) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    result = local_transform(**prim, time) * result;
    if (resets_stack(**prim)) break;
  }
  if (!stage.layer().z_up) {
    // Exactly (x, y, z) → (x, −z, y): a rotation by π/2 would add rounding errors to every coordinate.
    Eigen::Matrix3d to_z_up;
    to_z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    result = Eigen::Affine3d(to_z_up) * result;
  }
  result = Eigen::Scaling(stage.layer().metres_per_unit) * result;
  if (!result.matrix().allFinite()) {
    path.back()->place.fail(fmt::format("the transform of {} overflows", in_quotes(path.back()->name)));
  }
  return result;
}

std::vector<double> transform_times(const UsdPath& path) {
  std::vector<double> times;
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    if (const UsdValue* order = operation_order(**prim)) {
      for (std::string_view name : order->strings) {
        if (name.starts_with(invert_prefix)) name.remove_prefix(invert_prefix.size());
        const UsdAttribute* attribute = (*prim)->find(name);
        if (attribute == nullptr) continue;
        for (const UsdSample& sample : attribute->samples) times.push_back(sample.time);
      }
    }
    if (resets_stack(**prim)) break;
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace drape
