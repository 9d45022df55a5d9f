#include <svt/render_gl/painter/gl_objects.hpp>

#include <svt/render_gl/painter/shader_sources.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace svt::render_gl {
namespace {

struct TexelLayout {
    GLenum format, type;
    std::size_t bytes;
};

TexelLayout layoutOf(GLenum internalFormat) {
    switch (internalFormat) {
        case GL_R16UI: return {GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2};
        case GL_R32UI: return {GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
        case GL_RG32UI: return {GL_RG_INTEGER, GL_UNSIGNED_INT, 8};
        case GL_RGBA32UI: return {GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16};
        default: return {GL_RGBA, GL_UNSIGNED_BYTE, 4};
    }
}

std::string logOf(GLuint object, bool isProgram) {
    GLint length = 0;
    if (isProgram)
        glGetProgramiv(object, GL_INFO_LOG_LENGTH, &length);
    else
        glGetShaderiv(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    if (isProgram)
        glGetProgramInfoLog(object, length, nullptr, log.data());
    else
        glGetShaderInfoLog(object, length, nullptr, log.data());
    return log.substr(0, std::min<std::size_t>(log.find('\0'), 2000));
}

GLuint compile(GLenum kind, const std::string& head, std::span<const std::string_view> parts) {
    std::vector<const GLchar*> texts{head.c_str()};
    std::vector<GLint> lengths{static_cast<GLint>(head.size())};
    for (const std::string_view part : parts) {
        texts.push_back(part.data());
        lengths.push_back(static_cast<GLint>(part.size()));
    }
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    glCompileShader(shader);
    return shader;
}

bool isCompiled(GLuint shader) {
    GLint status = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &status);
    return status == GL_TRUE;
}

}  // namespace

Result<GlLimits> glLimits() {
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    if (version == nullptr) return Error(Code::NoGraphics, "no OpenGL context is current");
    // "OpenGL ES 3.2 ...", also in browsers (Emscripten).
    constexpr std::string_view kName = "OpenGL ES ";
    const std::string_view text(version);
    if (text.substr(0, kName.size()) != kName || text.size() <= kName.size() || text[kName.size()] < '3')
        return Error(Code::NoGraphics, fmt::format("found '{}', but OpenGL ES 3.0 is needed", version));
    clearGlErrors();
    GlLimits limits;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.textureSize);
    limits.rowBits = limits.textureSize >= 4096 ? 12 : 11;
    return limits;
}

void clearGlErrors() noexcept {
    for (int n = 0; n < 16 && glGetError() != GL_NO_ERROR; ++n) {
    }
}

Result<void> checkGl(std::string_view doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return {};
    if (error == GL_OUT_OF_MEMORY)
        return Error(Code::NoGraphics,
                     fmt::format("the graphics memory does not hold {}; draw a coarser volume or a smaller picture, or "
                                 "without OpenGL",
                                 doing));
    return Error(Code::NoGraphics, fmt::format("OpenGL error 0x{:04x} with {}", error, doing));
}

void Texture::allocate(GLenum internalFormat, GLsizei width, GLsizei height) {
    const std::array<GLint, 3> size{width, height, static_cast<GLint>(internalFormat)};
    const bool isNew = name_ == 0;
    if (isNew) glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    if (isNew) {
        for (const GLenum parameter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, parameter, GL_NEAREST);
        for (const GLenum parameter : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            glTexParameteri(GL_TEXTURE_2D, parameter, GL_CLAMP_TO_EDGE);
    }
    if (size == size_) return;
    size_ = size;
    const TexelLayout layout = layoutOf(internalFormat);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internalFormat), width, height, 0, layout.format, layout.type,
                 nullptr);
}

Result<void> Texture::setArray(GLenum internalFormat, const void* data, std::size_t count, const GlLimits& limits) {
    const TexelLayout layout = layoutOf(internalFormat);
    const std::size_t width = std::size_t{1} << limits.rowBits;
    const std::size_t rows = std::max<std::size_t>((count + width - 1) / width, 1);
    if (rows > static_cast<std::size_t>(limits.textureSize))
        return Error(Code::GridTooLarge,
                     fmt::format("an array of {} elements is over the {} that this graphics driver's textures hold; "
                                 "draw a coarser volume, or without OpenGL",
                                 count, width * static_cast<std::size_t>(limits.textureSize)));
    allocate(internalFormat, static_cast<GLsizei>(rows == 1 ? std::bit_ceil(std::max<std::size_t>(count, 1)) : width),
             static_cast<GLsizei>(rows));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::size_t whole = count / width, rest = count % width;
    const auto* bytes = static_cast<const std::byte*>(data);
    if (whole > 0)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(whole), layout.format,
                        layout.type, bytes);
    if (rest > 0)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(whole), static_cast<GLsizei>(rest), 1, layout.format,
                        layout.type, bytes + whole * width * layout.bytes);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return {};
}

