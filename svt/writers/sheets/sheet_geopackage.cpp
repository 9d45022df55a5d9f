#include <svt/writers/sheet_geopackage.hpp>

#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/sheets/geopackage_tables.hpp>
#include <svt/writers/sheets/sqlite_database.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>

namespace svt::writers {
namespace {

using illustrate::PlanePoint;
using PackageLine = std::vector<PlanePoint>;

constexpr const char* kViewTable = R"(
CREATE TABLE views(fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,name TEXT,kind TEXT,height DOUBLE,origin TEXT,u TEXT,v TEXT,
 normal TEXT);
)";
constexpr const char* kPolygonColumns =
    "(fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,geom MULTIPOLYGON,view INTEGER,kind TEXT,id TEXT,class TEXT,name "
    "TEXT,"
    "area DOUBLE,bound DOUBLE,exact INTEGER);";
constexpr const char* kLineColumns =
    "(fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,geom MULTILINESTRING,view INTEGER,kind TEXT,id TEXT,class "
    "TEXT,name TEXT);";
constexpr const char* kLastChange = "2000-01-01T00:00:00.000Z";  // so that equal models give equal bytes
constexpr std::int64_t kCartesian = -1;

struct PackageBounds {
    double minX = 1e300, minY = 1e300, maxX = -1e300, maxY = -1e300;
    void add(PlanePoint p) noexcept {
        minX = std::min(minX, p.u);
        minY = std::min(minY, p.v);
        maxX = std::max(maxX, p.u);
        maxY = std::max(maxY, p.v);
    }
    void add(const PackageBounds& other) noexcept {
        add(PlanePoint{other.minX, other.minY});
        add(PlanePoint{other.maxX, other.maxY});
    }
    [[nodiscard]] bool isEmpty() const noexcept { return !(minX <= maxX); }
};

// A geometry as the standard stores it: a header with its extent, then well-known binary, all little-endian.
class GeometryBlob {
public:
    GeometryBlob(std::int64_t reference, const PackageBounds& bounds) {
        for (const char c : {'G', 'P', '\0', '\3'}) bytes_.push_back(static_cast<std::byte>(c));
        add(static_cast<std::int32_t>(reference));
        for (const double value : {bounds.minX, bounds.maxX, bounds.minY, bounds.maxY}) add(value);
    }
    template <class T>
    void add(T value) {
        static_assert(std::endian::native == std::endian::little);
        std::array<std::byte, sizeof(T)> raw;
        std::memcpy(raw.data(), &value, sizeof(T));
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    }
    // Begins a geometry of `count` parts.
    void begin(std::uint32_t type, std::size_t count) {
        bytes_.push_back(std::byte{1});
        add(type);
        add(static_cast<std::uint32_t>(count));
    }
    void addPoints(const PackageLine& points, bool isRing) {
        add(static_cast<std::uint32_t>(points.size() + (isRing ? 1 : 0)));
        for (const PlanePoint p : points) addPoint(p);
        if (isRing) addPoint(points.front());
    }
    void addPoint(PlanePoint p) {
        add(p.u);
        add(p.v);
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

constexpr std::uint32_t kWkbLineString = 2, kWkbPolygon = 3, kWkbMultiLineString = 5, kWkbMultiPolygon = 6;

class PackageWriter {
public:
    PackageWriter(const SheetContent& content, const volume::SemanticVolume& volume, SqliteDatabase& database)
        : content_(content), volume_(volume), database_(database) {
        if (const std::uint32_t epsg = epsgCodeOf(volume.crsName); epsg != 0) reference_ = epsg;
    }

    void write() {
        database_.run(std::string("BEGIN;") + kGeoPackageTables + kViewTable);
        addReferenceSystems(database_, reference_, volume_.crsName);
        for (const char* const table : {"plan_polygons", "upright_polygons"})
            database_.run(std::string("CREATE TABLE ") + table + kPolygonColumns);
        for (const char* const table : {"plan_lines", "upright_lines"})
            database_.run(std::string("CREATE TABLE ") + table + kLineColumns);
        for (std::size_t n = 0; n < content_.views.size(); ++n) addView(n);
        addContents();
        database_.run("COMMIT;");
    }

private:
    [[nodiscard]] static std::string_view kindName(illustrate::ViewKind kind) noexcept {
        return kind == illustrate::ViewKind::Plan      ? "plan"
               : kind == illustrate::ViewKind::Section ? "section"
                                                       : "elevation";
    }

    void addView(std::size_t number) {
        const DrawnView& drawn = content_.views[number];
        const illustrate::PlaneAxes& axes = drawn.drawing.axes;
        const auto text = [](Vec3d v, int decimals) {
            return fmt::format("{} {} {}", shortNumber(v.x, decimals), shortNumber(v.y, decimals),
                               shortNumber(v.z, decimals));
        };
        const bool isPlan = drawn.view.kind == illustrate::ViewKind::Plan;
        view_ = static_cast<std::int64_t>(number) + 1;
        database_.insert("views", {view_, drawn.view.name, std::string(kindName(drawn.view.kind)),
                                   isPlan ? SqliteValue(drawn.drawing.plane.point.z) : SqliteValue(),
                                   text(axes.origin, 6), text(axes.u, 15), text(axes.v, 15), text(axes.normal, 15)});
        drawing_ = &drawn.drawing;
        isPlan_ = isPlan;
        for (const illustrate::SectionComponent& component : drawn.drawing.components)
            if (!component.polygons.empty()) addPolygons(component);
        std::map<std::uint32_t, std::vector<PackageLine>> sheets;
        for (const illustrate::SectionLine& line : drawn.drawing.lines) sheets[line.label].push_back(line.points);
        for (const auto& [label, lines] : sheets) addLines(label, "sheet", lines);
        std::map<std::pair<illustrate::BeyondKind, std::uint32_t>, std::vector<PackageLine>> beyond;
        for (const illustrate::BeyondLine& line : drawn.drawing.beyond)
            beyond[{line.kind, line.label}].push_back({line.from, line.to});
        for (const auto& [key, lines] : beyond) addLines(key.second, beyondName(key.first), lines);
        for (const illustrate::DoorSwing& door : drawn.drawing.doors) {
            std::vector<PackageLine> lines = door.lines;
            for (const auto& arc : door.arcs) lines.push_back(illustrate::pointsOf(arc));
            addLines(door.label, "swing", lines);
        }
    }

    [[nodiscard]] PlanePoint placed(PlanePoint p) const noexcept {
        if (!isPlan_) return p;
        const Vec3d world = drawing_->axes.worldFromPlane(p);
        return {world.x, world.y};
    }
    [[nodiscard]] PackageLine placed(const PackageLine& points) const {
        PackageLine result;
        for (const PlanePoint p : points) result.push_back(placed(p));
        return result;
    }
    [[nodiscard]] std::int64_t reference() const noexcept { return isPlan_ ? reference_ : kCartesian; }

    void addPolygons(const illustrate::SectionComponent& component) {
        PackageBounds bounds;
        for (const auto& polygon : component.polygons)
            for (const PlanePoint p : polygon.outer) bounds.add(placed(p));
        GeometryBlob blob(reference(), bounds);
        blob.begin(kWkbMultiPolygon, component.polygons.size());
        for (const auto& polygon : component.polygons) {
            blob.begin(kWkbPolygon, 1 + polygon.holes.size());
            blob.addPoints(placed(polygon.outer), true);
            for (const illustrate::Ring& hole : polygon.holes) blob.addPoints(placed(hole), true);
        }
        const volume::Label& label = volume_.labels.labels[component.label];
        const char* const table = isPlan_ ? "plan_polygons" : "upright_polygons";
        extents_[table].add(bounds);
        database_.insert(table,
                         {SqliteValue(), blob.take(), view_, std::string("cut"), label.id, label.className, label.name,
                          component.area, component.areaBound, std::int64_t{component.isExact ? 1 : 0}});
    }

    void addLines(std::uint32_t number, std::string_view kind, const std::vector<PackageLine>& lines) {
        PackageBounds bounds;
        for (const PackageLine& line : lines)
            for (const PlanePoint p : line) bounds.add(placed(p));
        GeometryBlob blob(reference(), bounds);
        blob.begin(kWkbMultiLineString, lines.size());
        for (const PackageLine& line : lines) {
            blob.add(std::uint8_t{1});
            blob.add(kWkbLineString);
            blob.addPoints(placed(line), false);
        }
        const volume::Label& label = volume_.labels.labels[number];
        const char* const table = isPlan_ ? "plan_lines" : "upright_lines";
        extents_[table].add(bounds);
        database_.insert(table,
                         {SqliteValue(), blob.take(), view_, std::string(kind), label.id, label.className, label.name});
    }

    void addContents() {
        for (const std::string table : {"plan_polygons", "plan_lines", "upright_polygons", "upright_lines"}) {
            const std::int64_t reference = table.starts_with("plan") ? reference_ : kCartesian;
            std::vector<SqliteValue> row{table, std::string("features"), table, std::string(),
                                         std::string(kLastChange)};
            const PackageBounds& extent = extents_[table];
            for (const double value : {extent.minX, extent.minY, extent.maxX, extent.maxY}) {
                SqliteValue& field = row.emplace_back();  // null where nothing has an extent
                if (!extent.isEmpty()) field = value;
            }
            row.emplace_back(reference);
            database_.insert("gpkg_contents", row);
            database_.insert("gpkg_geometry_columns",
                             {table, std::string("geom"),
                              std::string(table.ends_with("polygons") ? "MULTIPOLYGON" : "MULTILINESTRING"), reference,
                              std::int64_t{0}, std::int64_t{0}});
        }
        database_.insert("gpkg_contents", {std::string("views"), std::string("attributes"), std::string("views"),
                                           std::string(), std::string(kLastChange), SqliteValue(), SqliteValue(),
                                           SqliteValue(), SqliteValue(), SqliteValue()});
    }

    const SheetContent& content_;
    const volume::SemanticVolume& volume_;
    SqliteDatabase& database_;
    std::int64_t reference_ = kCartesian;  // of plans
    std::int64_t view_ = 0;
    bool isPlan_ = false;
    const illustrate::SectionDrawing* drawing_ = nullptr;
    std::map<std::string, PackageBounds> extents_;
};

}  // namespace

Result<std::string> makeSheetGeoPackage(const SheetContent& content, const volume::SemanticVolume& volume) {
    SVT_TRY(database, makeSqliteDatabase());
    PackageWriter(content, volume, **database).write();
    return (*database)->bytes();
}

}  // namespace svt::writers
