#include "gl.h"

#include <stdexcept>
#include <vector>

// osmesa.h would include the old gl.h, which clashes with the core profile header.
#define __gl_h_ 1  // NOLINT
#ifndef GLAPIENTRY
#define GLAPIENTRY
#endif
#include <GL/osmesa.h>

namespace hoap2 {

Context::Context() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  handle_ = OSMesaCreateContextAttribs(attributes, nullptr);
  if (handle_ == nullptr) {
    throw std::runtime_error("OSMesa gives no OpenGL 3.3 core context (is libosmesa6 installed?)");
  }
  try {
    acquire();
#define HOAP2_GL_LOAD(type, name)                                      \
  gl_.name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name)); \
  if (gl_.name == nullptr) throw std::runtime_error("OSMesa lacks gl" #name);
    HOAP2_GL_FUNCTIONS(HOAP2_GL_LOAD)
#undef HOAP2_GL_LOAD
    release();
  } catch (...) {
    release();
    OSMesaDestroyContext(static_cast<OSMesaContext>(handle_));
    throw;
  }
}

Context::~Context() { OSMesaDestroyContext(static_cast<OSMesaContext>(handle_)); }

void Context::acquire() {
  // The window is a stub: pictures are drawn into a framebuffer object of the right size.
  if (OSMesaMakeCurrent(static_cast<OSMesaContext>(handle_), window_, GL_UNSIGNED_BYTE, 16, 16) == GL_FALSE) {
    throw std::runtime_error("OSMesa cannot bind its context to this thread");
  }
}

void Context::release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

namespace {

GLuint compile(const Gl &gl, const std::string &name, GLenum stage, const std::string &source) {
  const GLuint shader = gl.CreateShader(stage);
  const char *text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint ok = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == 0) {
    std::vector<char> log(4096, '\0');
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteShader(shader);
    throw std::runtime_error("shader " + name + " does not compile: " + log.data());
  }
  return shader;
}

}  // namespace

GLuint build_program(const Gl &gl, const std::string &name, const std::string &vertex,
                     const std::string &fragment, const char *const *attributes, int attribute_count) {
  const GLuint vertex_shader = compile(gl, name + " (vertex)", GL_VERTEX_SHADER, vertex);
  const GLuint fragment_shader = compile(gl, name + " (fragment)", GL_FRAGMENT_SHADER, fragment);
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex_shader);
  gl.AttachShader(program, fragment_shader);
  for (int i = 0; i < attribute_count; ++i)
    gl.BindAttribLocation(program, static_cast<GLuint>(i), attributes[i]);
  gl.LinkProgram(program);
  gl.DeleteShader(vertex_shader);
  gl.DeleteShader(fragment_shader);
  GLint ok = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok == 0) {
    std::vector<char> log(4096, '\0');
    gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteProgram(program);
    throw std::runtime_error("shader program " + name + " does not link: " + log.data());
  }
  return program;
}

}  // namespace hoap2
