#include <svt/readers/parcels.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/crs/crs_facts.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/projection.hpp>
#include <svt/plane/arrangement.hpp>
#include <svt/plane/regions.hpp>
#include <svt/readers/gis/gis_features.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace svt::readers {
namespace {

using gis::GisFeature;
using gis::GisFile;
using gis::GisPolygon;
using gis::GisRing;

enum class ParcelFormat : std::uint8_t { None, GeoJson, GeoPackage, Shapefile };

ParcelFormat formatOf(std::string_view head) {
    using namespace std::string_view_literals;
    if (head.starts_with("SQLite format 3\0"sv)) return ParcelFormat::GeoPackage;
    if (head.starts_with("\0\0\x27\x0a"sv)) return ParcelFormat::Shapefile;
    if (head.substr(0, 3) == "\xEF\xBB\xBF") head.remove_prefix(3);
    head = withoutBlanks(head);
    const auto has = [&](std::string_view word) { return head.find(word) != std::string_view::npos; };
    const bool isGeoJson = head.starts_with('{') && (has("\"FeatureCollection\"") || has("\"Feature\""));
    return isGeoJson && !has("\"CityJSON") ? ParcelFormat::GeoJson : ParcelFormat::None;
}

std::string headOf(const std::filesystem::path& path) {
    std::string head(4096, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(stream.bad() ? 0 : static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return head;
}

// A file beside the shapefile, with another ending; empty if there is none.
std::string besideOf(std::filesystem::path path, std::initializer_list<const char*> endings, std::uint64_t maxBytes) {
    for (const char* ending : endings) {
        path.replace_extension(ending);
        if (const auto file = FileBytes::read(path, maxBytes)) return std::string(file->text());
    }
    return {};
}

Result<GisFile> readFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
    const ParcelFormat format = formatOf(headOf(path));
    if (format == ParcelFormat::GeoPackage) return gis::readGeoPackage(path);
    SVT_TRY(file, FileBytes::read(path, maxBytes));
    switch (format) {
        case ParcelFormat::GeoJson: return gis::readGeoJson(file->text(), path.string());
        case ParcelFormat::Shapefile: {
            const std::string table = besideOf(path, {".dbf", ".DBF"}, maxBytes);
            const std::string projection = besideOf(path, {".prj", ".PRJ"}, 1 << 20);
            return gis::readShapefile(file->bytes(), std::as_bytes(std::span(table)), projection, path.string());
        }
        default: break;
    }
    return Error(Code::UnknownFormat, "not GeoJSON, a GeoPackage or a shapefile (.shp)", {path.string(), 0, 0, {}});
}

// Converts to the CRS of the model, if both are known and differ.
Result<void> project(GisFile& file, int target, const std::string& name, Diagnostics* diagnostics) {
    std::vector<Vec3d> points;
    for (const GisFeature& feature : file.features)
        for (const GisPolygon& polygon : feature.polygons)
            for (const GisRing& ring : polygon.rings) points.insert(points.end(), ring.begin(), ring.end());
    const int horizontal = target == 0 ? 0 : crs::factsOf(target).horizontal;
    if (points.empty() || file.epsg == horizontal || (file.epsg == 0 && !file.isUnknownCrs)) return {};
    if (file.epsg == 0 || horizontal == 0) {
        if (file.epsg != 0 && crs::factsOf(file.epsg).isDegrees)
            return Error(Code::CannotProject,
                         "the parcels are in degrees, and the CRS of the model is unknown; convert them to its "
                         "coordinates, or build the model with its --crs",
                         {name, 0, 0, {}});
        if (diagnostics != nullptr)
            diagnostics->add(Severity::Warning, Code::MixedCrs,
                             fmt::format("the parcels have the CRS '{}', which was not compared with that of the "
                                         "model: their coordinates are used unchanged",
                                         file.crsText.empty() ? std::to_string(file.epsg) : file.crsText),
                             {name, 0, 0, {}});
        return {};
    }
    SVT_TRY(projection, crs::Projection::between(file.epsg, horizontal, points.front()));
    projection->apply(points);
    std::size_t next = 0;
    for (GisFeature& feature : file.features)
        for (GisPolygon& polygon : feature.polygons)
            for (GisRing& ring : polygon.rings)
                for (Vec3d& p : ring) p = points[next++];
    return {};
}

std::string attributeOf(const GisFeature& feature, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        for (const Attribute& attribute : feature.attributes)
            if (equalsIgnoringCase(attribute.name, name))
                if (std::string text = toText(attribute.value); !text.empty()) return text;
    return {};
}

// Whether the polygons of a parcel enclose each place at most once: its parts do not overlap, and its rings do not cross.
// \param polygons  outer rings counter-clockwise, holes clockwise
bool encloseOnce(const std::vector<std::vector<GisRing>>& polygons) {
    constexpr double kUnit = 1e-3, kReach = 1 << 29;  // metres; whole numbers of it
    constexpr std::int32_t kTolerance = 2;
    Box3d box;
    for (const auto& rings : polygons)
        for (const GisRing& ring : rings)
            for (const Vec3d& p : ring) box.add(p);
    const double unit = std::max({kUnit, box.size().x / kReach, box.size().y / kReach});
    const auto placed = [&](Vec3d p) -> plane::Point {
        return {std::llround((p.x - box.min.x) / unit), std::llround((p.y - box.min.y) / unit)};
    };
    std::vector<plane::ClaimSegment> segments;
    for (const auto& rings : polygons)
        for (const GisRing& ring : rings)
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const plane::Point from = placed(ring[n]), to = placed(ring[(n + 1) % ring.size()]);
                if (from != to) segments.push_back({from, to, 1, 1});
            }
    const auto arranged = plane::arrangeSegments(segments, kTolerance);
    if (!arranged) return false;
    bool isOnce = true;
    static_cast<void>(plane::sweepRegions(*arranged, [&](std::span<const plane::ClaimCount> counts) -> std::uint32_t {
        for (const plane::ClaimCount& count : counts) isOnce = isOnce && count.winding == 1;
        return counts.empty() ? 0 : 1;
    }));
    return isOnce;
}

class ParcelMaker {
public:
    ParcelMaker(double low, double high) : low_(low), high_(high) {}

