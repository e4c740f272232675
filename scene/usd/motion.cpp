#include "scene/usd/motion.hpp"

#include <fmt/format.h>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "drape/sim/tracks.hpp"
#include "scene/usd/layer.hpp"
#include "scene/usd/mesh.hpp"
#include "scene/usd/stage.hpp"

namespace drape {
namespace {

UsdPath moving_prim(const UsdStage& stage) {
  const std::vector<UsdPath> shapes = find_prims(stage, {"Mesh", "Sphere"});
  for (const UsdPath& path : shapes) {
    if (!transform_times(path).empty()) return path;
  }
  if (!shapes.empty()) return shapes.front();
  for (const UsdPath& path : find_prims(stage, {})) {
    if (!transform_times(path).empty()) return path;
  }
  stage.source().fail("there is neither a Mesh nor a Sphere nor a moving prim in the file");
}

/// Returns the time of a time code [s].
double seconds(double code, const UsdLayer& layer, const UsdPrim& prim) {
  const double time = (code - layer.start_time_code) / layer.time_codes_per_second;
  if (!std::isfinite(time)) prim.place.fail("the times of its samples overflow in seconds");
  return time;
}

void bound_points(const UsdAttribute& points, TransformTrack& track) {
  if (points.components != 3 || !points.is_array || points.first() == nullptr) {
    points.place.fail("points: expected an array of point3f, found " + points.type);
  }
  const std::vector<double>& numbers = points.first()->numbers;
  if (numbers.empty()) return;
  const Eigen::Map<const Eigen::Matrix3Xd> positions(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
  const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
  track.center = low / 2 + high / 2;
  track.radius = (positions.colwise() - track.center).colwise().stableNorm().maxCoeff();
}

void bound_sphere(const UsdPrim& prim, const UsdLayer& layer, TransformTrack& track) {
  track.radius = 1;  // default of a Sphere in the USD schema
  const UsdAttribute* radius = prim.find("radius");
  if (radius == nullptr || radius->first() == nullptr) return;
  if (radius->components != 1 || radius->is_array) radius->place.fail("radius: expected one number");
  const auto positive = [](const UsdValue& value) {
    if (value.numbers[0] <= 0) value.place.fail("radius: expected a positive number");
    return value.numbers[0];
  };
  track.radius = positive(*radius->first());
  for (const UsdSample& sample : radius->samples) {
    track.radius_times.push_back(seconds(sample.time, layer, prim));
    track.radii.push_back(positive(sample.value));
  }
}

class UsdSphereTrack final : public SphereTrack {
 public:
  explicit UsdSphereTrack(TransformTrack track) : track_(std::move(track)) {}
  [[nodiscard]] SphereShape at(double time) const override { return track_.sphere_at(time); }

 private:
  TransformTrack track_;
};

}  // namespace

Eigen::Affine3d TransformTrack::at(double time) const {
  const auto [before, after, share] = between(times, time);
  Eigen::Affine3d result = transforms[before];
  if (before != after) result.matrix() += share * (transforms[after].matrix() - transforms[before].matrix());
  return result;
}

double TransformTrack::radius_at(double time) const {
  if (radii.empty()) return radius;
  const auto [before, after, share] = between(radius_times, time);
  return radii[before] + share * (radii[after] - radii[before]);
}

SphereShape TransformTrack::sphere_at(double time) const {
  const Eigen::Affine3d transform = at(time);
  const double stretch = Eigen::JacobiSVD<Eigen::Matrix3d>(transform.linear()).singularValues()[0];
  return {transform * center, stretch * radius_at(time)};
}

TransformTrack read_usd_track(const UsdStage& stage, const UsdPath& path) {
  const UsdLayer& layer = stage.layer();
  const UsdPrim& prim = *path.back();

  TransformTrack track;
  std::vector<double> time_codes = transform_times(path);
  if (time_codes.empty()) time_codes.push_back(layer.start_time_code);
  for (const double code : time_codes) {
    track.times.push_back(seconds(code, layer, prim));
    track.transforms.push_back(world_transform(stage, path, code));
  }
  if (prim.type == "Mesh" && prim.find("points") != nullptr) bound_points(*prim.find("points"), track);
  if (prim.type == "Sphere") bound_sphere(prim, layer, track);
  return track;
}

namespace {

/// Returns true for a Mesh that its skeleton or its points move.
bool deforms(const UsdPath& path) {
  if (path.back()->type != "Mesh") return false;
  const UsdAttribute* points = path.back()->find("points");
  return (points != nullptr && points->samples.size() > 1) || UsdSkin::is_on(path);
}

}  // namespace

TransformTrack read_usd_motion(const SourceText& source) {
  const UsdStage stage(source);
  return read_usd_track(stage, moving_prim(stage));
}

TransformTrack read_usd_motion(const std::filesystem::path& file) { return read_usd_motion(SourceText::read(file)); }

std::shared_ptr<const SphereTrack> read_sphere_track(const std::filesystem::path& file) {
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source, {.moving_points = true});
  const UsdPath path = moving_prim(stage);
  const std::vector<UsdPath> shapes = find_prims(stage, {"Mesh"});
  const auto deforming = std::ranges::find_if(shapes, deforms);
  if (deforms(path) || (transform_times(path).empty() && deforming != shapes.end())) {
    const UsdPrim& mesh = deforms(path) ? *path.back() : *deforming->back();
    mesh.place.fail(
        fmt::format("a track moves a sphere, but the Mesh {} changes its shape: use [[effects.body]] with "
                    "file and prim = \"{}\"",
                    in_quotes(mesh.name), escape_controls(mesh.path)));
  }
  TransformTrack track = read_usd_track(stage, path);
  if (track.times.size() < 2 && track.radii.size() < 2) {
    source.fail("nothing moves in the file: expected a Mesh, a Sphere or an Xform with time samples of its transform");
  }
  return std::make_shared<UsdSphereTrack>(std::move(track));
}

namespace {

/// Largest span of samples [time codes] that is filled with codes in between; no film is longer.
constexpr double most_between = 10'000;
/// Below this every whole number is exact as a double.
constexpr double last_time_code = 1e12;
/// A gigabyte.
constexpr double most_motion_numbers = 1 << 27;

}  // namespace

/// Reader of a mesh moved by its points, transform or skeleton.
class UsdMovingMesh::Reader {
 public:
  Reader(const UsdStage& stage, UsdPath path)
      : stage_(stage), path_(std::move(path)), prim_(*path_.back()), skin_(UsdSkin::of(stage, path_)) {
    const double start = stage_.layer().start_time_code;
    const Eigen::Affine3d to_world = skin_ ? skin_->bound_to_world(start) : world_transform(stage_, path_, start);
    mesh_ = read_mesh_prim(prim_, to_world);
    check_points();
    codes_ = time_codes();
    for (const double code : codes_) {
      times_.push_back((code - start) / stage_.layer().time_codes_per_second);
      if (std::isfinite(times_.back()) && (times_.size() < 2 || times_.back() > times_.end()[-2])) continue;
      fail_beyond(code);
    }
    mesh_.positions = codes_.empty() ? points_at(start) : points(0);
    if (!mesh_.positions.allFinite()) prim_.place.fail("its skeleton takes a point beyond what can be computed");
    if (codes_.size() < 2) times_.clear();
  }

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] Vertices points(std::size_t i) const {
    Vertices x = points_at(codes_[i]);
    if (!x.allFinite()) fail_beyond(codes_[i]);
    return x;
  }

