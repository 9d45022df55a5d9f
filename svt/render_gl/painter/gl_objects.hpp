#pragma once
/// \file
/// Owners of OpenGL objects: textures that hold arrays, targets, programs. Internal to render_gl.

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

/// A float as shaders read it by uintBitsToFloat(), and back. Not std::bit_cast, which the library of the web build
/// lacks.
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

/// What the current context can do.
struct GlLimits {
    GLint textureSize = 2048;  ///< texels along a side
    int rowBits = 11;          ///< arrays lie in rows of 2^rowBits texels
};
/// \return the limits, or NoGraphics where the context is older than OpenGL ES 3.0 or none is current
[[nodiscard]] Result<GlLimits> glLimits();

/// Forgets pending errors of the context; then says whether one came up since.
void clearGlErrors() noexcept;
[[nodiscard]] Result<void> checkGl(std::string_view doing);

/// A texture; integers, not filtered.
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

    /// `count` elements of `texel` bytes as an array, see tables.glsl. \return GridTooLarge where they are too many
    [[nodiscard]] Result<void> setArray(GLenum internalFormat, const void* data, std::size_t count,
                                        const GlLimits& limits);
    /// Room for a picture to draw into; it grows, and never shrinks.
    void setTarget(GLenum internalFormat, GLsizei width, GLsizei height);

private:
    void allocate(GLenum internalFormat, GLsizei width, GLsizei height);

    GLuint name_ = 0;
    std::array<GLint, 3> size_{};  // width, height, format
};

/// A vertex array without arrays, and framebuffers.
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
    /// Binds it with these textures as what is drawn into.
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

    /// \param defines  lines such as "#define CLIPS 1\n" \param parts  fragment shader, in order
    /// \return the program, or NoGraphics with what the driver says
    [[nodiscard]] static Result<Program> make(const std::string& defines, std::span<const std::string_view> parts);

    /// The following are for the program in use; uniforms that it does not use are left out.
    void use();
    void set(const char* uniform, GLint value);
    void set(const char* uniform, GLuint value);
    void set(const char* uniform, float value);
    void set(const char* uniform, double value) { set(uniform, static_cast<float>(value)); }
    void set(const char* uniform, double x, double y);
    void set(const char* uniform, Vec3d value);
    void set(const char* uniform, Vec3i value);
    void setPair(const char* uniform, GLint x, GLint y);
    /// By columns.
    void set(const char* uniform, const std::array<Vec3d, 3>& columns);
    void set(const char* uniform, std::span<const Vec3i> values);
    void set(const char* uniform, std::span<const GLuint> values);
    void setPairs(const char* uniform, std::span<const float> values);
    /// Binds a texture to the next free unit, from use() on.
    void bind(const char* uniform, const Texture& texture);

private:
    [[nodiscard]] GLint at(const char* uniform);

    GLuint name_ = 0;
    std::map<std::string, GLint, std::less<>> locations_;
    GLint units_ = 0;
};

}  // namespace svt::render_gl