    void add(GisFeature& source, std::size_t number) {
        model::Geometry geometry;
        geometry.kind = model::GeometryKind::Solid;
        geometry.lod = 1;
        std::vector<std::vector<GisRing>> tops;
        for (GisPolygon& polygon : source.polygons)
            if (std::vector<GisRing> top = topOf(polygon); !top.empty()) tops.push_back(std::move(top));
        if (tops.empty()) return;
        model::Feature feature;
        feature.className = "Parcel";
        feature.id = attributeOf(source, {"id", "gml_id", "nationalCadastralReference", "localId", "flstkennz",
                                          "parcel_id", "parcel", "fid"});
        if (feature.id.empty()) feature.id = fmt::format("parcel-{}", number);
        if (!ids_.insert(feature.id).second) {
            feature.id += fmt::format("-{}", number);
            ids_.insert(feature.id);
        }
        if (!encloseOnce(tops)) {
            crossing_.push_back(feature.id);
            return;
        }
        for (const std::vector<GisRing>& top : tops) addSolid(top, geometry);
        feature.name = attributeOf(source, {"name", "label"});
        feature.attributes = std::move(source.attributes);
        feature.geometries.push_back(std::move(geometry));
        model_.addFeature(std::move(feature), model::kNoFeature);
    }

    [[nodiscard]] std::size_t leftOut() const noexcept { return leftOut_; }
    // Ids of parcels whose parts overlap, or whose rings cross.
    [[nodiscard]] const std::vector<std::string>& crossing() const noexcept { return crossing_; }
    [[nodiscard]] model::BuildingModel take() { return std::move(model_); }

private:
    void addFace(const std::vector<GisRing>& rings, model::Solid& solid) {
        model::Polygon face;
        for (const GisRing& ring : rings) {
            face.points.insert(face.points.end(), ring.begin(), ring.end());
            face.ringEnds.push_back(static_cast<std::uint32_t>(face.points.size()));
        }
        solid.exterior.push_back({model_.addPolygon(std::move(face)), false});
    }

    // The rings of a polygon at the upper height; empty if its outer ring is left out.
    std::vector<GisRing> topOf(GisPolygon& polygon) {
        std::vector<GisRing> top;
        for (GisRing& ring : polygon.rings) {
            if (!gis::tidyRing(ring)) {
                ++leftOut_;
                if (top.empty()) return top;
                continue;
            }
            // Seen from above: the outer ring counter-clockwise, holes clockwise.
            if ((gis::twiceAreaOf(ring) > 0) != top.empty()) std::reverse(ring.begin(), ring.end());
            for (Vec3d& p : ring) p.z = high_;
            top.push_back(ring);
        }
        return top;
    }

