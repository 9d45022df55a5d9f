#include <apps/cli/options/paper_scale.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

namespace svt::cli {

void PaperScale::read(record::Faults& faults, const record::Json& json, const std::string& path, const Option& option,
                      double& to) {
    std::string text;
    record::Codec<std::string>::read(faults, json, path, option, text);
    const auto scale = parseNumber(std::string_view(text).substr(text.starts_with("1:") ? 2 : 0));
    if (!scale || !(*scale >= 0.01 && *scale <= 1e7))
        return faults.add(
            path, fmt::format("{} '{}': expected 1:N with N from 0.01 to 10000000, such as 1:50", option.name, text));
    to = *scale;
}

record::Json PaperScale::write(const Option&, double from) { return fmt::format("1:{}", from); }

}  // namespace svt::cli
