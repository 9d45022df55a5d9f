#include <svt/readers/ifc/storey_level.hpp>

#include <cmath>
#include <string>
#include <string_view>

namespace svt::readers::ifc {
namespace {

constexpr double kSameLevel = 1e-3;     // metres
constexpr int kMostPartialStoreys = 8;  // storeys within storeys

// The origin of the building, or of another structure, that a storey belongs to.
Vec3d buildingOrigin(const IfcFile& file, const Structure& structure, const Product& storey, std::string& lost) {
    std::size_t above = storey.parent;
    for (int level = 0; level < kMostPartialStoreys && above != Product::kNoProduct; ++level) {
        const Product& product = structure.products[above];
        if (product.ifcType != "IfcBuildingStorey")
            return file.placement(file.follow(product.record, at::Product::ObjectPlacement), lost).origin;
        above = product.parent;
    }
    return {};
}

}  // namespace

std::optional<double> storeyLevel(const IfcFile& file, const Structure& structure, const Product& storey,
                                  const MapPlace& map) {
    const Value stated = file.fieldsOf(storey.record)[at::BuildingStorey::Elevation];
    const RecordIndex place = file.follow(storey.record, at::Product::ObjectPlacement);
    if (place == kNoRecord && !stated.number()) return std::nullopt;
    std::string lost;
    const Vec3d building = buildingOrigin(file, structure, storey, lost);
    Vec3d level = place == kNoRecord ? building : file.placement(place, lost).origin;
    if (!lost.empty()) return std::nullopt;
    if (stated.number()) {
        const double elevation = file.metres(stated);
        const bool isUnplaced =
            std::abs(level.z - building.z) < kSameLevel && std::abs(level.z - elevation) >= kSameLevel;
        if (isUnplaced) level.z = building.z + elevation;
    }
    const double height = map.mapFromProject.point(level).z;
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
}

std::size_t northBearer(const Structure& structure) {
    for (const std::string_view type : {"IfcSite", "IfcBuilding"})
        for (const std::size_t p : structure.order)
            if (structure.products[p].ifcType == type) return p;
    return structure.order.front();
}

}  // namespace svt::readers::ifc
