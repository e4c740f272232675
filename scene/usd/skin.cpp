#include "scene/usd/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "scene/usd/mesh_prim.hpp"
#include "scene/usd/value.hpp"
#include "scene/usd/xform.hpp"

namespace drape {
namespace {

constexpr std::array<const char*, 3> motion_names = {"translations", "rotations", "scales"};

std::vector<Eigen::Affine3d> matrices(const UsdValue& value) {
  std::vector<Eigen::Affine3d> result;
  for (std::size_t i = 0; i < value.numbers.size(); i += 16) {
    result.push_back(usd_affine(&value.numbers[i], usd_value_place(value, i)));
  }
  return result;
}

void check_count(const UsdValue& value, std::string_view name, std::size_t found, std::size_t expected) {
  if (found != expected) value.place.fail(fmt::format("{}: expected {} elements, found {}", name, expected, found));
}

std::optional<std::size_t> place_of(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

/// Returns the nearest existing ancestor of a joint in the tree of names: "Hip" for "Hip/Knee".
std::optional<std::size_t> parent_of(const std::vector<std::string>& joints, std::string_view joint) {
  for (std::size_t slash = joint.rfind('/'); slash != std::string_view::npos; slash = joint.rfind('/')) {
    joint = joint.substr(0, slash);
    if (const auto parent = place_of(joints, joint)) return parent;
  }
  return std::nullopt;
}

UsdPath prim_at(const UsdStage& stage, const UsdPath& from, const std::string& path, const char* relationship) {
  UsdPath found = stage.find(path);
  if (found.empty()) {
    from.back()->place.fail(fmt::format("the {} of {} names {}, and there is no such prim", relationship,
                                        in_quotes(from.back()->name), in_quotes(path)));
  }
  return found;
}

}  // namespace

bool UsdSkin::is_on(const UsdPath& mesh) {
  return !inherited_target(mesh, "skel:skeleton").empty() &&
         inherited_attribute(mesh, "primvars:skel:jointIndices") != nullptr;
}

std::optional<UsdSkin> UsdSkin::of(const UsdStage& stage, const UsdPath& mesh) {
  if (!is_on(mesh)) return std::nullopt;
  const std::string target = inherited_target(mesh, "skel:skeleton");
  UsdSkin skin(stage, prim_at(stage, mesh, target, "skel:skeleton"));
  skin.read_skeleton();
  skin.read_animation();
  skin.read_influences(mesh);
  return skin;
}

void UsdSkin::read_skeleton() {
  const UsdPrim& prim = *skeleton_.back();
  joints_ = usd_array(prim, "joints", 0).strings;
  for (const std::string& joint : joints_) parents_.push_back(parent_of(joints_, joint));
  const UsdValue& bind = usd_array(prim, "bindTransforms", 16);
  check_count(bind, "bindTransforms", bind.numbers.size() / 16, joints_.size());
  for (const Eigen::Affine3d& matrix : matrices(bind)) {
    if (!(std::abs(matrix.linear().determinant()) > 0)) bind.place.fail("bindTransforms: one cannot be inverted");
    unbind_.push_back(matrix.inverse());
  }
  if (prim.find("restTransforms") != nullptr) {
    const UsdValue& rest = usd_array(prim, "restTransforms", 16);
    check_count(rest, "restTransforms", rest.numbers.size() / 16, joints_.size());
    rest_ = matrices(rest);
    return;
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {  // rest transforms equal the bind transforms
    const Eigen::Affine3d bound = unbind_[j].inverse();
    rest_.push_back(parents_[j] ? unbind_[*parents_[j]] * bound : bound);
  }
}

void UsdSkin::read_animation() {
  animated_.resize(joints_.size());
  const std::string target = inherited_target(skeleton_, "skel:animationSource");
  if (target.empty()) return;
  animation_ = prim_at(*stage_, skeleton_, target, "skel:animationSource").back();
  const std::vector<std::string>& names = usd_array(*animation_, "joints", 0).strings;
  for (std::size_t j = 0; j < joints_.size(); ++j) animated_[j] = place_of(names, joints_[j]);
  for (const char* motion : motion_names) {
    const std::size_t components = motion == motion_names[1] ? 4 : 3;
    const bool may_be_left_out = motion == motion_names[2];
    if (may_be_left_out && animation_->find(motion) == nullptr) continue;
    usd_array(*animation_, motion, components);
    const UsdAttribute& attribute = *animation_->find(motion);
    const auto check = [&](const UsdValue& value) {
      check_count(value, motion, value.numbers.size() / components, names.size());
    };
    if (attribute.samples.empty()) check(*attribute.value);
    for (const UsdSample& sample : attribute.samples) check(sample.value);
  }
}

void UsdSkin::read_influences(const UsdPath& mesh) {
  if (const UsdAttribute* matrix = inherited_attribute(mesh, "primvars:skel:geomBindTransform")) {
    if (matrix->components != 16 || matrix->is_array) matrix->place.fail("geomBindTransform: expected a matrix4d");
    geometry_ = usd_affine(matrix->first()->numbers.data(), matrix->first()->place);
  }
  if (const UsdAttribute* method = inherited_attribute(mesh, "skel:skinningMethod")) {
    const std::vector<std::string>& name = method->first()->strings;
    if (name != std::vector<std::string>{"classicLinear"}) {
      method->place.fail("skel:skinningMethod: expected \"classicLinear\", which is the one that is known");
    }
  }
  const UsdAttribute& indices = *inherited_attribute(mesh, "primvars:skel:jointIndices");
  const UsdAttribute* weights = inherited_attribute(mesh, "primvars:skel:jointWeights");
  if (weights == nullptr) indices.place.fail("there are jointIndices, but no jointWeights");
  const UsdValue& numbers = *indices.first();
  check_count(*weights->first(), "jointWeights", weights->first()->numbers.size(), numbers.numbers.size());
  if (weights->element_size != indices.element_size) {
    weights->place.fail(fmt::format("jointWeights: expected the elementSize of jointIndices, {}, found {}",
                                    indices.element_size, weights->element_size));
  }
  per_point_ = indices.element_size;
  rigid_ = indices.interpolation == "constant";

  // Indices refer to the mesh's own list of joints, if it has one.
  std::vector<std::string> own = joints_;
  if (const UsdAttribute* list = inherited_attribute(mesh, "skel:joints")) own = list->first()->strings;
  for (std::size_t i = 0; i < numbers.numbers.size(); ++i) {
    const double number = numbers.numbers[i];
    const bool known = number >= 0 && number < static_cast<double>(own.size()) && number == std::floor(number);
    const auto joint = known ? place_of(joints_, own[static_cast<std::size_t>(number)]) : std::nullopt;
    if (!joint) {
      usd_value_place(numbers, i)
          .fail(fmt::format("jointIndices: expected one of the {} joints, found {}", own.size(), number));
    }
    influences_.push_back({*joint, weights->first()->numbers[i]});
  }
}

std::vector<double> UsdSkin::times() const {
  std::vector<double> times = transform_times(skeleton_);
  for (const char* motion : motion_names) {
    const UsdAttribute* attribute = animation_ == nullptr ? nullptr : animation_->find(motion);
    if (attribute == nullptr) continue;
    for (const UsdSample& sample : attribute->samples) times.push_back(sample.time);
  }
  return times;
}

Eigen::Affine3d UsdSkin::bound_to_world(double time) const {
  return world_transform(*stage_, skeleton_, time) * geometry_;
}

std::vector<Eigen::Affine3d> UsdSkin::joints_at(double time) const {
  std::vector<Eigen::Affine3d> local = rest_;
  if (animation_ != nullptr) {
    const std::vector<double> translations = usd_numbers_at(*animation_->find("translations"), time);
    const std::vector<double> rotations = usd_numbers_at(*animation_->find("rotations"), time);
    const UsdAttribute* scales = animation_->find("scales");
    const std::vector<double> sizes = scales == nullptr ? std::vector<double>() : usd_numbers_at(*scales, time);
    for (std::size_t j = 0; j < local.size(); ++j) {
      if (!animated_[j]) continue;
      const std::size_t a = *animated_[j];
      local[j] = Eigen::Translation3d(Eigen::Vector3d(&translations[3 * a])) * usd_quaternion(&rotations[4 * a]);
      if (!sizes.empty()) local[j] = local[j] * Eigen::Scaling(Eigen::Vector3d(&sizes[3 * a]));
    }
  }
  std::vector<Eigen::Affine3d> joints;
  for (std::size_t j = 0; j < local.size(); ++j) {
    Eigen::Affine3d place = local[j];
    for (auto parent = parents_[j]; parent; parent = parents_[*parent]) place = local[*parent] * place;
    joints.push_back(place);
  }
  return joints;
}

void UsdSkin::pose(double time, const std::vector<double>& points, Vertices& x) const {
  const std::size_t count = points.size() / 3;
  const std::size_t expected = rigid_ ? per_point_ : count * per_point_;
  if (influences_.size() != expected) {
    skeleton_.back()->place.fail(
        fmt::format("a mesh on this skeleton has {} jointIndices: expected {}, which are {} "
                    "for each of its {} points",
                    influences_.size(), expected, per_point_, rigid_ ? 1 : count));
  }
  const Eigen::Affine3d to_world = world_transform(*stage_, skeleton_, time);
  std::vector<Eigen::Affine3d> moves = joints_at(time);
  for (std::size_t j = 0; j < moves.size(); ++j) moves[j] = to_world * moves[j] * unbind_[j] * geometry_;
  x.resize(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (std::size_t k = 0; k < per_point_; ++k) {
      const Influence& influence = influences_[(rigid_ ? 0 : i * per_point_) + k];
      if (influence.weight == 0) continue;
      sum += influence.weight * (moves[influence.joint] * p);
      weights += influence.weight;
    }
    // Points without joint weights keep their bound position.
    x.row(static_cast<Eigen::Index>(i)) = (weights == 0 ? to_world * geometry_ * p : sum / weights).transpose();
  }
}

}  // namespace drape
