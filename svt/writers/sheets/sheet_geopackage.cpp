#include <svt/writers/sheet_geopackage.hpp>

#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/geopackage/geopackage.hpp>

#include <fmt/format.h>

#include <map>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using MapLine = std::vector<MapPoint>;

constexpr const char* kViewColumns = "name TEXT,kind TEXT,height DOUBLE,origin TEXT,u TEXT,v TEXT,\n normal TEXT";
constexpr const char* kLineColumns = "view INTEGER,kind TEXT,id TEXT,class TEXT,name TEXT";
constexpr const char* kPolygonColumns =
    "view INTEGER,kind TEXT,id TEXT,class TEXT,name TEXT,area DOUBLE,bound DOUBLE,exact INTEGER";
constexpr const char *kLines = "MULTILINESTRING", *kPolygons = "MULTIPOLYGON";

class PackageWriter {
public:
    PackageWriter(const SheetContent& content, const volume::SemanticVolume& volume, GeoPackage& package)
        : content_(content), volume_(volume), package_(package) {}

    void write() {
        package_.createTable("views", kViewColumns);
        for (const char* const table : {"plan_polygons", "upright_polygons"})
            package_.createFeatures(table, kPolygons, kPolygonColumns);
        for (const char* const table : {"plan_lines", "upright_lines"})
            package_.createFeatures(table, kLines, kLineColumns);
        for (std::size_t n = 0; n < content_.views.size(); ++n) addView(n);
        for (const std::string table : {"plan_polygons", "plan_lines", "upright_polygons", "upright_lines"})
            package_.describeFeatures(table, table.ends_with("polygons") ? kPolygons : kLines,
                                      table.starts_with("plan") ? package_.reference() : GeoPackage::kCartesian,
                                      extents_[table]);
        package_.describeAttributes("views");
    }

private:
    [[nodiscard]] static std::string_view kindName(drawing::ViewKind kind) noexcept {
        return kind == drawing::ViewKind::Plan ? "plan" : kind == drawing::ViewKind::Section ? "section" : "elevation";
    }

    void addView(std::size_t number) {
        const DrawnView& drawn = content_.views[number];
        const drawing::PlaneAxes& axes = drawn.drawing.axes;
        const bool isPlan = drawn.view.kind == drawing::ViewKind::Plan;
        view_ = static_cast<std::int64_t>(number) + 1;
        package_.insert("views", Row{view_, drawn.view.name, kindName(drawn.view.kind),
                                     isPlan ? Cell(drawn.drawing.plane.point.z) : Cell(), vectorText(axes.origin, 6),
                                     vectorText(axes.u, 15), vectorText(axes.v, 15), vectorText(axes.normal, 15)});
        drawing_ = &drawn.drawing;
        isPlan_ = isPlan;
        for (const drawing::SectionComponent& component : drawn.drawing.components)
            if (!component.polygons.empty()) addPolygons(component);
        std::map<std::uint32_t, std::vector<MapLine>> sheets;
        for (const drawing::SectionLine& line : drawn.drawing.lines) sheets[line.label].push_back(placed(line.points));
        for (const auto& [label, lines] : sheets) addLines(label, "sheet", lines);
        std::map<std::pair<drawing::BeyondKind, std::uint32_t>, std::vector<MapLine>> beyond;
        for (const drawing::BeyondLine& line : drawn.drawing.beyond)
            beyond[{line.kind, line.label}].push_back(placed({line.from, line.to}));
        for (const auto& [key, lines] : beyond) addLines(key.second, beyondName(key.first), lines);
        for (const drawing::DoorSwing& door : drawn.drawing.doors) {
            std::vector<MapLine> lines;
            for (const auto& line : door.lines) lines.push_back(placed(line));
            for (const auto& arc : door.arcs) lines.push_back(placed(drawing::pointsOf(arc)));
            addLines(door.label, "swing", lines);
        }
    }

    [[nodiscard]] MapLine placed(const std::vector<PlanePoint>& points) const {
        MapLine result;
        for (const PlanePoint p : points) {
            const Vec3d world = isPlan_ ? drawing_->axes.worldFromPlane(p) : Vec3d{p.u, p.v, 0};
            result.push_back({world.x, world.y});
        }
        return result;
    }

    // A geometry with its row, in the table of plans or that of upright views.
    template <class AddParts>
    void addFeature(std::uint32_t number, std::string_view kind, const char* table, const MapBounds& bounds,
                    const AddParts& addParts, const Row& further = {}) {
        GeometryBlob blob(isPlan_ ? package_.reference() : GeoPackage::kCartesian, bounds);
        addParts(blob);
        const std::string name = std::string(isPlan_ ? "plan_" : "upright_") + table;
        extents_[name].add(bounds);
        const volume::Label& label = volume_.labels.labels[number];
        Row row{{}, blob.take(), view_, kind, label.id, label.className, label.name};
        row.insert(row.end(), further.begin(), further.end());
        package_.insert(name, row);
    }

    void addPolygons(const drawing::SectionComponent& component) {
        MapBounds bounds;
        for (const auto& polygon : component.polygons) bounds.add(placed(polygon.outer));
        const auto addParts = [&](GeometryBlob& blob) {
            blob.begin(WkbType::MultiPolygon, component.polygons.size());
            for (const auto& polygon : component.polygons) {
                blob.begin(WkbType::Polygon, 1 + polygon.holes.size());
                blob.addRing(placed(polygon.outer));
                for (const drawing::Ring& hole : polygon.holes) blob.addRing(placed(hole));
            }
        };
        addFeature(component.label, "cut", "polygons", bounds, addParts,
                   {component.area, component.areaBound, component.isExact});
    }

    void addLines(std::uint32_t label, std::string_view kind, const std::vector<MapLine>& lines) {
        MapBounds bounds;
        for (const MapLine& line : lines) bounds.add(line);
        addFeature(label, kind, "lines", bounds, [&](GeometryBlob& blob) {
            blob.begin(WkbType::MultiLineString, lines.size());
            for (const MapLine& line : lines) blob.addLine(line);
        });
    }

    const SheetContent& content_;
    const volume::SemanticVolume& volume_;
    GeoPackage& package_;
    std::int64_t view_ = 0;
    bool isPlan_ = false;
    const drawing::SectionDrawing* drawing_ = nullptr;
    std::map<std::string, MapBounds> extents_;
};

}  // namespace

Result<std::string> makeSheetGeoPackage(const SheetContent& content, const volume::SemanticVolume& volume) {
    SVT_TRY(package, GeoPackage::create(volume.crsName));
    PackageWriter(content, volume, *package).write();
    return package->finish();
}

}  // namespace svt::writers
