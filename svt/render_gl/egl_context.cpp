#include <svt/render_gl/egl_context.hpp>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace svt::render_gl {
namespace {

// Values of EGL_ANGLE_platform_angle and related extensions, which are missing from some eglext.h.
constexpr EGLenum kPlatformAngle = 0x3202;
constexpr EGLint kAngleType = 0x3203, kAngleVulkan = 0x3450, kAngleDeviceType = 0x3209, kAngleSwiftShader = 0x3487;

struct Way {
    const char* name;
    const char* extension;  // required client extension; empty: none
    EGLenum platform;
    std::vector<EGLint> attributes;
};

const std::vector<Way>& ways() {
    static const std::vector<Way> all{
        {"surfaceless", "EGL_MESA_platform_surfaceless", EGL_PLATFORM_SURFACELESS_MESA, {EGL_NONE}},
        {"SwiftShader",
         "EGL_ANGLE_platform_angle",
         kPlatformAngle,
         {kAngleType, kAngleVulkan, kAngleDeviceType, kAngleSwiftShader, EGL_NONE}},
        {"default", "", 0, {EGL_NONE}}};
    return all;
}

bool hasExtension(EGLDisplay display, std::string_view name) {
    const char* all = eglQueryString(display, EGL_EXTENSIONS);
    return all != nullptr && std::string_view(all).find(name) != std::string_view::npos;
}

EGLDisplay displayOf(const Way& way) {
    if (way.platform == 0) return eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (!hasExtension(EGL_NO_DISPLAY, way.extension)) return EGL_NO_DISPLAY;
    const auto getDisplay =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    return getDisplay == nullptr
               ? EGL_NO_DISPLAY
               : getDisplay(way.platform, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), way.attributes.data());
}

std::string textOf(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text == nullptr ? "" : text;
}

}  // namespace

struct EglContext::Parts {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;

    ~Parts() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    }

    // Returns what failed; empty on success.
    std::string open(const Way& way) {
        display = displayOf(way);
        if (display == EGL_NO_DISPLAY) return "no such display";
        if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return "the display cannot be used";
        if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return "no OpenGL ES";
        const EGLint wanted[]{EGL_SURFACE_TYPE,
                              EGL_PBUFFER_BIT,
                              EGL_RENDERABLE_TYPE,
                              EGL_OPENGL_ES3_BIT,
                              EGL_RED_SIZE,
                              8,
                              EGL_ALPHA_SIZE,
                              8,
                              EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count < 1)
            return "no configuration for OpenGL ES 3.0";
        const EGLint version[]{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
        if (context == EGL_NO_CONTEXT) return "no context of OpenGL ES 3.0";
        if (!hasExtension(display, "EGL_KHR_surfaceless_context")) {
            const EGLint onePixel[]{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
            surface = eglCreatePbufferSurface(display, config, onePixel);
        }
        if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE) return "the context cannot be made current";
        return {};
    }
};

EglContext::EglContext(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Result<EglContext> EglContext::make() {
    std::string tried;
    for (const Way& way : ways()) {
        auto parts = std::make_unique<Parts>();
        const std::string problem = parts->open(way);
        if (problem.empty()) return EglContext(std::move(parts));
        tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", way.name, problem);
    }
    return Error(Code::NoGraphics,
                 fmt::format("found no driver for OpenGL ES 3.0 ({}); install one, such as libegl-mesa0 and "
                             "libgl1-mesa-dri, or draw without OpenGL",
                             tried));
}

std::string EglContext::renderer() const { return textOf(GL_RENDERER); }

std::string EglContext::version() const { return textOf(GL_VERSION); }

}  // namespace svt::render_gl
