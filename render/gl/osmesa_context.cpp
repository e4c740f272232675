#include <GL/osmesa.h>
#include <array>
#include <cstdint>

#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "render/gl/context.hpp"

namespace drape {
namespace {

/// The functions of libOSMesa.
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;

  explicit OsMesa(const std::vector<std::string>& library_names) {
    const SharedLibrary library("OSMesa", library_names, debian_packages(GlBackend::osmesa));
    library.fetch("OSMesaCreateContextAttribs", create);
    library.fetch("OSMesaDestroyContext", destroy);
    library.fetch("OSMesaMakeCurrent", make_current);
    library.fetch("OSMesaGetProcAddress", get_proc_address);
  }
};

class OsMesaContext final : public GlContext {
 public:
  explicit OsMesaContext(const std::vector<std::string>& library_names) : mesa_(library_names) {
    constexpr std::array attributes{OSMESA_FORMAT,
                                    OSMESA_RGBA,
                                    OSMESA_PROFILE,
                                    OSMESA_CORE_PROFILE,
                                    OSMESA_CONTEXT_MAJOR_VERSION,
                                    3,
                                    OSMESA_CONTEXT_MINOR_VERSION,
                                    3,
                                    0};
    context_ = mesa_.create(attributes.data(), nullptr);
    if (context_ == nullptr) throw OutputError("cannot draw: OSMesa cannot make an OpenGL 3.3 core context");
  }

  ~OsMesaContext() override { mesa_.destroy(context_); }

  void make_current() override {
    if (!mesa_.make_current(context_, window_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
      throw OutputError("cannot draw: OSMesa cannot make its context current");
    }
  }

  void release() override { mesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  [[nodiscard]] Function get_proc_address(const char* name) const override { return mesa_.get_proc_address(name); }

 private:
  OsMesa mesa_;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4> window_{};  // OSMesa requires a window buffer; drawing goes to framebuffer objects
};

}  // namespace

std::vector<std::string> osmesa_library_names() { return {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}; }

std::unique_ptr<GlContext> make_osmesa_context(const std::vector<std::string>& library_names) {
  prepare_llvmpipe();
  return std::make_unique<OsMesaContext>(library_names);
}

}  // namespace drape
