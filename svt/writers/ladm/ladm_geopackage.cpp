#include <svt/core/bytes.hpp>
#include <svt/writers/geopackage/geopackage.hpp>
#include <svt/writers/ladm_writer.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>

namespace svt::writers {
namespace {

using analyze::BoundaryFace;
using analyze::LandAdministration;
using analyze::LegalSpace;
using analyze::SpaceRelation;
using volume::kNoLabel;

// By RightClass.
constexpr std::array<const char*, 3> kRightTables{"la_right", "la_restriction", "la_responsibility"};

// Keys of rows begin at 1.
std::int64_t rowKey(std::size_t index) noexcept { return static_cast<std::int64_t>(index) + 1; }
Cell keyOrEmpty(std::uint32_t index) { return index == analyze::kNoSpace ? Cell() : Cell(rowKey(index)); }
Cell numberCell(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

// A polygon with heights: header of GeoPackage, then ISO well-known binary.
Blob polygonWithHeights(const BoundaryFace& face, std::int64_t reference, MapBounds& bounds) {
    MapBounds own;
    for (const auto& ring : face.rings)
        for (const Vec3d& p : ring) {
            const MapPoint point{p.x, p.y};
            own.add({&point, 1});
        }
    bounds.add(own);
    std::string bytes{'G', 'P', '\0', '\3'};
    appendBytes(bytes, static_cast<std::int32_t>(reference));
    for (const double value : {own.minX, own.maxX, own.minY, own.maxY}) appendBytes(bytes, value);
    constexpr std::uint32_t kPolygonZ = 1003;
    bytes += '\1';
    appendBytes(bytes, kPolygonZ);
    appendBytes(bytes, static_cast<std::uint32_t>(face.rings.size()));
    for (const auto& ring : face.rings) {
        appendBytes(bytes, static_cast<std::uint32_t>(ring.size() + 1));
        for (std::size_t n = 0; n <= ring.size(); ++n)
            for (int axis = 0; axis < 3; ++axis) appendBytes(bytes, ring[n % ring.size()][axis]);
    }
    return {std::move(bytes)};
}

std::string columnList(std::initializer_list<const char*> list) {
    std::string text;
    for (const char* column : list) text += (text.empty() ? "" : ",") + std::string(column);
    return text;
}

class LadmPackage {
public:
    LadmPackage(GeoPackage package, const LandAdministration& administration, const volume::SemanticVolume& volume)
        : package_(std::move(package)), all_(administration), volume_(volume) {}

    Result<std::string> make() {
        createTables();
        addSources();
        addParties();
        addSpaces();
        addFaces();
        addRelations();
        return package_.finish();
    }

private:
    enum Source : std::int64_t { kAdministrative = 1, kSpatial = 2 };

    void createTables() {
        package_.createTable("la_source", columnList({"type TEXT NOT NULL", "name TEXT"}));
        package_.createTable("la_party", "name TEXT NOT NULL");
        package_.createTable("la_baunit", columnList({"uid TEXT NOT NULL UNIQUE", "name TEXT", "class TEXT"}));
        for (const char* const table : kRightTables)
            package_.createTable(
                table,
                columnList({"type TEXT NOT NULL", "party INTEGER NOT NULL REFERENCES la_party(fid)",
                            "baunit INTEGER NOT NULL REFERENCES la_baunit(fid)", "share_numerator INTEGER",
                            "share_denominator INTEGER", "share REAL", "source INTEGER REFERENCES la_source(fid)"}));
        package_.createFeatures(
            "la_spatialunit", "MULTIPOLYGON",
            columnList({"suid TEXT NOT NULL UNIQUE", "name TEXT", "class TEXT", "common BOOLEAN NOT NULL",
                        "baunit INTEGER REFERENCES la_baunit(fid)", "dimension TEXT NOT NULL", "body TEXT NOT NULL",
                        "volume REAL", "body_volume REAL", "area REAL", "low REAL", "high REAL",
                        "source INTEGER REFERENCES la_source(fid)"}));
        package_.createFeatures(
            "la_boundaryface", "POLYGON",
            columnList({"bfid TEXT NOT NULL UNIQUE", "minus INTEGER NOT NULL REFERENCES la_spatialunit(fid)",
                        "plus INTEGER REFERENCES la_spatialunit(fid)", "direction TEXT NOT NULL", "area REAL",
                        "low REAL", "high REAL", "normal_x REAL", "normal_y REAL", "normal_z REAL"}));
        package_.createTable(
            "la_relation", columnList({"kind TEXT NOT NULL", "a INTEGER NOT NULL REFERENCES la_spatialunit(fid)",
                                       "b INTEGER NOT NULL REFERENCES la_spatialunit(fid)", "volume REAL", "bound REAL",
                                       "area REAL", "narrowest REAL", "widest REAL", "\"between\" TEXT", "open BOOLEAN",
                                       "exact BOOLEAN NOT NULL"}));
        package_.createTable("la_relation_face", columnList({"relation INTEGER NOT NULL REFERENCES la_relation(fid)",
                                                             "face INTEGER NOT NULL REFERENCES la_boundaryface(fid)"}));
        for (const char* name : {"la_source", "la_party", "la_baunit", "la_relation", "la_relation_face"})
            package_.describeAttributes(name);
        for (const char* const table : kRightTables) package_.describeAttributes(table);
    }

    void addSources() {
        const bool isTable = all_.partySource == analyze::PartySource::Table;
        package_.insert("la_source", Row{std::int64_t{kAdministrative}, "administrative source",
                                         all_.partyFile + (isTable ? "" : " (attribute owner)")});
        package_.insert("la_source", Row{std::int64_t{kSpatial}, "spatial source", all_.spatialFile});
        for (std::size_t n = 1; n < all_.sources.size(); ++n)
            package_.insert("la_source", Row{sourceKey(n), "administrative source", all_.sources[n]});
    }

    // The key of LandAdministration::sources[n]; the model has the second key.
    static std::int64_t sourceKey(std::size_t n) noexcept { return n == 0 ? kAdministrative : rowKey(n + 1); }

    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }

    void addParties() {
        for (std::size_t n = 0; n < all_.parties.size(); ++n)
            package_.insert("la_party", Row{rowKey(n), all_.parties[n]});
        for (std::size_t n = 0; n < all_.units.size(); ++n) {
            const volume::Label& label = labelOf(all_.units[n].label);
            package_.insert("la_baunit", Row{rowKey(n), label.id, label.name, label.className});
        }
        std::array<std::int64_t, kRightTables.size()> last{};
        for (const analyze::PartyRight& right : all_.rights) {
            const auto table = static_cast<std::size_t>(right.rightType().of);
            Row row{++last[table], right.rightType().name, rowKey(right.party), rowKey(right.unit)};
            row.push_back(right.share ? Cell(right.share->numerator) : Cell());
            row.push_back(right.share ? Cell(right.share->denominator) : Cell());
            row.insert(row.end(), {numberCell(right.fraction), Cell(sourceKey(right.source))});
            package_.insert(kRightTables[table], row);
        }
    }

    [[nodiscard]] Cell outlineOf(const LegalSpace& space, MapBounds& bounds) const {
        if (space.outline.empty()) return {};
        MapBounds own;
        for (const analyze::PlanPolygon& polygon : space.outline) own.add(polygon.outer);
        bounds.add(own);
        GeometryBlob blob(package_.reference(), own);
        blob.begin(WkbType::MultiPolygon, space.outline.size());
        for (const analyze::PlanPolygon& polygon : space.outline) {
            blob.begin(WkbType::Polygon, 1 + polygon.holes.size());
            blob.addRing(polygon.outer);
            for (const auto& hole : polygon.holes) blob.addRing(hole);
        }
        return Cell(blob.take());
    }

    void addSpaces() {
        std::vector<std::int64_t> unitOf(all_.spaces.spaces.size(), 0);
        for (std::size_t n = 0; n < all_.units.size(); ++n) unitOf[all_.units[n].space] = rowKey(n);
        MapBounds bounds;
        for (std::size_t n = 0; n < all_.spaces.spaces.size(); ++n) {
            const LegalSpace& space = all_.spaces.spaces[n];
            const volume::Label& label = labelOf(space.label);
            Row row{rowKey(n), outlineOf(space, bounds), label.id, label.name, label.className, space.isCommon};
            row.push_back(unitOf[n] > 0 ? Cell(unitOf[n]) : Cell());
            double area = 0;
            for (const analyze::PlanPolygon& polygon : space.outline) area += polygon.area;
            row.insert(row.end(),
                       {"3D", spaceBodyName(space.body), numberCell(space.totalVolume), numberCell(space.bodyVolume)});
            row.push_back(space.outline.empty() ? Cell() : Cell(area));
            row.push_back(space.box.isEmpty() ? Cell() : Cell(space.box.min.z));
            row.push_back(space.box.isEmpty() ? Cell() : Cell(space.box.max.z));
            row.emplace_back(std::int64_t{kSpatial});
            package_.insert("la_spatialunit", row);
        }
        package_.describeFeatures("la_spatialunit", "MULTIPOLYGON", package_.reference(), bounds);
    }

    void addFaces() {
        MapBounds bounds;
        for (std::size_t n = 0; n < all_.spaces.faces.size(); ++n) {
            const BoundaryFace& face = all_.spaces.faces[n];
            package_.insert("la_boundaryface", Row{rowKey(n), polygonWithHeights(face, package_.reference(), bounds),
                                                   fmt::format("face-{}", n + 1), rowKey(face.minus),
                                                   keyOrEmpty(face.plus), faceDirectionName(face.direction), face.area,
                                                   face.low, face.high, face.normal.x, face.normal.y, face.normal.z});
        }
        describeFaces(bounds);
    }

    // GeoPackage::describeFeatures() with heights.
    void describeFaces(const MapBounds& bounds) {
        Row row{"la_boundaryface", "features", "la_boundaryface", "", "2000-01-01T00:00:00.000Z"};
        for (const double value : {bounds.minX, bounds.minY, bounds.maxX, bounds.maxY})
            row.push_back(bounds.isEmpty() ? Cell() : Cell(value));
        row.emplace_back(package_.reference());
        package_.insert("gpkg_contents", row);
        package_.insert("gpkg_geometry_columns", Row{"la_boundaryface", "geom", "POLYGON", package_.reference(), 1, 0});
    }

    void addRelations() {
        std::int64_t link = 0;
        for (std::size_t n = 0; n < all_.spaces.relations.size(); ++n) {
            const SpaceRelation& relation = all_.spaces.relations[n];
            const bool isGap = relation.kind == analyze::SpaceRelationKind::Gap;
            std::string between;
            for (const std::uint32_t label : relation.between)
                between += (between.empty() ? "" : " ") + labelOf(label).id;
            Row row{rowKey(n), relationName(relation.kind), rowKey(relation.a), rowKey(relation.b),
                    numberCell(relation.volume)};
            row.push_back(relation.volume && std::isfinite(relation.bound) ? Cell(relation.bound) : Cell());
            row.push_back(numberCell(relation.area));
            row.push_back(isGap ? Cell(relation.narrowest) : Cell());
            row.push_back(isGap ? Cell(relation.widest) : Cell());
            row.push_back(between.empty() ? Cell() : Cell(between));
            row.push_back(isGap ? Cell(relation.isOpen) : Cell());
            row.emplace_back(relation.isExact);
            package_.insert("la_relation", row);
            for (const std::uint32_t face : relation.faces)
                package_.insert("la_relation_face", Row{++link, rowKey(n), rowKey(face)});
        }
    }

    GeoPackage package_;
    const LandAdministration& all_;
    const volume::SemanticVolume& volume_;
};

}  // namespace

Result<std::string> makeLadmGeoPackage(const LandAdministration& administration, const volume::SemanticVolume& volume) {
    SVT_TRY(package, GeoPackage::create(volume.crsName));
    return LadmPackage(std::move(*package), administration, volume).make();
}

}  // namespace svt::writers
