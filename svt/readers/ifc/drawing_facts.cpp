#include <svt/readers/ifc/drawing_facts.hpp>

#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::readers::ifc {
namespace {

constexpr std::size_t kMostAxes = 1000, kMostAxisPoints = 2000;

void addPositive(const IfcFile& file, std::string_view name, Value length, model::Feature& feature) {
    // Whole nanometres: 2010 mm is 2.01 m, without the rounding error of the product.
    const double metres = std::round(file.metres(length) * 1e9) / 1e9;
    if (length.number() && metres > 0) feature.attributes.push_back({std::string(name), metres, "m"});
}

// Without line breaks and blanks at the ends: some writers have "MA\r" as a region.
std::string onOneLine(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

// Building name or room, lines of the address, post code and town, region, country.
std::string addressText(const IfcFile& file, RecordIndex address) {
    if (file.typeName(address) != "IFCPOSTALADDRESS") return {};
    const Fields fields = file.fieldsOf(address);
    std::string text;
    const auto add = [&](const std::string& part, std::string_view separator) {
        if (part.empty()) return;
        text += (text.empty() ? "" : std::string(separator)) + part;
    };
    const auto textOf = [&](AttributePosition at) { return onOneLine(fields[at].string().value_or("")); };
    add(textOf(at::PostalAddress::InternalLocation), ", ");
    for (const Value line : itemsOf(fields[at::PostalAddress::AddressLines]))
        add(onOneLine(line.string().value_or("")), ", ");
    const std::string code = textOf(at::PostalAddress::PostalCode);
    add(code, ", ");
    add(textOf(at::PostalAddress::Town), code.empty() ? ", " : " ");
    add(textOf(at::PostalAddress::Region), ", ");
    add(textOf(at::PostalAddress::Country), ", ");
    return text;
}

void addAxes(const IfcFile& file, const Product& grid, const MapPlace& map, model::Feature& feature) {
    std::string lost;
    const Fields fields = file.fieldsOf(grid.record);
    const Transform place = file.placement(file.follow(fields[at::Product::ObjectPlacement]), lost);
    if (!lost.empty()) return;
    std::size_t count = 0;
    for (const AttributePosition family : {at::Grid::UAxes, at::Grid::VAxes, at::Grid::WAxes})
        for (const RecordIndex axis : file.followAll(fields[family])) {
            const Fields of = file.fieldsOf(axis);
            const std::string name = of[at::GridAxis::AxisTag].string().value_or("");
            std::vector<Vec3d> points;
            std::string why;
            if (name.empty() || ++count > kMostAxes) continue;
            if (!readCurve(file, file.follow(of[at::GridAxis::AxisCurve]), points, why)) continue;
            std::string text;
            for (const Vec3d& point : points) {
                const Vec3d p = map.mapFromProject.point(place.point(point));
                if (!isFinite(p)) text.clear();
                if (!isFinite(p)) break;
                text += fmt::format("{}{:.6f} {:.6f} {:.6f}", text.empty() ? "" : ", ", p.x, p.y, p.z);
            }
            if (points.size() >= 2 && points.size() <= kMostAxisPoints && !text.empty())
                feature.attributes.push_back({"axis " + name, std::move(text), "m"});
        }
}

}  // namespace

void addDrawingFacts(const IfcFile& file, const Product& product, const MapPlace& map, model::Feature& feature) {
    const std::string_view type = product.ifcType;
    if (type == "IfcGrid") return addAxes(file, product, map, feature);
    const Fields fields = file.fieldsOf(product.record);
    if (type.starts_with("IfcDoor")) {
        addPositive(file, "overallWidth", fields[at::Door::OverallWidth], feature);
        addPositive(file, "overallHeight", fields[at::Door::OverallHeight], feature);
    } else if (type.starts_with("IfcWindow")) {
        addPositive(file, "overallWidth", fields[at::Window::OverallWidth], feature);
        addPositive(file, "overallHeight", fields[at::Window::OverallHeight], feature);
    } else if (type == "IfcStairFlight") {
        const auto risers = fields[at::StairFlight::NumberOfRisers].number();
        if (risers && *risers >= 1 && *risers <= 1000)
            feature.attributes.push_back({"numberOfRisers", static_cast<std::int64_t>(*risers), ""});
        addPositive(file, "riserHeight", fields[at::StairFlight::RiserHeight], feature);
        addPositive(file, "treadLength", fields[at::StairFlight::TreadLength], feature);
    } else if (type == "IfcSite" || type == "IfcBuilding") {
        const Value address = type == "IfcSite" ? fields[at::Site::SiteAddress] : fields[at::Building::BuildingAddress];
        if (std::string text = addressText(file, file.follow(address)); !text.empty())
            feature.attributes.push_back({"address", std::move(text), ""});
    }
}

}  // namespace svt::readers::ifc
