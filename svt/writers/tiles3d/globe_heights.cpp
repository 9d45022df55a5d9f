#include <svt/writers/globe_heights.hpp>

#include <svt/crs/crs_name.hpp>
#include <svt/crs/globe.hpp>

#include <fmt/format.h>

namespace svt::writers {

GlobeHeights globeHeights(const std::string& crsName, Vec3d place) {
    constexpr const char* kOver = "heights are written as heights over the ellipsoid";
    const crs::CrsCodes codes = crs::codesOf(crsName);
    if (codes.vertical == 0)
        return {0, fmt::format("{}: the CRS does not say from where they count; if they are over the sea, give the "
                               "height of the geoid by --lift",
                               kOver)};
    if (const auto height = crs::geoidHeight(codes.horizontal, codes.vertical, place))
        return {*height, fmt::format("heights are raised by {:.2f} m, the height of the geoid (EPSG:{}) at the place",
                                     *height, codes.vertical)};
    return {0, fmt::format("{}: PROJ has no grid for EPSG:{}; install it (projsync), or give the height of the geoid "
                           "by --lift",
                           kOver, codes.vertical)};
}

}  // namespace svt::writers
