#include <apps/cli/options/paper_scale.hpp>

#include <fmt/format.h>

#include <cstdlib>

namespace svt::cli {

Result<double> parseScale(const std::string& text) {
    const std::string number = text.rfind("1:", 0) == 0 ? text.substr(2) : text;
    char* rest = nullptr;
    const double scale = std::strtod(number.c_str(), &rest);
    if (number.empty() || *rest != '\0' || !(scale >= 0.01 && scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("--scale '{}': expected 1:N with N from 0.01 to 10000000, such as 1:50", text));
    return scale;
}

}  // namespace svt::cli
