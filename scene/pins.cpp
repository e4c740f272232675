#include "scene/pins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "core/nearest.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

constexpr std::string_view corner_prefix = "corner:";

/// The direction that "x-y+" means: one to three axes, each once and with a sign.
std::optional<Eigen::Vector3d> parse_corner(std::string_view axes) {
  if (axes.empty() || axes.size() % 2 != 0) return std::nullopt;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < axes.size(); i += 2) {
    const std::size_t axis = std::string_view("xyz").find(axes[i]);
    const char sign = axes[i + 1];
    if (axis == std::string_view::npos || (sign != '+' && sign != '-')) return std::nullopt;
    double& component = direction[static_cast<Eigen::Index>(axis)];
    if (component != 0) return std::nullopt;
    component = sign == '+' ? 1 : -1;
  }
  return direction;
}

class PinReader {
 public:
  PinReader(const Vertices* vertices, Problems& problems) : vertices_(vertices), problems_(problems) {}

  void read(const TomlValue& item, const std::string& name) {
    if (item.as<std::int64_t>() != nullptr) {
      read_vertex(item, name);
    } else if (const std::string* text = item.as<std::string>()) {
      read_corner(*text, item.place, name);
    } else if (item.as<TomlTable>() != nullptr) {
      read_box(item, name);
    } else {
      problems_.add(item.place,
                    fmt::format("{}: expected a vertex number, a corner like 'corner:x-y-' or {{ box = … }}, "
                                "found {}",
                                name, item.kind()));
    }
  }

  [[nodiscard]] std::vector<int> pins() && {
    std::sort(pins_.begin(), pins_.end());
    pins_.erase(std::unique(pins_.begin(), pins_.end()), pins_.end());
    return std::move(pins_);
  }

 private:
  void read_vertex(const TomlValue& item, const std::string& name) {
    if (vertices_ == nullptr) return;
    const std::int64_t number = *item.as<std::int64_t>();
    if (number >= 0 && number < vertices_->rows()) {
      pins_.push_back(static_cast<int>(number));
    } else {
      problems_.add(item.place, fmt::format("{}: the mesh has the vertices 0 to {}, found {}", name,
                                            vertices_->rows() - 1, number));
    }
  }

  void read_corner(const std::string& text, const Place& place, const std::string& name) {
    const std::optional<Eigen::Vector3d> direction =
        text.starts_with(corner_prefix) ? parse_corner(std::string_view(text).substr(corner_prefix.size()))
                                        : std::nullopt;
    if (!direction) {
      problems_.add(place,
                    fmt::format("{}: expected a corner like 'corner:x-y-' or 'corner:x+y+z-', found '{}'", name, text));
    } else if (vertices_ != nullptr) {
      pins_.push_back(farthest_vertex(*direction));
    }
  }

  void read_box(const TomlValue& item, const std::string& name) {
    const TomlValue* box = nullptr;
    for (const TomlEntry& entry : item.as<TomlTable>()->entries) {
      if (entry.name == "box") {
        box = &entry.value;
      } else {
        static const std::vector<std::string> forms = {"box"};
        problems_.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                               did_you_mean(entry.name, forms, "the only key is")));
      }
    }
    if (box == nullptr) {
      if (item.as<TomlTable>()->entries.empty()) problems_.add(item.place, name + ": expected { box = … }");
      return;
    }
    const std::string box_name = name + ".box";
    const TomlArray* corners = box->as<TomlArray>();
    if (corners == nullptr || corners->size() != 2) {
      problems_.add(box->place,
                    fmt::format("{}: expected two corners, [[x, y, z], [x, y, z]], found {}", box_name,
                                corners == nullptr ? box->kind() : fmt::format("an array of {}", corners->size())));
      return;
    }
    const auto low = read_vector((*corners)[0], box_name + "[0]", {}, problems_);
    const auto high = read_vector((*corners)[1], box_name + "[1]", {}, problems_);
    if (low && high) add_box(*low, *high, box->place, box_name);
  }

  void add_box(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Place& place, const std::string& name) {
    if (vertices_ == nullptr) return;
    const Eigen::RowVector3d low = a.cwiseMin(b).transpose(), high = a.cwiseMax(b).transpose();
    const std::size_t before = pins_.size();
    for (Eigen::Index i = 0; i < vertices_->rows(); ++i) {
      const auto p = vertices_->row(i).array();
      if ((p >= low.array()).all() && (p <= high.array()).all()) pins_.push_back(static_cast<int>(i));
    }
    if (pins_.size() == before) problems_.add(place, name + ": no vertex of the mesh is in this box");
  }

  [[nodiscard]] int farthest_vertex(const Eigen::Vector3d& direction) const {
    Eigen::Index farthest = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < vertices_->rows(); ++i) {
      const double distance = vertices_->row(i).dot(direction);
      if (distance > most) {
        most = distance;
        farthest = i;
      }
    }
    return static_cast<int>(farthest);
  }

  const Vertices* vertices_;
  Problems& problems_;
  std::vector<int> pins_;
};

}  // namespace

std::vector<int> read_pins(const TomlValue& value, const Vertices* vertices, Problems& problems) {
  const TomlArray* items = value.as<TomlArray>();
  if (items == nullptr) {
    problems.add(value.place, "pins: expected an array, found " + value.kind());
    return {};
  }
  PinReader reader(vertices, problems);
  for (std::size_t i = 0; i < items->size(); ++i) reader.read((*items)[i], fmt::format("pins[{}]", i));
  return std::move(reader).pins();
}

}  // namespace drape
