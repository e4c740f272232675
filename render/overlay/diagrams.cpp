#include "render/overlay/diagrams.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "drape/render/overlay/caption.hpp"
#include "render/overlay/color_scale.hpp"

namespace drape {

namespace {

/// Returns the largest 1, 2 or 5 times a power of ten up to a positive number.
double round_down(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-9));
  for (const double factor : {5.0, 2.0}) {
    if (number >= factor * power * (1 - 1e-9)) return factor * power;
  }
  return power;
}

}  // namespace

double round_up(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (number <= factor * power * (1 + 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<Tick> ticks(double from, double to, int about) {
  if (!(to > from)) return {{from, fmt::format("{:g}", from)}};
  const double step = round_down((to - from) / about);
  std::vector<Tick> marks;
  for (double k = std::ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) {
    const double value = k == 0 ? 0 : k * step;  // avoids -0
    marks.push_back({value, fmt::format("{:g}", value)});
  }
  return marks;
}

std::vector<Tick> thinned(const std::vector<Tick>& marks, const LabelColumns& columns, int gap) {
  if (marks.empty()) return {};
  const auto zero = static_cast<std::size_t>(std::ranges::find(marks, 0.0, &Tick::value) - marks.begin());
  const std::size_t kept_mark = zero < marks.size() ? zero : 0;
  for (double every = 1; every < static_cast<double>(marks.size()); every = round_up(1.5 * every)) {
    std::vector<Tick> kept;
    const auto stride = static_cast<std::size_t>(every);
    for (std::size_t i = kept_mark % stride; i < marks.size(); i += stride) kept.push_back(marks[i]);
    const auto touch = [&](const Tick& a, const Tick& b) { return columns(b).first < columns(a).second + gap; };
    if (std::ranges::adjacent_find(kept, touch) == kept.end()) return kept;
  }
  return {marks[kept_mark]};
}

int fitting_size(const std::function<int(int)>& width, int size, int room) {
  while (size > least_text_size && width(size) > room) --size;
  return size;
}

namespace {

/// Appends the last of all marks to the kept ones, in place of those that are too near, unless only one would be left.
void keep_last(const Tick& last, const LabelColumns& columns, int gap, std::vector<Tick>& kept) {
  if (kept.back().value == last.value) return;
  const auto touches = [&](const Tick& mark) { return columns(last).first < columns(mark).second + gap; };
  while (kept.size() > 1 && touches(kept.back())) kept.pop_back();
  if (!touches(kept.back())) kept.push_back(last);
}

int bar_margin(int width, int size) { return std::min(2 * size, width / 6); }

}  // namespace

int color_bar_height(int size) { return 2 * Pen::line_height(size) + 2 * size; }

bool has_room_for_title(Pen& pen, int width, int size, const std::string& title) {
  return pen.width(title, least_text_size) <= width - bar_margin(width, size);
}

Image color_bar(Pen& pen, int width, int size, const std::string& title, const std::vector<Tick>& marks) {
  Image band(width, color_bar_height(size));
  Pen::fill(band, {0, 0, band.width, band.height}, band_paper);
  const int margin = bar_margin(width, size), base = size + size / 4;
  const int title_size = fitting_size([&](int s) { return pen.width(title, s); }, size, width - margin);
  pen.write(band, margin, base, title, title_size, band_ink);
  const PictureBox bar{margin, base + size / 2, width - 2 * margin, size};
  for (int x = 0; x < bar.width; ++x) {
    Pen::fill(band, {bar.left + x, bar.top, 1, bar.height},
              viridis(static_cast<double>(x) / std::max(1, bar.width - 1)));
  }
  const auto column = [&](const Tick& mark) {
    return bar.left + static_cast<int>(std::lround(mark.value * (bar.width - 1)));
  };
  const LabelColumns label = [&](const Tick& mark) {
    const int taken = pen.width(mark.label, size);
    const int left = std::clamp(column(mark) - taken / 2, 0, std::max(0, width - taken));
    return std::pair{left, left + taken};
  };
  std::vector<Tick> kept = thinned(marks, label, size / 2);
  if (!kept.empty()) keep_last(marks.back(), label, size / 2, kept);
  for (const Tick& mark : kept) {
    Pen::fill(band, {column(mark), bar.bottom(), 1, std::max(2, size / 4)}, band_ink);
    pen.write(band, label(mark).first, bar.bottom() + size + size / 3, mark.label, size, band_ink);
  }
  return band;
}

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

std::vector<Tick> CurveBand::levels(int rows) const {
  const LabelColumns label_rows = [&](const Tick& mark) {  // upwards
    const int base = static_cast<int>(std::lround((mark.value - lowest_) / (highest_ - lowest_) * rows));
    return std::pair{base, base + size_};
  };
  return thinned(ticks(lowest_, highest_, 3), label_rows, -size_ / 8);  // digits are lower than the font's size
}

void CurveBand::draw_axes(Pen& pen, Image& band, const PictureBox& area) const {
  for (const Tick& mark : levels(area.height)) {
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
  const std::string unit = "[" + unit_ + "]";
  const auto entry_width = [&](const Curve& curve, int size) {
    return size + size / 3 + pen.width(curve.name, size) + size;
  };
  std::vector<std::span<const Curve>> rows{curves_};
  const auto width = [&](int size) {
    int most = 0;
    for (const std::span<const Curve> row : rows) {
      int sum = pen.width(unit, size) - size / 2;
      for (const Curve& curve : row) sum += entry_width(curve, size);
      most = std::max(most, sum);
    }
    return most;
  };
  int size = fitting_size(width, size_, width_ - left), base = size_ + size_ / 3;
  if (width(size) > width_ - left) {  // two rows of smaller letters have room above the curves
    const std::size_t half = (curves_.size() + 1) / 2;
    rows = {std::span(curves_).first(half), std::span(curves_).subspan(half)};
    size = fitting_size(width, 3 * size_ / 4, width_ - left);
    base = Pen::line_height(size);
  }
  for (const std::span<const Curve>& row : rows) {
    int at = left;
    for (const Curve& curve : row) {
      Pen::fill(band, {at, base - size / 2, size, std::max(2, size / 5)}, curve.color);
      pen.write(band, at + size + size / 3, base, curve.name, size, band_ink);
      at += entry_width(curve, size);
    }
    if (&row == &rows.back()) pen.write(band, at - size / 2, base, unit, size, band_ink);
    base += Pen::line_height(size);
  }
}

Image CurveBand::draw(Pen& pen, double time) const {
  Image band(width_, height(size_));
  Pen::fill(band, {0, 0, band.width, band.height}, band_paper);
  const int top = 2 * size_ + size_ / 4, rows = band.height - top - 2 * size_;
  int labels = 0;  // greatest width of the vertical axis' labels
  for (const Tick& mark : levels(rows)) labels = std::max(labels, pen.width(mark.label, size_));
  const int left = labels + size_;
  const PictureBox area{left, top, std::max(1, width_ - left - size_), rows};
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
