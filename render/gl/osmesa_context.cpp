#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>

#include "core/error.hpp"
#include "render/gl/context.hpp"
#include "render/gl/llvmpipe.hpp"

namespace drape {
namespace {

/// The functions of libOSMesa. The library stays loaded until the process ends: LLVM inside it does not survive
/// unloading.
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;

  explicit OsMesa(const std::vector<std::string>& library_names) {
    void* library = nullptr;
    for (const std::string& name : library_names) {
      // RTLD_LOCAL: another GL library, as EGL's, may live in the same process.
      library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (library != nullptr) break;
    }
    if (library == nullptr) {
      throw OutputError(fmt::format(
          "cannot draw: the OSMesa library is not installed (looked for {}); on Debian: apt install libosmesa6",
          fmt::join(library_names, ", ")));
    }
    fetch(library, "OSMesaCreateContextAttribs", create);
    fetch(library, "OSMesaDestroyContext", destroy);
    fetch(library, "OSMesaMakeCurrent", make_current);
    fetch(library, "OSMesaGetProcAddress", get_proc_address);
  }

 private:
  template <class Function>
  static void fetch(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr) {
      throw OutputError(
          fmt::format("cannot draw: the OSMesa library is too old, it has no {}; Mesa 12 or later is needed", name));
    }
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

  [[nodiscard]] Function get_proc_address(const char* name) const override { return mesa_.get_proc_address(name); }

 private:
  OsMesa mesa_;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4> window_{};  // OSMesa insists on one; everything is drawn to framebuffer objects
};

}  // namespace

std::vector<std::string> osmesa_library_names() { return {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}; }

std::unique_ptr<GlContext> make_osmesa_context(const std::vector<std::string>& library_names) {
  limit_llvmpipe_vector_width();
  return std::make_unique<OsMesaContext>(library_names);
}

}  // namespace drape
