// Where there is no EGL: WebAssembly under Node.js. In a browser the page makes the context.
#include <svt/render_gl/egl_context.hpp>

namespace svt::render_gl {

struct EglContext::Parts {};

EglContext::EglContext(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Result<EglContext> EglContext::make() {
    return Error(Code::NoGraphics, "there is no OpenGL under Node.js; draw without OpenGL");
}

std::string EglContext::renderer() const { return {}; }

std::string EglContext::version() const { return {}; }

}  // namespace svt::render_gl
