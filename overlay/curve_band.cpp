#include "overlay/curve_band.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "overlay/color_bar.hpp"

namespace drape {
namespace {

const Rgb rule{0.86, 0.86, 0.86};

}  // namespace

CurveBand::CurveBand(int width, int size, std::string unit, std::vector<double> times, std::vector<Curve> curves)
    : width_(width), size_(size), unit_(std::move(unit)), times_(std::move(times)), curves_(std::move(curves)) {
  for (const Curve& curve : curves_) {
    for (const double value : curve.values) {
      lowest_ = std::min(lowest_, value);
      highest_ = std::max(highest_, value);
    }
  }
  if (highest_ == lowest_) highest_ = lowest_ + 1;
}

void CurveBand::draw_axes(Pen& pen, Image& band, const PictureBox& area) const {
  for (const Tick& mark : ticks(lowest_, highest_, 3)) {
    const double y = area.bottom() - (mark.value - lowest_) / (highest_ - lowest_) * area.height;
    const int row = static_cast<int>(std::lround(y));
    Pen::fill(band, {area.left, row, area.width, 1}, mark.value == 0 ? band_ink : rule);
    pen.write(band, area.left - size_ / 2 - pen.width(mark.label, size_), row + size_ / 3, mark.label, size_, band_ink);
  }
  const double end = times_.back() - times_.front();
  const auto column = [&](const Tick& mark) {
    const double along = end > 0 ? (mark.value - times_.front()) / end : 0;
    return area.left + static_cast<int>(std::lround(along * (area.width - 1)));
  };
  const LabelColumns label = [&](const Tick& mark) {
    const int width = pen.width(mark.label + " s", size_);
    const int left = std::clamp(column(mark) - width / 2, 0, std::max(0, width_ - width));
    return std::pair{left, left + width};
  };
  const std::vector<Tick> marks = ticks(times_.front(), times_.back(), std::clamp(area.width / (5 * size_), 2, 10));
  for (const Tick& mark : thinned(marks, label, size_ / 2)) {
    Pen::fill(band, {column(mark), area.bottom(), 1, std::max(2, size_ / 4)}, band_ink);
    pen.write(band, label(mark).first, area.bottom() + size_ + size_ / 3, mark.label + " s", size_, band_ink);
  }
}

void CurveBand::draw_legend(Pen& pen, Image& band, int left) const {
  const int base = size_ + size_ / 3;
  const std::string unit = "[" + unit_ + "]";
  int at = left;
  for (const Curve& curve : curves_) {
    Pen::fill(band, {at, base - size_ / 2, size_, std::max(2, size_ / 5)}, curve.color);
    pen.write(band, at + size_ + size_ / 3, base, curve.name, size_, band_ink);
    at += size_ + size_ / 3 + pen.width(curve.name, size_) + size_;
  }
  pen.write(band, at - size_ / 2, base, unit, size_, band_ink);
}

Image CurveBand::draw(Pen& pen, double time) const {
  Image band(width_, height(size_));
  Pen::fill(band, {0, 0, band.width, band.height}, band_paper);
  int labels = 0;  // greatest width of the vertical axis' labels
  for (const Tick& mark : ticks(lowest_, highest_, 3)) labels = std::max(labels, pen.width(mark.label, size_));
  const int left = labels + size_, top = 2 * size_ + size_ / 4;
  const PictureBox area{left, top, std::max(1, width_ - left - size_), band.height - top - 2 * size_};
  draw_axes(pen, band, area);
  draw_legend(pen, band, left);
  const double end = times_.back() - times_.front();
  const auto x = [&](double t) { return area.left + (end > 0 ? (t - times_.front()) / end : 0) * (area.width - 1); };
  const auto y = [&](double v) { return area.bottom() - (v - lowest_) / (highest_ - lowest_) * area.height; };
  const double stroke = std::max(1.5, size_ / 7.0);
  const auto shown = static_cast<std::size_t>(
      std::upper_bound(times_.begin(), times_.end(), time + 1e-9 * std::max(1.0, std::abs(time))) - times_.begin());
  for (const Curve& curve : curves_) {
    for (std::size_t i = 1; i < shown; ++i) {
      Pen::line(band, x(times_[i - 1]), y(curve.values[i - 1]), x(times_[i]), y(curve.values[i]), stroke, curve.color);
    }
    if (shown == 0) continue;
    const double at = x(times_[shown - 1]), level = y(curve.values[shown - 1]);
    Pen::line(band, at, level, at, level, 3 * stroke, curve.color);
  }
  return band;
}

}  // namespace drape
