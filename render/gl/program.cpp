#include "render/gl/program.hpp"

#include <fmt/format.h>
#include <charconv>
#include <sstream>
#include <utility>

#include "core/files.hpp"
#include "drape/core/error.hpp"
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

namespace {

/// A shader's text with its includes resolved, and its files: file k is GLSL's source string k.
struct Source {
  std::string text;
  std::vector<std::filesystem::path> files;
};

void append_file(Source& source, const std::filesystem::path& file, const std::vector<std::string>& defines) {
  constexpr std::size_t most = 1 << 20;
  std::istringstream stream(read_text(file, most));
  const std::size_t number = source.files.size();
  source.files.push_back(file);
  constexpr std::string_view include = "#include \"";
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    const bool is_version = line.starts_with("#version");
    const bool is_include = line.starts_with(include);
    if (is_include) {
      const std::string name = line.substr(include.size(), line.find('"', include.size()) - include.size());
      source.text += fmt::format("#line 1 {}\n", source.files.size());
      append_file(source, file.parent_path() / name, {});
    } else {
      source.text += line + '\n';
    }
    if (is_version) {
      for (const std::string& define : defines) source.text += fmt::format("#define {}\n", define);
    }
    if (is_version || is_include) source.text += fmt::format("#line {} {}\n", line_number + 1, number);
  }
}

/// Returns the compiler's log with each line's source string number ("1:") replaced by that file's name.
std::string readable_log(const std::string& log, const std::vector<std::filesystem::path>& files) {
  std::istringstream stream(log);
  std::string result;
  for (std::string line; std::getline(stream, line);) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error == std::errc{} && end < line.data() + line.size() && *end == ':' && number < files.size()) {
      line = files[number].string() + line.substr(static_cast<std::size_t>(end - line.data()));
    }
    result += '\n' + line;
  }
  return result;
}

/// Owner of a shader until the program is linked.
class Shader {
 public:
  Shader(const GlFunctions& gl, GLenum type, const std::filesystem::path& file, const std::vector<std::string>& defines)
      : gl_(gl), id_(gl.CreateShader(type)) {
    Source source;
    append_file(source, file, defines);
    const char* text = source.text.c_str();
    gl.ShaderSource(id_, 1, &text, nullptr);
    gl.CompileShader(id_);
    GLint compiled = GL_FALSE, length = 0;
    gl.GetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    gl.GetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    gl.GetShaderInfoLog(id_, length, nullptr, log.data());
    log.resize(log.find('\0'));
    gl.DeleteShader(id_);
    throw OutputError(fmt::format("{} does not compile:{}", file.string(), readable_log(log, source.files)));
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { gl_.DeleteShader(id_); }

  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const GlFunctions& gl_;
  GLuint id_;
};

}  // namespace

Program::Program(const GlFunctions& gl, const std::filesystem::path& data_folder, const std::string& name,
                 const std::vector<std::string>& defines)
    : gl_(gl) {
  const std::filesystem::path folder = data_folder / "shaders";
  const Shader vertex(gl, GL_VERTEX_SHADER, folder / (name + ".vert"), defines);
  const Shader fragment(gl, GL_FRAGMENT_SHADER, folder / (name + ".frag"), defines);
  id_ = gl.CreateProgram();
  gl.AttachShader(id_, vertex.id());
  gl.AttachShader(id_, fragment.id());
  gl.LinkProgram(id_);
  GLint linked = GL_FALSE, length = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  gl.GetProgramiv(id_, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl.GetProgramInfoLog(id_, length, nullptr, log.data());
  log.resize(log.find('\0'));
  gl.DeleteProgram(id_);
  throw OutputError(fmt::format("{}/{}.vert and .frag do not link:\n{}", folder.string(), name, log));
}

Program::~Program() { gl_.DeleteProgram(id_); }

void Program::use() const { gl_.UseProgram(id_); }

void Program::set(const char* uniform, int value) const { gl_.Uniform1i(gl_.GetUniformLocation(id_, uniform), value); }

void Program::set(const char* uniform, float value) const {
  gl_.Uniform1f(gl_.GetUniformLocation(id_, uniform), value);
}

void Program::set(const char* uniform, const Eigen::Vector3f& value) const {
  gl_.Uniform3fv(gl_.GetUniformLocation(id_, uniform), 1, value.data());
}

void Program::set(const char* uniform, const Eigen::Matrix4f& value) const {
  gl_.UniformMatrix4fv(gl_.GetUniformLocation(id_, uniform), 1, GL_FALSE, value.data());
}

void Program::set(const char* uniform, std::span<const Eigen::Vector4f> values) const {
  if (values.empty()) return;
  gl_.Uniform4fv(gl_.GetUniformLocation(id_, uniform), static_cast<GLsizei>(values.size()), values.front().data());
}

}  // namespace drape
