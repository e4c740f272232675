#include "render/gl/functions.hpp"

#include "core/error.hpp"
#include "render/gl/context.hpp"

namespace drape {

GlFunctions::GlFunctions(const GlContext& context) {
  const auto fetch = [&context](const char* name) {
    const GlContext::Function function = context.get_proc_address(name);
    if (function == nullptr) throw OutputError(std::string("the OpenGL library has no function ") + name);
    return function;
  };
#define DRAPE_GL_FETCH(type, name) name = reinterpret_cast<type>(fetch("gl" #name));
  DRAPE_GL_FUNCTIONS(DRAPE_GL_FETCH)
#undef DRAPE_GL_FETCH
}

}  // namespace drape
