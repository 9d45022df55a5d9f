#include <svt/field_readers/fds/smoke_codes.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace svt::field_readers {
namespace {

constexpr double kCodes = 254;

using Values = std::array<float, 256>;

Values sootValues(double extinction, double side) {
    Values values{};
    for (std::size_t v = 0; v < 255; ++v) {
        const double opacity = std::min(static_cast<double>(v), kCodes - 0.5) / kCodes;
        values[v] = static_cast<float>(-std::log1p(-opacity) / (extinction * side));
    }
    values[255] = std::numeric_limits<float>::quiet_NaN();
    return values;
}

Values evenValues(std::pair<double, double> range) {
    Values values{};
    for (std::size_t v = 0; v < 255; ++v)
        values[v] = static_cast<float>(range.first + (range.second - range.first) * static_cast<double>(v) / kCodes);
    values[255] = std::numeric_limits<float>::quiet_NaN();
    return values;
}

}  // namespace

Result<Values> smokeValues(const SmvFile& file, const SmvMesh& mesh, const SmvCase& fds, const Reading& reading,
                           Assumptions& assumptions) {
    const std::string quantity = lowerAscii(file.quantity);
    if (quantity == "hrrpuv" || quantity == "temperature") {
        const bool isHeat = quantity == "hrrpuv";
        const auto known = fds.ranges.find(isHeat ? "HRRPUV_MINMAX" : "TEMP_MINMAX");
        // The defaults of FDS.
        const auto range = known != fds.ranges.end() ? known->second
                           : isHeat                  ? std::pair{0.0, 1200.0}
                                                     : std::pair{20.0, 2000.0};
        assumptions.add(
            "code", fmt::format("8 bits, from {} to {} {}{}; a value may be up to {:.3g} too low; values beyond the "
                                "range are at its ends",
                                range.first, range.second, file.unit,
                                known != fds.ranges.end() ? "" : ", the defaults of FDS, which the .smv does not state",
                                (range.second - range.first) / kCodes));
        return evenValues(range);
    }
    if (!(file.extinction > 0))
        return badField(
            fmt::format("the 8 bits of '{}' cannot be decoded: only SOOT DENSITY with an extinction, HRRPUV "
                        "and TEMPERATURE are known; write the quantity as a slice (SLCF)",
                        file.quantity),
            reading.path, file.line);
    const double side = mesh.nodes[0][1] - mesh.nodes[0][0];
    assumptions.add("code",
                    fmt::format("8 bits of opacity of a cell of {:.6g} m, extinction {:.6g} m2/kg; densities of "
                                "{:.4g} kg/m3 and above are stored as this one",
                                side, file.extinction, double{sootValues(file.extinction, side)[254]}));
    return sootValues(file.extinction, side);
}

}  // namespace svt::field_readers
