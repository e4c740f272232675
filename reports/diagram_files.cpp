#include "reports/diagram_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "reports/latex.hpp"

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
      const std::string x =
          chart.x_names.empty() ? shortest(point.x) : chart.x_names.at(static_cast<std::size_t>(point.x));
      std::vector<std::string> cells{x, shortest(point.y)};
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

namespace {

/// Markers in the order of the charts' styles: circle, square, diamond, triangles, and for the cross a pentagon.
constexpr std::array<const char*, 6> marks{
    "mark=*",        "mark=square*", "mark=diamond*", "mark=triangle*", "mark=triangle*, mark options={rotate=180}",
    "mark=pentagon*"};

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "nan"; }

std::size_t style_of(const html::Chart& chart, std::size_t i) {
  return chart.series[i].style.value_or(i) % marks.size();
}

/// Returns the definitions of the colours in use.
std::string colors(const html::Chart& chart) {
  std::set<std::size_t> used;
  for (std::size_t i = 0; i < chart.series.size(); ++i) used.insert(style_of(chart, i));
  std::string text;
  for (const std::size_t style : used) {
    std::string color = html::light_color(fmt::format("--s{}", style)).substr(1);
    std::ranges::transform(color, color.begin(), [](unsigned char c) { return std::toupper(c); });
    text += fmt::format("\\definecolor{{drape{}}}{{HTML}}{{{}}}\n", style, color);
  }
  return text;
}

/// Returns invisible points that the axes must include.
std::string held_points(const html::Chart& chart) {
  double x = NAN, y = NAN;
  for (const html::ChartSeries& series : chart.series) {
    for (const html::ChartPoint& p : series.points) {
      if (std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0) x = p.x, y = p.y;
    }
  }
  if (std::isnan(x)) return {};
  std::string points;
  for (const double held : chart.x_holds) points += fmt::format(" ({},{})", held, y);
  for (const double held : chart.y_holds) points += fmt::format(" ({},{})", x, held);
  for (const html::ChartLevel& level : chart.levels) points += fmt::format(" ({},{})", x, level.y);
  return points.empty() ? points : fmt::format("\\addplot[draw=none, forget plot] coordinates {{{} }};\n", points);
}

std::string level_line(const html::ChartLevel& level) {
  return fmt::format(
      "\\draw[dashed] ({{rel axis cs:0,0}} |- {{axis cs:\\pgfkeysvalueof{{/pgfplots/xmin}},{0}}}) -- "
      "({{rel axis cs:1,0}} |- {{axis cs:\\pgfkeysvalueof{{/pgfplots/xmin}},{0}}}) node[above left] {{{1}}};\n",
      number(level.y), html::latex(level.label));
}

std::string axis_options(const html::Chart& chart, double inches) {
  constexpr double least_height = 2.1, share = 0.42;  // [in], and relative to the width
  std::size_t longest = 0;
  for (const html::ChartSeries& series : chart.series) longest = std::max(longest, series.name.size());
  const double entry = 36 + 4.5 * static_cast<double>(longest);  // of the legend [pt]
  const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((72 * inches - 40) / entry));
  std::vector<std::string> options{
      fmt::format("width={:g}in, height={:g}in", inches, std::max(least_height, share * inches)),
      "font=\\footnotesize",
      fmt::format("xlabel={{{}}}", html::latex(chart.x_title)),
      fmt::format("ylabel={{{}}}", html::latex(chart.y_title)),
      "enlargelimits=0.05, grid=major, grid style={very thin, gray!40}",
      "unbounded coords=jump, mark size=1.2pt",
      "legend style={at={(0,1.03)}, anchor=south west, draw=none, font=\\footnotesize}",
      fmt::format("legend columns={}", columns),
      "legend cell align=left"};
  if (chart.x_scale == html::Scale::logarithmic) options.emplace_back("xmode=log");
  if (chart.y_scale == html::Scale::logarithmic) options.emplace_back("ymode=log");
  if (!chart.x_names.empty()) {
    std::vector<std::string> places, names;
    for (std::size_t i = 0; i < chart.x_names.size(); ++i) {
      places.push_back(std::to_string(i));
      names.push_back("{" + html::latex(chart.x_names[i]) + "}");
    }
    options.push_back(fmt::format("xtick={{{}}}, xticklabels={{{}}}", fmt::join(places, ","), fmt::join(names, ",")));
  }
  return fmt::format("  {}", fmt::join(options, ",\n  "));
}

}  // namespace

std::string pgfplots_data(const html::Chart& chart) {
  std::vector<std::string> names;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    names.push_back(fmt::format("x{0} y{0}", i));
    rows = std::max(rows, chart.series[i].points.size());
  }
  std::string text = fmt::format("{}\n", fmt::join(names, " "));
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const html::ChartSeries& series : chart.series) {
      const bool known = row < series.points.size();
      cells.push_back(known ? number(series.points[row].x) : "nan");
      cells.push_back(known ? number(series.points[row].y) : "nan");
    }
    text += fmt::format("{}\n", fmt::join(cells, " "));
  }
  return text;
}

std::string pgfplots_picture(const NamedChart& named, double inches) {
  const html::Chart& chart = named.chart;
  constexpr std::size_t crowded = 60;  // points per series beyond which markers would cover the line
  std::string plots;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const html::ChartSeries& series = chart.series[i];
    const bool line = !series.markers || series.points.size() > crowded;
    plots +=
        fmt::format("\\addplot[color=drape{}, {}{}] table[x=x{}, y=y{}] {{{}.dat}};\n", style_of(chart, i),
                    line ? "no marks" : marks[style_of(chart, i)], series.other ? ", dashed" : "", i, i, named.name);
    if (!series.name.empty()) plots += fmt::format("\\addlegendentry{{{}}}\n", html::latex(series.name));
  }
  plots += held_points(chart);
  for (const html::ChartLevel& level : chart.levels) plots += level_line(level);
  return fmt::format(
      "% {}\n% needs \\usepackage{{pgfplots}} and \\pgfplotsset{{compat=1.18}}; of another folder also\n"
      "% \\pgfplotsset{{table/search "
      "path={{FOLDER}}}}\n{}\\begin{{tikzpicture}}\n\\begin{{axis}}[\n{}]\n{}\\end{{axis}}\n"
      "\\end{{tikzpicture}}\n",
      html::latex(chart.title), colors(chart), axis_options(chart, inches), plots);
}

std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder, FigureStyle style) {
  const ResultTable points = points_table(chart);
  write_table(points, folder);
  if (points.rows.size() > most_set_rows) write_set_table(points_table(chart, sparse(points.rows.size())), folder);
  if (style == FigureStyle::screen) return write_diagram(html::still_chart(chart.chart), folder, chart.name);
  const double inches = paper_width(style);
  write_file_atomically(folder / (chart.name + ".dat"), pgfplots_data(chart.chart));
  write_file_atomically(folder / (chart.name + ".tikz.tex"), pgfplots_picture(chart, inches));
  return write_diagram(html::paper_chart(chart.chart, inches), folder, chart.name, style);
}

}  // namespace drape
