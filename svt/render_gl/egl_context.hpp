#pragma once
/// \file
/// An OpenGL ES 3.0 context without a window, from whatever driver there is. Not part of the web build.

#include <svt/core/result.hpp>

#include <memory>
#include <string>

namespace svt::render_gl {

/// A context and, where the driver asks for one, a surface of one pixel.
class EglContext {
public:
    /// Makes a context and makes it current for the calling thread. Tried are, in this order: a display without
    /// surfaces (Mesa), a software rasterizer that the driver brings along (ANGLE with SwiftShader), the default
    /// display.
    /// \return the context, or NoGraphics with what was tried
    [[nodiscard]] static Result<EglContext> make();
    EglContext(EglContext&&) noexcept;
    EglContext& operator=(EglContext&&) noexcept;
    ~EglContext();

    /// Name of the renderer as the driver gives it, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] std::string renderer() const;

private:
    struct Parts;
    explicit EglContext(std::unique_ptr<Parts> parts) noexcept;

    std::unique_ptr<Parts> parts_;
};

}  // namespace svt::render_gl
