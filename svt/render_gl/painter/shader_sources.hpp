#pragma once
/// \file
/// Sources of the shaders, embedded in the library; one function per file of shaders/.

#include <string_view>

namespace svt::render_gl::shaders {

[[nodiscard]] std::string_view tables();
[[nodiscard]] std::string_view ray();
[[nodiscard]] std::string_view clips();
[[nodiscard]] std::string_view light();
[[nodiscard]] std::string_view fitted();
[[nodiscard]] std::string_view shapes();
[[nodiscard]] std::string_view hatches();
[[nodiscard]] std::string_view cast();
[[nodiscard]] std::string_view resolve();
[[nodiscard]] std::string_view pictureVertex();

}  // namespace svt::render_gl::shaders