    void addSolid(const std::vector<GisRing>& top, model::Geometry& geometry) {
        model::Solid solid;
        addFace(top, solid);
        std::vector<GisRing> bottom = top;
        for (GisRing& ring : bottom) {
            std::reverse(ring.begin(), ring.end());
            for (Vec3d& p : ring) p.z = low_;
        }
        addFace(bottom, solid);
        for (const GisRing& ring : top)
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const Vec3d a = ring[n], b = ring[(n + 1) % ring.size()];
                addFace({{{a.x, a.y, low_}, {b.x, b.y, low_}, b, a}}, solid);
            }
        geometry.solids.push_back(std::move(solid));
    }

    double low_, high_;
    model::BuildingModel model_;
    std::set<std::string> ids_;
    std::size_t leftOut_ = 0;
    std::vector<std::string> crossing_;
};

}  // namespace

bool looksLikeParcels(const std::filesystem::path& path) { return formatOf(headOf(path)) != ParcelFormat::None; }

Result<model::BuildingModel> readParcels(const std::filesystem::path& path, const ParcelOptions& options,
                                         Diagnostics* diagnostics) {
    SVT_TRY(file, readFile(path, options.maxBytes));
    SVT_DO(project(*file, static_cast<int>(crs::epsgCodeOf(options.crsName)), path.string(), diagnostics));
    ParcelMaker maker(options.low, options.high);
    std::size_t number = 0;
    for (GisFeature& feature : file->features) maker.add(feature, ++number);
    const std::size_t leftOut = maker.leftOut();
    if (diagnostics != nullptr)
        for (const std::string& id : maker.crossing())
            diagnostics->add(Severity::Warning, Code::RingsIntersect,
                             "the parts of this parcel overlap, or its rings cross, so its area is not defined; it is "
                             "left out. Repair its polygons",
                             {path.string(), 0, 0, id});
    const bool isAnyCrossing = !maker.crossing().empty();
    model::BuildingModel model = maker.take();
    model.source = path.filename().string();
    if (model.features.empty())
        return Error(Code::EmptyModel,
                     isAnyCrossing ? "no parcel has polygons without crossing rings or overlapping parts; repair them"
                                   : "no polygons; export the parcels as polygons",
                     {path.string(), 0, 0, {}});
    const auto warn = [&](Code code, std::size_t count, std::string_view what) {
        if (count > 0 && diagnostics != nullptr)
            diagnostics->add(Severity::Warning, code, fmt::format("{} {}", count, what), {path.string(), 0, 0, {}});
    };
    warn(Code::NoGeometry, file->skipped, "geometries are not polygons; they are left out");
    warn(Code::TooFewPoints, leftOut, "rings have less than three points or coordinates that are not finite; left out");
    return model;
}

namespace gis {

bool tidyRing(GisRing& ring) {
    if (ring.size() > 1 && ring.front().x == ring.back().x && ring.front().y == ring.back().y) ring.pop_back();
    return ring.size() >= 3 && std::all_of(ring.begin(), ring.end(), [](Vec3d p) { return isFinite(p); }) &&
           twiceAreaOf(ring) != 0;
}

double twiceAreaOf(const GisRing& ring) noexcept {
    double twice = 0;
    for (std::size_t n = 1; n + 1 < ring.size(); ++n) {
        const Vec3d a = ring[n] - ring[0], b = ring[n + 1] - ring[0];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice;
}

int epsgOfText(std::string_view text) noexcept {
    // The last authority is that of the whole system.
    for (const std::string_view key : {"AUTHORITY[\"EPSG\",", "ID[\"EPSG\","}) {
        const std::size_t at = text.rfind(key);
        if (at == std::string_view::npos) continue;
        std::string_view rest = text.substr(at + key.size());
        if (rest.starts_with('"')) rest.remove_prefix(1);
        if (const auto code = parseInteger<int>(rest.substr(0, rest.find_first_not_of("0123456789")))) return *code;
    }
    return 0;
}

}  // namespace gis
}  // namespace svt::readers