  /// Returns the whole motion.
  [[nodiscard]] MeshMotion read() const {
    if (static_cast<double>(times_.size()) * static_cast<double>(mesh_.positions.size()) > most_motion_numbers) {
      prim_.place.fail(fmt::format("{} samples of {} points take too much memory: export fewer of either",
                                   times_.size(), mesh_.positions.rows()));
    }
    MeshMotion motion{.mesh = mesh_, .times = times_};
    for (std::size_t i = 0; i < times_.size(); ++i) motion.samples.push_back(points(i));
    return motion;
  }

 private:
  /// Checks the number of points of all samples that are read.
  void check_points() const {
    for (const UsdSample& sample : prim_.find("points")->samples) {
      if (!sample.value.located) check_count(sample, sample.value.numbers.size());
    }
  }

  void check_count(const UsdSample& sample, std::size_t numbers) const {
    const auto found = static_cast<Eigen::Index>(numbers / 3);
    if (found == mesh_.positions.rows()) return;
    sample.value.place.fail(
        fmt::format("points: expected {} as in the first sample, found {}: a mesh that moves keeps its points",
                    mesh_.positions.rows(), found));
  }

  /// Checks the number of points of a located sample: the last one up to a time.
  void check_count_at(double code, std::size_t numbers) const {
    if (static_cast<Eigen::Index>(numbers / 3) == mesh_.positions.rows()) return;
    const UsdSample* found = nullptr;
    for (const UsdSample& sample : prim_.find("points")->samples) {
      if (found == nullptr || sample.time <= code) found = &sample;
    }
    if (found != nullptr) check_count(*found, numbers);
  }