void Texture::setTarget(GLenum internalFormat, GLsizei width, GLsizei height) {
    allocate(internalFormat, std::max(width, size_[0]), std::max(height, size_[1]));
}

void Target::bind(std::initializer_list<GLuint> textures) {
    if (name_ == 0) glGenFramebuffers(1, &name_);
    glBindFramebuffer(GL_FRAMEBUFFER, name_);
    std::vector<GLenum> buffers;
    for (const GLuint texture : textures) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
        glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, texture, 0);
    }
    glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
}

Result<Program> Program::make(const std::string& defines, std::span<const std::string_view> parts) {
    const std::string head =
        "#version 300 es\nprecision highp float;\nprecision highp int;\n"
        "precision highp usampler2D;\n" +
        defines;
    const std::array vertexParts{shaders::pictureVertex()};
    Program program;
    program.name_ = glCreateProgram();
    const GLuint vertex = compile(GL_VERTEX_SHADER, head, vertexParts);
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, head, parts);
    std::string log;
    for (const GLuint shader : {vertex, fragment}) {
        if (!isCompiled(shader)) log += logOf(shader, false);
        glAttachShader(program.name_, shader);
    }
    glLinkProgram(program.name_);
    GLint status = GL_FALSE;
    glGetProgramiv(program.name_, GL_LINK_STATUS, &status);
    if (status != GL_TRUE && log.empty()) log = logOf(program.name_, true);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    if (status != GL_TRUE)
        return Error(Code::NoGraphics, fmt::format("the graphics driver rejects the shader: {}", log));
    return program;
}

GLint Program::at(const char* uniform) {
    const auto known = locations_.find(std::string_view(uniform));
    if (known != locations_.end()) return known->second;
    return locations_.emplace(uniform, glGetUniformLocation(name_, uniform)).first->second;
}

void Program::use() {
    glUseProgram(name_);
    units_ = 0;
}

void Program::set(const char* uniform, GLint value) { glUniform1i(at(uniform), value); }
void Program::set(const char* uniform, GLuint value) { glUniform1ui(at(uniform), value); }
void Program::set(const char* uniform, float value) { glUniform1f(at(uniform), value); }
void Program::set(const char* uniform, double x, double y) {
    glUniform2f(at(uniform), static_cast<float>(x), static_cast<float>(y));
}
void Program::set(const char* uniform, Vec3d v) {
    glUniform3f(at(uniform), static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}
void Program::set(const char* uniform, Vec3i v) { glUniform3i(at(uniform), v.x, v.y, v.z); }
void Program::setPair(const char* uniform, GLint x, GLint y) { glUniform2i(at(uniform), x, y); }

void Program::set(const char* uniform, const std::array<Vec3d, 3>& columns) {
    std::array<float, 9> values{};
    for (std::size_t column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            values[3 * column + static_cast<std::size_t>(row)] = static_cast<float>(columns[column][row]);
    glUniformMatrix3fv(at(uniform), 1, GL_FALSE, values.data());
}

void Program::set(const char* uniform, std::span<const Vec3i> values) {
    std::vector<GLint> flat;
    for (const Vec3i v : values) flat.insert(flat.end(), {v.x, v.y, v.z});
    glUniform3iv(at(uniform), static_cast<GLsizei>(values.size()), flat.data());
}

void Program::set(const char* uniform, std::span<const GLuint> values) {
    glUniform1uiv(at(uniform), static_cast<GLsizei>(values.size()), values.data());
}

void Program::setPairs(const char* uniform, std::span<const float> values) {
    glUniform2fv(at(uniform), static_cast<GLsizei>(values.size() / 2), values.data());
}

void Program::bind(const char* uniform, const Texture& texture) {
    const GLint location = at(uniform);
    if (location < 0) return;
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(units_));
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glUniform1i(location, units_++);
}

}  // namespace svt::render_gl
