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
    EXPECT_EQ(test::context()->version(), version);
    EXPECT_FALSE(test::context()->renderer().empty());
}

TEST(EglContext, SoftwareIsKnownByItsName) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("zink (SwiftShader Device (LLVM 10.0.0))"));
    EXPECT_TRUE(isSoftwareRenderer("softpipe"));
    EXPECT_FALSE(isSoftwareRenderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
    EXPECT_FALSE(isSoftwareRenderer("NVIDIA H100/PCIe/SSE2"));
    EXPECT_FALSE(isSoftwareRenderer(""));
}

}  // namespace
}  // namespace svt::render_gl
