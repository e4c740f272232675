#include "reports/diagram_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "reports/pgfplots.hpp"

namespace drape {

// Declarations from rsvg.h, cairo.h, cairo-pdf.h and glib-object.h, repeated here so that building needs none of their
// packages. The numbers and structures belong to the libraries' stable ABI.
struct RsvgHandle;
struct Cairo;
struct CairoSurface;
struct RsvgRectangle {
  double x, y, width, height;
};
using CairoWrite = int (*)(void* closure, const unsigned char* bytes, unsigned int count);

namespace {

constexpr int cairo_success = 0, cairo_rgb24 = 1, cairo_pdf_1_4 = 0;
constexpr double pixels_per_inch = 96, points_per_pixel = 0.75;

int append(void* closure, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), count);
  return cairo_success;
}

}  // namespace

/// Functions of the three libraries.
struct SvgPrinter::Functions {
  RsvgHandle* (*read)(const unsigned char* bytes, std::size_t count, void** error) = nullptr;
  void (*set_dpi)(RsvgHandle*, double) = nullptr;
  int (*get_size)(RsvgHandle*, double* width, double* height) = nullptr;
  int (*render)(RsvgHandle*, Cairo*, const RsvgRectangle*, void** error) = nullptr;

  CairoSurface* (*make_pdf)(CairoWrite, void* closure, double width, double height) = nullptr;
  void (*restrict_pdf)(CairoSurface*, int version) = nullptr;
  CairoSurface* (*make_image)(int format, int width, int height) = nullptr;
  int (*write_png)(CairoSurface*, CairoWrite, void* closure) = nullptr;
  void (*finish)(CairoSurface*) = nullptr;
  int (*surface_status)(CairoSurface*) = nullptr;
  void (*destroy_surface)(CairoSurface*) = nullptr;
  Cairo* (*create)(CairoSurface*) = nullptr;
  void (*destroy)(Cairo*) = nullptr;

  void (*unref)(void*) = nullptr;

  explicit Functions(const std::vector<std::string>& names) {
    const SharedLibrary rsvg("librsvg", {names.at(0)}, packages());
    rsvg.fetch("rsvg_handle_new_from_data", read);
    rsvg.fetch("rsvg_handle_set_dpi", set_dpi);
    rsvg.fetch("rsvg_handle_get_intrinsic_size_in_pixels", get_size);
    rsvg.fetch("rsvg_handle_render_document", render);
    const SharedLibrary cairo("cairo", {names.at(1)}, packages());
    cairo.fetch("cairo_pdf_surface_create_for_stream", make_pdf);
    cairo.fetch("cairo_pdf_surface_restrict_to_version", restrict_pdf);
    cairo.fetch("cairo_image_surface_create", make_image);
    cairo.fetch("cairo_surface_write_to_png_stream", write_png);
    cairo.fetch("cairo_surface_finish", finish);
    cairo.fetch("cairo_surface_status", surface_status);
    cairo.fetch("cairo_surface_destroy", destroy_surface);
    cairo.fetch("cairo_create", create);
    cairo.fetch("cairo_destroy", destroy);
    const SharedLibrary gobject("GObject", {names.at(2)}, packages());
    gobject.fetch("g_object_unref", unref);
  }

  using Svg = std::unique_ptr<RsvgHandle, void (*)(void*)>;
  [[nodiscard]] Svg open(const std::string& svg) const {
    Svg handle(read(reinterpret_cast<const unsigned char*>(svg.data()), svg.size(), nullptr), unref);
    if (!handle) throw OutputError("cannot draw: librsvg does not take it for an SVG file");
    set_dpi(handle.get(), pixels_per_inch);
    return handle;
  }

  [[nodiscard]] std::array<double, 2> size(const Svg& svg) const {
    std::array<double, 2> pixels{};
    if (get_size(svg.get(), pixels.data(), &pixels[1]) == 0) throw OutputError("cannot draw: the SVG file has no size");
    return pixels;
  }

  using Surface = std::unique_ptr<CairoSurface, void (*)(CairoSurface*)>;
  [[nodiscard]] Surface own(CairoSurface* surface) const { return {surface, destroy_surface}; }

  /// Draws the SVG over the whole surface.
  void fill(const Surface& surface, const Svg& svg, double width, double height) const {
    const RsvgRectangle whole{0, 0, width, height};
    const std::unique_ptr<Cairo, void (*)(Cairo*)> pen(create(surface.get()), destroy);
    if (render(svg.get(), pen.get(), &whole, nullptr) == 0) throw OutputError("cannot draw: librsvg gives up");
  }

  void require(int status) const {
    if (status != cairo_success) throw OutputError("cannot draw: cairo could not write the picture");
  }
};

std::vector<std::string> SvgPrinter::library_names() {
  return {"librsvg-2.so.2", "libcairo.so.2", "libgobject-2.0.so.0"};
}
const char* SvgPrinter::packages() { return "librsvg2-2 libcairo2"; }