  [[noreturn]] void fail_beyond(double code) const {
    prim_.place.fail(fmt::format("at time code {} its motion is beyond what can be computed", code));
  }

  /// Returns the samples' time codes. Where joints or transforms rotate the mesh, every whole code in between is added,
  /// so that rotations between two samples stay small.
  [[nodiscard]] std::vector<double> time_codes() const {
    std::vector<double> codes = skin_ ? skin_->times() : transform_times(path_);
    const bool turns = !codes.empty();
    for (const UsdSample& sample : prim_.find("points")->samples) codes.push_back(sample.time);
    const auto sort = [&] {
      std::sort(codes.begin(), codes.end());
      codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    };
    sort();
    const bool few = turns && codes.front() > -last_time_code && codes.back() < last_time_code;
    if (!few || codes.back() - codes.front() > most_between) return codes;
    const std::size_t samples = codes.size();
    for (std::size_t i = 1; i < samples; ++i) {
      for (double code = std::floor(codes[i - 1]) + 1; code < codes[i]; ++code) codes.push_back(code);
    }
    sort();
    return codes;
  }

  [[nodiscard]] Vertices points_at(double code) const {
    const std::vector<double> points = usd_numbers_at(*prim_.find("points"), code);
    check_count_at(code, points.size());
    Vertices x;
    if (skin_) {
      skin_->pose(code, points, x);
      return x;
    }
    const Eigen::Affine3d to_world = world_transform(stage_, path_, code);
    x.resize(static_cast<Eigen::Index>(points.size() / 3), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      x.row(i) = (to_world * Eigen::Vector3d(&points[static_cast<std::size_t>(3 * i)])).transpose();
    }
    return x;
  }

  const UsdStage& stage_;
  const UsdPath path_;
  const UsdPrim& prim_;
  const std::optional<UsdSkin> skin_;
  Mesh mesh_;
  std::vector<double> codes_, times_;  // times of the samples [time codes], [s]
};

UsdMovingMesh::UsdMovingMesh(const UsdStage& stage, const std::string& prim)
    : reader_(std::make_unique<Reader>(stage, choose_usd_mesh(stage, prim))) {}
UsdMovingMesh::~UsdMovingMesh() = default;

const Mesh& UsdMovingMesh::mesh() const { return reader_->mesh(); }
const std::vector<double>& UsdMovingMesh::times() const { return reader_->times(); }
Vertices UsdMovingMesh::points(std::size_t i) const { return reader_->points(i); }

MeshMotion UsdMovingMesh::read() const { return reader_->read(); }

MeshMotion read_usd_mesh_motion(const UsdStage& stage, const std::string& prim) {
  return UsdMovingMesh(stage, prim).read();
}

MeshMotion read_usd_mesh_motion(const SourceText& source, const std::string& prim) {
  return read_usd_mesh_motion(UsdStage(source, {.moving_points = true}), prim);
}

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
