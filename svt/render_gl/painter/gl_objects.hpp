#pragma once
/// \file
/// RAII owners of OpenGL objects: textures, framebuffers and programs.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <GLES3/gl3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::render_gl {

/// The bits of a float, which shaders read by uintBitsToFloat(); and back.
[[nodiscard]] inline std::uint32_t bitsOf(float value) noexcept {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}
[[nodiscard]] inline float floatOf(std::uint32_t bits) noexcept {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Limits of a context.
struct GlLimits {
    GLint textureSize = 2048;  ///< texels along a side
    int rowBits = 11;          ///< arrays are stored in rows of 2^rowBits texels
};
/// Limits of the current context.
/// \return the limits, or NoGraphics if none is current or it is older than OpenGL ES 3.0
[[nodiscard]] Result<GlLimits> glLimits();

/// Discards pending errors of the context.
void clearGlErrors() noexcept;
/// \return nothing, or NoGraphics if the context has an error pending
/// \param doing  the current work, for the message
[[nodiscard]] Result<void> checkGl(std::string_view doing);

/// A texture, not filtered.
class Texture {
public:
    Texture() = default;
    Texture(Texture&& other) noexcept : name_(std::exchange(other.name_, 0)), size_(other.size_) {}
    Texture& operator=(Texture&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~Texture() {
        if (name_ != 0) glDeleteTextures(1, &name_);
    }
    [[nodiscard]] GLuint name() const noexcept { return name_; }
    [[nodiscard]] bool isEmpty() const noexcept { return name_ == 0; }

    /// Uploads `count` texels as an array, in rows, see tables.glsl.
    /// \return GridTooLarge if they do not fit a texture
    [[nodiscard]] Result<void> setArray(GLenum internalFormat, const void* data, std::size_t count,
                                        const GlLimits& limits);
    /// Makes it a render target of at least this size; it grows, and never shrinks.
    void setTarget(GLenum internalFormat, GLsizei width, GLsizei height);

private:
    void allocate(GLenum internalFormat, GLsizei width, GLsizei height);

    GLuint name_ = 0;
    std::array<GLint, 3> size_{};  // width, height, format
};

/// A framebuffer object; bind() attaches its textures.
class Target {
public:
    Target() = default;
    Target(Target&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Target& operator=(Target&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Target() {
        if (name_ != 0) glDeleteFramebuffers(1, &name_);
    }
    /// Binds it for drawing, with these textures as color attachments.
    void bind(std::initializer_list<GLuint> textures);

private:
    GLuint name_ = 0;
};

/// A linked program and its uniforms.
class Program {
public:
    Program() = default;
    Program(Program&& other) noexcept
        : name_(std::exchange(other.name_, 0)), locations_(std::move(other.locations_)), units_(other.units_) {}
    Program& operator=(Program&& other) noexcept {
        std::swap(name_, other.name_);
        locations_.swap(other.locations_);
        std::swap(units_, other.units_);
        return *this;
    }
    ~Program() {
        if (name_ != 0) glDeleteProgram(name_);
    }

    /// \param defines  lines such as "#define CLIPS 1\n"
    /// \param parts    sources of the fragment shader, concatenated in this order
    /// \return the program, or NoGraphics with the driver's message
    [[nodiscard]] static Result<Program> make(const std::string& defines, std::span<const std::string_view> parts);

    /// Makes it the current program, as all functions below require. Uniforms that it does not use are ignored.
    void use();
    void set(const char* uniform, GLint value);
    void set(const char* uniform, GLuint value);
    void set(const char* uniform, float value);
    void set(const char* uniform, double value) { set(uniform, static_cast<float>(value)); }
    void set(const char* uniform, double x, double y);
    void set(const char* uniform, Vec3d value);
    void set(const char* uniform, Vec3i value);
    void setPair(const char* uniform, GLint x, GLint y);
    /// A matrix, by columns.
    void set(const char* uniform, const std::array<Vec3d, 3>& columns);
    void set(const char* uniform, std::span<const Vec3i> values);
    void set(const char* uniform, std::span<const GLuint> values);
    void setPairs(const char* uniform, std::span<const float> values);
    /// Binds a texture to the next free unit; use() starts at the first one.
    void bind(const char* uniform, const Texture& texture);

private:
    [[nodiscard]] GLint at(const char* uniform);

    GLuint name_ = 0;
    std::map<std::string, GLint, std::less<>> locations_;
    GLint units_ = 0;
};

}  // namespace svt::render_gl
