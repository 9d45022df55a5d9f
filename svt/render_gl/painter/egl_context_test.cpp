#include <svt/render_gl/compare_test.hpp>
#include <svt/render_gl/egl_context.hpp>

#include <GLES3/gl3.h>
#include <gtest/gtest.h>

#include <string_view>

namespace svt::render_gl {
namespace {

TEST(EglContext, IsCurrentAndOfOpenGlEs3) {
    SVT_NEEDS_GL();
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    ASSERT_NE(version, nullptr);
    EXPECT_EQ(std::string_view(version).substr(0, 11), "OpenGL ES 3") << version;
    EXPECT_FALSE(test::context()->renderer().empty());
}

}  // namespace
}  // namespace svt::render_gl
