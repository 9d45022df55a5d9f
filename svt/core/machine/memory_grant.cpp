#include <svt/core/machine.hpp>

#include <fmt/format.h>

namespace svt {

std::string bytesText(std::uint64_t bytes) {
    constexpr double kMb = 1e6, kGb = 1e9;
    return double(bytes) < kGb ? fmt::format("{:.0f} MB", double(bytes) / kMb)
                               : fmt::format("{:.1f} GB", double(bytes) / kGb);
}

std::optional<MemoryGrant> memoryGrant() {
    const MemoryFigures figures = memoryFigures();
    if (figures.limitBytes) {
        const std::string by = figures.limitedBy == "control group" ? "its control group" : figures.limitedBy;
        return MemoryGrant{*figures.limitBytes,
                           fmt::format("the {} that {} grants", bytesText(*figures.limitBytes), by)};
    }
    if (figures.totalBytes)
        return MemoryGrant{*figures.totalBytes,
                           fmt::format("the {} that the machine has", bytesText(*figures.totalBytes))};
    return {};
}

}  // namespace svt