SvgPrinter::SvgPrinter(const std::vector<std::string>& names) : call_(std::make_unique<const Functions>(names)) {}
SvgPrinter::~SvgPrinter() = default;

std::string SvgPrinter::pdf(const std::string& svg) const {
  const Functions::Svg handle = call_->open(svg);
  auto [width, height] = call_->size(handle);
  width *= points_per_pixel;
  height *= points_per_pixel;
  std::string bytes;
  const Functions::Surface surface = call_->own(call_->make_pdf(append, &bytes, width, height));
  call_->restrict_pdf(surface.get(), cairo_pdf_1_4);  // every LaTeX includes this version without a warning
  call_->fill(surface, handle, width, height);
  call_->finish(surface.get());
  call_->require(call_->surface_status(surface.get()));
  return bytes;
}

std::string SvgPrinter::png(const std::string& svg, double scale) const {
  const Functions::Svg handle = call_->open(svg);
  const auto [width, height] = call_->size(handle);
  const double columns = std::round(scale * width), rows = std::round(scale * height);
  std::string bytes;
  const Functions::Surface surface =
      call_->own(call_->make_image(cairo_rgb24, static_cast<int>(columns), static_cast<int>(rows)));
  call_->fill(surface, handle, columns, rows);
  call_->require(call_->write_png(surface.get(), append, &bytes));
  return bytes;
}

namespace {

constexpr double png_scale = 2;

/// Returns the shortest text that reads back as the same number.
std::string shortest(double value) { return fmt::format("{}", value); }

/// Returns the stride that keeps a table short enough for a document.
std::size_t sparse(std::size_t rows) { return (rows + most_set_rows - 1) / most_set_rows; }

/// Returns the indices of every `every`-th finite point, including the last.
std::vector<std::size_t> finite_points(const html::ChartSeries& series, std::size_t every) {
  std::vector<std::size_t> finite, chosen;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    if (std::isfinite(series.points[i].x) && std::isfinite(series.points[i].y)) finite.push_back(i);
  }
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i % every == 0 || i + 1 == finite.size()) chosen.push_back(finite[i]);
  }
  return chosen;
}

}  // namespace

ResultTable points_table(const NamedChart& named, std::size_t every) {
  const html::Chart& chart = named.chart;
  const bool spread = std::ranges::any_of(chart.series, [](const html::ChartSeries& series) {
    return std::ranges::any_of(series.points, [](const html::ChartPoint& p) { return p.spread.has_value(); });
  });
  const bool unnamed = chart.series.size() == 1 && chart.series.front().name.empty();
  ResultTable table{named.name, chart.title, {chart.x_title, chart.y_title}, {}, {}};
  if (!unnamed) table.columns.insert(table.columns.begin(), "series");
  if (spread) table.columns.insert(table.columns.end(), {"from", "to"});
  for (const html::ChartSeries& series : chart.series) {
    for (const std::size_t i : finite_points(series, every)) {
      const html::ChartPoint& point = series.points[i];
      std::vector<std::string> cells{shortest(point.x), shortest(point.y)};
      if (!unnamed) cells.insert(cells.begin(), series.name);
      for (const std::size_t end : {0U, 1U}) {
        if (spread) cells.push_back(point.spread ? shortest((*point.spread)[end]) : "");
      }
      table.rows.push_back(std::move(cells));
    }
  }
  if (every > 1) table.notes.push_back(fmt::format("One of {} points; all of them are in {}.csv.", every, named.name));
  return table;
}

std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name,
                          FigureStyle style) {
  const bool screen = style == FigureStyle::screen;
  const std::string svg = screen ? html::svg_file(diagram) : html::paper_file(diagram, paper_width(style));
  write_file_atomically(folder / (name + ".svg"), svg);
  std::string pdf, png;
  try {
    const SvgPrinter printer;
    pdf = printer.pdf(svg);
    if (screen) png = printer.png(svg, png_scale);
  } catch (const OutputError& error) {
    return fmt::format("the diagrams were written only as SVG, not as PDF{}: {}", screen ? " and PNG" : "",
                       error.what());
  }
  write_file_atomically(folder / (name + ".pdf"), pdf);
  if (screen) write_file_atomically(folder / (name + ".png"), png);
  return {};
}

std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder, FigureStyle style) {
  const ResultTable points = points_table(chart);
  write_table(points, folder);
  if (points.rows.size() > most_set_rows) write_set_table(points_table(chart, sparse(points.rows.size())), folder);
  if (style == FigureStyle::screen) return write_diagram(html::still_chart(chart.chart), folder, chart.name);
  write_pgfplots(chart, folder, paper_width(style));
  return write_diagram(html::paper_chart(chart.chart, paper_width(style)), folder, chart.name, style);
}

}  // namespace drape
