#include <svt/core/machine.hpp>

#include <fmt/format.h>

namespace svt {

std::string bytesText(std::uint64_t bytes) {
    constexpr double kKb = 1e3, kMb = 1e6, kGb = 1e9;
    const auto size = static_cast<double>(bytes);
    return size < kMb   ? fmt::format("{:.0f} kB", size / kKb)
           : size < kGb ? fmt::format("{:.0f} MB", size / kMb)
                        : fmt::format("{:.1f} GB", size / kGb);
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
