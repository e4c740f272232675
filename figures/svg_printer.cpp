#include "figures/svg_printer.hpp"

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/shared_library.hpp"

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

}  // namespace drape
