#include <apps/cli/options/paper_scale.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

namespace svt::cli {

Result<double> parseScale(const std::string& text) {
    const auto scale = parseNumber(std::string_view(text).substr(text.starts_with("1:") ? 2 : 0));
    if (!scale || !(*scale >= 0.01 && *scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("--scale '{}': expected 1:N with N from 0.01 to 10000000, such as 1:50", text));
    return *scale;
}

}  // namespace svt::cli
