#include "compare/panels.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "drape/render/overlay/caption.hpp"
#include "render/overlay/color_scale.hpp"
#include "render/overlay/diagrams.hpp"

namespace drape {
namespace {

constexpr int gap = 6;  // gap between panels [pixels]
constexpr std::uint8_t paper = 255;

/// Returns a unit in which a length has few digits, and its number per metre.
std::pair<const char*, double> unit_of(double length) {
  if (length >= 0.5) return {"m", 1};
  return length >= 5e-4 ? std::pair{"mm", 1e3} : std::pair{"µm", 1e6};
}

constexpr int decades = 3;  // of distances below the limit

/// Returns the place of a distance on the logarithmic scale, 0 to 1.
/// @param part the distance as a fraction of the limit
double along_scale(double part) { return part <= 0 ? 0 : std::clamp(1 + std::log10(part) / decades, 0.0, 1.0); }

}  // namespace

Eigen::VectorXd distances(const Frame& frame, const Frame& other, const VertexOrder& order) {
  if (order.empty()) return (frame.positions - other.positions).rowwise().norm();
  return (frame.positions - in_order(other.positions, order)).rowwise().norm();
}

PanelColors::PanelColors(const std::vector<LoadedScene>& scenes, const std::vector<std::string>& labels,
                         bool difference, std::optional<double> limit)
    : difference_(difference), first_(labels.front()) {
  const Look& look = scenes.front().look;
  if (difference) {
    scale_.emplace(limit);
    matches_ = match_scenes(scenes);
  } else if (look.color_by) {
    for (const Scene& scene : scenes) measures_.emplace_back(*look.color_by, scene.simulation.cloth);
    scale_.emplace(look.color_limit);
  }
}

Eigen::VectorXd PanelColors::values(const std::vector<const Frame*>& frames, std::size_t panel) const {
  return difference_ ? distances(*frames[panel], *frames.front(), matches_[panel].order)
                     : measures_[panel](*frames[panel]);
}

void PanelColors::survey(const std::vector<const Frame*>& frames) {
  if (!scale_) return;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Eigen::VectorXd numbers = values(frames, i);
    // Equal motions, such as all at their start, have no distance that a limit could show.
    if (difference_ && (numbers.size() == 0 || numbers.maxCoeff() == 0)) continue;
    scale_->survey(numbers);
  }
}

std::vector<Rgb> PanelColors::colors(const std::vector<const Frame*>& frames, std::size_t panel) const {
  // The first scene is the reference, and keeps its own look.
  if (!scale_ || (difference_ && panel == 0)) return {};
  const Eigen::VectorXd numbers = values(frames, panel);
  if (!difference_) return scale_->colors(numbers);
  std::vector<Rgb> colors;
  const double limit = scale_->limit();
  for (const double distance : numbers) colors.push_back(viridis(along_scale(distance / limit)));
  return colors;
}

Image PanelColors::bar(Pen& pen, int width, int size) const {
  if (difference_) return distance_bar(pen, width, size);
  return color_bar(pen, width, size, measures_.front().title(), scale_->marks(measures_.front().factor()));
}

Image PanelColors::distance_bar(Pen& pen, int width, int size) const {
  const double limit = scale_->limit();
  const auto [unit, count] = unit_of(limit);
  std::vector<Tick> marks;
  for (int k = decades; k >= 0; --k) {
    const double part = std::pow(10, -k);
    marks.push_back({along_scale(part), fmt::format("{:.4g}", limit * part * count)});
  }
  marks.front().label.insert(0, "≤ ");
  marks.back().label.insert(0, "≥ ");
  std::string title = fmt::format("distance from the first, {} [{}]", first_, unit);
  if (!has_room_for_title(pen, width, size, title)) title = fmt::format("distance from the first [{}]", unit);
  return color_bar(pen, width, size, title, marks);
}

PanelLayout::PanelLayout(Pen& pen, const std::vector<std::string>& labels, const Eigen::Vector2i& panel, int columns,
                         int rows, int extra, bool bar)
    : panel_(panel),
      columns_(columns),
      rows_(rows),
      text_(std::max(11, drape::text_size(panel.y()) * 5 / 6)),
      bar_(bar) {
  const int count = static_cast<int>(labels.size());
  if (columns_ == 0) columns_ = count <= 3 ? count : static_cast<int>(std::ceil(std::sqrt(count)));
  if (rows_ == 0) rows_ = (count + columns_ - 1) / columns_;
  if (columns_ * rows_ < count) {
    throw UsageError(fmt::format("--grid {}x{} has {} places, but {} motions are compared", columns_, rows_,
                                 columns_ * rows_, count));
  }
  for (const std::string& label : labels) {
    heads_.push_back(pen.wrap(label, text_, panel.x() - text_));
    lines_ = std::max(lines_, static_cast<int>(heads_.back().size()));
  }
  lines_ += extra;
}

int PanelLayout::head_height() const { return lines_ * Pen::line_height(text_) + text_ / 2; }
int PanelLayout::foot_height() const { return Pen::line_height(text_) + text_ / 2; }

Eigen::Vector2i PanelLayout::size() const {
  return {columns_ * panel_.x() + (columns_ - 1) * gap, rows_ * (panel_.y() + head_height()) + (rows_ - 1) * gap +
                                                            foot_height() + (bar_ ? color_bar_height(text_) : 0)};
}

Image PanelLayout::under_head(Pen& pen, const Image& panel, const std::vector<std::string>& lines) const {
  Image whole(panel.width, head_height());
  Pen::fill(whole, {0, 0, whole.width, whole.height}, band_paper);
  int base = text_ + text_ / 4;
  for (const std::string& line : lines) {
    const int size = fitting_size([&](int s) { return pen.width(line, s); }, text_, panel.width - text_);
    pen.write(whole, text_ / 2, base, line, size, band_ink);
    base += Pen::line_height(text_);
  }
  append_below(whole, panel);
  return whole;
}

Image PanelLayout::compose(Pen& pen, const std::vector<Image>& panels, const std::vector<std::string>& extra,
                           const std::string& time, const std::optional<Image>& bar) const {
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    std::vector<std::string> lines = heads_[i];
    if (!extra.empty()) lines.push_back(extra[i]);
    pictures.push_back(under_head(pen, panels[i], lines));
  }
  Image blank(panel_.x(), panel_.y() + head_height());
  std::fill(blank.pixels.begin(), blank.pixels.end(), paper);
  pictures.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), blank);
  std::vector<const Image*> list;
  for (const Image& picture : pictures) list.push_back(&picture);
  Image whole = montage(list, columns_, gap, paper);
  Image foot(whole.width, foot_height());
  Pen::fill(foot, {0, 0, foot.width, foot.height}, band_paper);
  pen.write(foot, text_ / 2, text_ + text_ / 4, time, text_, band_ink);
  append_below(whole, foot);
  if (bar) append_below(whole, *bar);
  return whole;
}

}  // namespace drape
