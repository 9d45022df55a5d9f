#include <svt/illustrate/color_by.hpp>

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/owners.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/sheet_views.hpp>

namespace svt::illustrate {

Result<std::vector<double>> areasFor(std::string_view key, const volume::SemanticVolume& volume) {
    std::vector<double> areas;
    if (!equalsIgnoringCase(key, "area")) return areas;
    SVT_TRY(measured, drawing::measureFloorAreas(volume, drawing::findLevels(volume)));
    areas.resize(volume.labels.labels.size(), 0);
    for (const drawing::RoomArea& room : measured->rooms) areas[room.label] = room.area;
    return areas;
}

Result<void> addOwnerAttributes(volume::SemanticVolume& volume, std::string_view table, std::string_view file,
                                Diagnostics& unknown, int threads) {
    SVT_TRY(owners, analyze::parseOwners(table, file, volume.labels, &unknown));
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    std::vector<std::string> names(volume.labels.labels.size());
    for (std::size_t l = 0; l < names.size(); ++l)
        for (const analyze::OwnerFraction& share : owners->ofLabel[l])
            names[l] += (names[l].empty() ? "" : ", ") + owners->names[share.owner];
    for (const auto& component : analyze::divideByOwners(volume, contacts, *owners).components) {
        std::string& name = names[component.label];
        for (const analyze::OwnerShare& share : component.shares)
            if (share.owner != analyze::kNoOwner && share.volume > 0)
                name = name.empty() ? owners->names[share.owner] : "shared";
    }
    for (std::size_t l = 0; l < names.size(); ++l)
        if (!names[l].empty()) volume.labels.labels[l].attributes.push_back({"owner", names[l], ""});
    return {};
}

}  // namespace svt::illustrate
