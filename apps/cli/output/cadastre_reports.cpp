#include <apps/cli/output/cadastre_reports.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::cli {
namespace {

using analyze::LandAdministration;
using analyze::LegalSpace;
using analyze::SpaceRelation;
using analyze::SpaceRelationKind;

const volume::Label& labelOf(const LandAdministration& all, const volume::SemanticVolume& volume, std::uint32_t space) {
    return volume.labels.labels[all.spaces.spaces[space].label];
}

Cell optional(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }
Json optionalJson(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

double outlineArea(const LegalSpace& space) {
    double area = 0;
    for (const analyze::PlanPolygon& polygon : space.outline) area += polygon.area;
    return area;
}

Cell areaOrEmpty(const LegalSpace& space) { return space.outline.empty() ? Cell() : Cell(outlineArea(space)); }

Table unitTable(const LandAdministration& all, const volume::SemanticVolume& volume) {
    Table table;
    table.columns = {{"id", "id"},        {"name", "name"},  {"owner", "owner"},        {"right", "right"},
                     {"share", "share"},  {"body", "body"},  {"bodyVolume", "body m3"}, {"volume", "best m3"},
                     {"area", "plan m2"}, {"faces", "faces"}};
    std::vector<std::size_t> faces(all.spaces.spaces.size(), 0);
    for (const analyze::BoundaryFace& face : all.spaces.faces) {
        ++faces[face.minus];
        if (face.plus != analyze::kNoSpace) ++faces[face.plus];
    }
    for (std::uint32_t s = 0; s < all.spaces.spaces.size(); ++s) {
        const LegalSpace& space = all.spaces.spaces[s];
        const volume::Label& label = labelOf(all, volume, s);
        const Row rest{analyze::spaceBodyName(space.body), optional(space.bodyVolume), optional(space.totalVolume),
                       areaOrEmpty(space), faces[s]};
        bool hasOwner = false;
        for (const analyze::PartyRight& right : all.rights) {
            if (all.units[right.unit].space != s) continue;
            hasOwner = true;
            Row row{label.id, label.name, all.parties[right.party], right.rightType().name};
            row.push_back(right.fraction ? Cell(shareText(right)) : Cell());
            row.insert(row.end(), rest.begin(), rest.end());
            table.rows.push_back(std::move(row));
        }
        if (hasOwner) continue;
        Row row{label.id, label.name, nullptr, nullptr, nullptr};
        row.insert(row.end(), rest.begin(), rest.end());
        table.rows.push_back(std::move(row));
    }
    return table;
}

Json relationJson(const LandAdministration& all, const volume::SemanticVolume& volume, const SpaceRelation& relation) {
    const bool isGap = relation.kind == SpaceRelationKind::Gap;
    Json json{{"kind", relationName(relation.kind)},
              {"a", labelOf(all, volume, relation.a).id},
              {"b", labelOf(all, volume, relation.b).id},
              {"volume", optionalJson(relation.volume)},
              {"bound", relation.volume && std::isfinite(relation.bound) ? Json(relation.bound) : Json(nullptr)},
              {"area", optionalJson(relation.area)},
              {"narrowest", isGap ? Json(relation.narrowest) : Json(nullptr)},
              {"widest", isGap ? Json(relation.widest) : Json(nullptr)},
              {"between", Json::array()},
              {"open", isGap ? Json(relation.isOpen) : Json(nullptr)},
              {"faces", Json::array()},
              {"exact", relation.isExact}};
    for (const std::uint32_t label : relation.between) json["between"].push_back(volume.labels.labels[label].id);
    for (const std::uint32_t face : relation.faces) {
        const analyze::BoundaryFace& shared = all.spaces.faces[face];
        Json rings = Json::array();
        for (const auto& ring : shared.rings) {
            Json points = Json::array();
            for (const Vec3d& p : ring) points.push_back({p.x, p.y, p.z});
            rings.push_back(std::move(points));
        }
        json["faces"].push_back({{"id", fmt::format("face-{}", face + 1)},
                                 {"minus", labelOf(all, volume, shared.minus).id},
                                 {"plus", labelOf(all, volume, shared.plus).id},
                                 {"area", shared.area},
                                 {"low", shared.low},
                                 {"high", shared.high},
                                 {"rings", std::move(rings)}});
    }
    return json;
}

}  // namespace

Table relationTable(const LandAdministration& all, const volume::SemanticVolume& volume) {
    Table table;
    table.columns = {{"a", "a"},
                     {"b", "b"},
                     {"kind", "relation"},
                     {"volume", "m3"},
                     {"bound", "+- m3", 6},
                     {"area", "m2"},
                     {"narrowest", "from m"},
                     {"widest", "to m"},
                     {"open", "open"},
                     {"faces", "faces"},
                     {"exact", "exact"},
                     {"between", ""}};
    for (const SpaceRelation& relation : all.spaces.relations) {
        const bool isGap = relation.kind == SpaceRelationKind::Gap;
        std::vector<std::string> between;
        for (const std::uint32_t label : relation.between) between.push_back(volume.labels.labels[label].id);
        const auto ofGap = [&](const Cell& cell) { return isGap ? cell : Cell(); };
        table.rows.push_back({labelOf(all, volume, relation.a).id, labelOf(all, volume, relation.b).id,
                              relationName(relation.kind), optional(relation.volume),
                              relation.volume && std::isfinite(relation.bound) ? Cell(relation.bound) : Cell(),
                              optional(relation.area), ofGap(relation.narrowest), ofGap(relation.widest),
                              ofGap(relation.isOpen), relation.faces.empty() ? Cell() : Cell(relation.faces.size()),
                              relation.isExact, std::move(between)});
    }
    return table;
}

Json cadastreJson(const LandAdministration& all, const volume::SemanticVolume& volume) {
    Json units = Json::array();
    for (std::uint32_t s = 0; s < all.spaces.spaces.size(); ++s) {
        const LegalSpace& space = all.spaces.spaces[s];
        const volume::Label& label = labelOf(all, volume, s);
        Json rights = Json::array(), shares = Json::object();
        for (const analyze::PartyRight& right : all.rights) {
            if (all.units[right.unit].space != s) continue;
            rights.push_back({{"class", analyze::ladmClassName(right.rightType().of)},
                              {"type", right.rightType().name},
                              {"party", all.parties[right.party]},
                              {"share", optionalJson(right.fraction)},
                              {"fraction", right.share ? Json(shareText(right)) : Json(nullptr)},
                              {"source", right.source == 0 ? Json(nullptr) : Json(all.sources[right.source])}});
            shares[std::string(right.rightType().name)] = optionalJson(sumOfShares(all, right.unit, right.type));
        }
        std::size_t faces = 0;
        for (const analyze::BoundaryFace& face : all.spaces.faces) faces += face.minus == s || face.plus == s ? 1 : 0;
        units.push_back({{"id", label.id},
                         {"class", label.className},
                         {"name", label.name},
                         {"common", space.isCommon},
                         {"body", analyze::spaceBodyName(space.body)},
                         {"bodyVolume", optionalJson(space.bodyVolume)},
                         {"volume", optionalJson(space.totalVolume)},
                         {"area", space.outline.empty() ? Json(nullptr) : Json(outlineArea(space))},
                         {"low", space.box.isEmpty() ? Json(nullptr) : Json(space.box.min.z)},
                         {"high", space.box.isEmpty() ? Json(nullptr) : Json(space.box.max.z)},
                         {"faces", faces},
                         {"rights", std::move(rights)},
                         {"shares", std::move(shares)}});
    }
    Json relations = Json::array();
    for (const SpaceRelation& relation : all.spaces.relations) relations.push_back(relationJson(all, volume, relation));
    const bool isTable = all.partySource == analyze::PartySource::Table;
    return {{"parties", all.parties},
            {"units", std::move(units)},
            {"relations", std::move(relations)},
            {"sources",
             {{"parties", all.partyFile},
              {"isTable", isTable},
              {"documents", std::vector<std::string>(all.sources.begin() + 1, all.sources.end())},
              {"geometry", all.spatialFile}}}};
}

void printCadastre(const LandAdministration& all, const volume::SemanticVolume& volume) {
    print(unitTable(all, volume), TableFormat::Text);
    const Table relations = relationTable(all, volume);
    if (relations.rows.empty()) return;
    fmt::print("\n");
    print(relations, TableFormat::Text);
}

}  // namespace svt::cli
