#include "scene/pins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "scene/values.hpp"

namespace drape {
namespace {

constexpr std::string_view corner_prefix = "corner:", edge_prefix = "edge:";

class PinReader {
 public:
  PinReader(const SelectableMesh* mesh, Problems& problems)
      : mesh_(mesh), vertices_(mesh == nullptr ? nullptr : &mesh->positions), problems_(problems) {}

  void read(const TomlValue& item, const std::string& name) {
    if (item.as<std::int64_t>() != nullptr) {
      read_vertex(item, name);
    } else if (const std::string* text = item.as<std::string>()) {
      read_text(*text, item.place, name);
    } else if (item.as<TomlTable>() != nullptr) {
      const std::vector<int> selected = read_selection(item, name, mesh_, problems_);
      pins_.insert(pins_.end(), selected.begin(), selected.end());
    } else {
      problems_.add(item.place,
                    fmt::format("{}: expected a vertex number, 'corner:x-y-', 'edge:x-', 'border' or {{ box = … }}, "
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

  void read_text(const std::string& text, const Place& place, const std::string& name) {
    if (text == "border") {
      if (mesh_ == nullptr) return;
      for (const std::vector<int>& ring : border_rings(mesh_->triangles))
        pins_.insert(pins_.end(), ring.begin(), ring.end());
      return;
    }
    const bool edge = text.starts_with(edge_prefix), corner = text.starts_with(corner_prefix);
    std::optional<Eigen::Vector3d> direction;
    if (edge || corner) direction = parse_direction(std::string_view(text).substr(text.find(':') + 1));
    if (!direction) {
      problems_.add(place, fmt::format("{}: expected a corner like 'corner:x-y-', an edge like 'edge:x-' or 'border', "
                                       "found '{}'",
                                       name, text));
    } else if (vertices_ != nullptr && corner) {
      pins_.push_back(farthest_vertex(*direction));
    } else if (vertices_ != nullptr) {
      add_edge(*direction);
    }
  }

  /// Pins every vertex that is farthest in a direction, up to rounding.
  void add_edge(const Eigen::Vector3d& direction) {
    const Eigen::VectorXd distances = *vertices_ * direction;
    constexpr double rounding = 1e-6;
    const double least = distances.maxCoeff() - rounding * (distances.maxCoeff() - distances.minCoeff());
    for (Eigen::Index i = 0; i < distances.size(); ++i) {
      if (distances[i] >= least) pins_.push_back(static_cast<int>(i));
    }
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

  const SelectableMesh* mesh_;
  const Vertices* vertices_;
  Problems& problems_;
  std::vector<int> pins_;
};

}  // namespace

std::vector<int> read_pins(const TomlValue& value, const SelectableMesh* mesh, Problems& problems) {
  const TomlArray* items = value.as<TomlArray>();
  if (items == nullptr) {
    problems.add(value.place, "pins: expected an array, found " + value.kind());
    return {};
  }
  PinReader reader(mesh, problems);
  for (std::size_t i = 0; i < items->size(); ++i) reader.read((*items)[i], fmt::format("pins[{}]", i));
  return std::move(reader).pins();
}

}  // namespace drape
