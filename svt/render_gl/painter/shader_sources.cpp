#include <svt/render_gl/painter/shader_sources.hpp>

#include <cstddef>

// Files of shaders/, see svt_embed_file.
#define SVT_SHADER(name)                                                                     \
    extern "C" const unsigned char svt_shader_##name[];                                      \
    extern "C" const std::size_t svt_shader_##name##_size;                                   \
    std::string_view svt::render_gl::shaders::name() {                                       \
        return {reinterpret_cast<const char*>(svt_shader_##name), svt_shader_##name##_size}; \
    }

SVT_SHADER(tables)
SVT_SHADER(ray)
SVT_SHADER(clips)
SVT_SHADER(light)
SVT_SHADER(fitted)
SVT_SHADER(shapes)
SVT_SHADER(hatches)
SVT_SHADER(cast)
SVT_SHADER(resolve)
SVT_SHADER(pictureVertex)

#undef SVT_SHADER
