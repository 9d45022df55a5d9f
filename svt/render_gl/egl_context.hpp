#pragma once
/// \file
/// An OpenGL ES 3.0 context without a window, from any available driver. Not part of the web build.

#include <svt/core/result.hpp>

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

namespace svt::render_gl {

/// A context and, if the driver requires one, a surface of one pixel.
class EglContext {
public:
    /// Makes a context and makes it current in the calling thread. Tries, in this order, a surfaceless display (Mesa),
    /// ANGLE with its software rasterizer SwiftShader, and the default display.
    /// \return the context, or NoGraphics; the message lists what was tried
    [[nodiscard]] static Result<EglContext> make();
    EglContext(EglContext&&) noexcept;
    EglContext& operator=(EglContext&&) noexcept;
    ~EglContext();

    /// GL_RENDERER of the driver, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] std::string renderer() const;
    /// GL_VERSION of the driver, such as "OpenGL ES 3.2 Mesa 22.3.6".
    [[nodiscard]] std::string version() const;

private:
    struct Parts;
    explicit EglContext(std::unique_ptr<Parts> parts) noexcept;

    std::unique_ptr<Parts> parts_;
};

/// Whether a driver of this GL_RENDERER draws with the processor, which the ray caster does faster.
[[nodiscard]] constexpr bool isSoftwareRenderer(std::string_view renderer) noexcept {
    for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer"})
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace svt::render_gl
