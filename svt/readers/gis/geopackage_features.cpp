#include <svt/core/bytes.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/gis/gis_features.hpp>
#include <svt/readers/gis/sqlite_file.hpp>

#include <fmt/format.h>

#include <cstring>
#include <optional>

namespace svt::readers::gis {
namespace {

// Reads well-known binary; every step is checked.
class WkbReader {
public:
    explicit WkbReader(std::string_view bytes) : bytes_(bytes) {}

    /// Polygons of the geometry. \return false if it is not a polygon, or cut off
    bool read(std::vector<GisPolygon>& polygons, int depth = 0) {
        std::uint32_t type = 0;
        if (!readHeader(type)) return false;
        const std::uint32_t kind = (type & 0xFFFFu) % 1000;
        const std::uint32_t thousands = (type & 0xFFFFu) / 1000;
        const bool hasZ = thousands == 1 || thousands == 3 || (type & 0x80000000u) != 0;
        const bool hasM = thousands == 2 || thousands == 3 || (type & 0x40000000u) != 0;
        if ((type & 0x20000000u) != 0 && !skip(4)) return false;
        const std::size_t size = 2 + (hasZ ? 1 : 0) + (hasM ? 1 : 0);
        if (kind == 3) return readPolygon(size, polygons);
        if (kind != 6 || depth > 0) return false;
        std::uint32_t count = 0;
        if (!take(count)) return false;
        for (std::uint32_t n = 0; n < count; ++n)
            if (!read(polygons, depth + 1)) return false;
        return true;
    }

private:
    bool readHeader(std::uint32_t& type) {
        if (bytes_.empty()) return false;
        isBig_ = bytes_[0] == 0;
        bytes_.remove_prefix(1);
        return take(type);
    }
    bool skip(std::size_t count) {
        if (bytes_.size() < count) return false;
        bytes_.remove_prefix(count);
        return true;
    }
    template <class T>
    bool take(T& value) {
        if (bytes_.size() < sizeof(T)) return false;
        char raw[sizeof(T)];
        std::memcpy(raw, bytes_.data(), sizeof(T));
        if (isBig_) std::reverse(raw, raw + sizeof(T));
        std::memcpy(&value, raw, sizeof(T));
        bytes_.remove_prefix(sizeof(T));
        return true;
    }
    bool readPolygon(std::size_t size, std::vector<GisPolygon>& polygons) {
        std::uint32_t rings = 0;
        if (!take(rings)) return false;
        GisPolygon polygon;
        for (std::uint32_t r = 0; r < rings; ++r) {
            std::uint32_t points = 0;
            if (!take(points) || bytes_.size() / (8 * size) < points) return false;
            GisRing ring(points);
            for (Vec3d& p : ring)
                if (!take(p.x) || !take(p.y) || !skip(8 * (size - 2))) return false;
            polygon.rings.push_back(std::move(ring));
        }
        if (!polygon.rings.empty()) polygons.push_back(std::move(polygon));
        return true;
    }

    std::string_view bytes_;
    bool isBig_ = false;
};

// The geometry behind the header of a GeoPackage (OGC 12-128r19, 2.1.3).
std::optional<std::string_view> wkbOf(std::string_view blob) {
    constexpr std::size_t kEnvelopes[] = {0, 32, 48, 48, 64};
    if (blob.size() < 8 || blob.substr(0, 2) != "GP") return std::nullopt;
    const std::size_t envelope = static_cast<unsigned char>(blob[3]) >> 1 & 7;
    if (envelope > 4 || blob.size() < 8 + kEnvelopes[envelope]) return std::nullopt;
    return blob.substr(8 + kEnvelopes[envelope]);
}

struct FeatureTable {
    std::string name, geometry;
    std::int64_t reference = 0;
};

std::string textOf(const SqliteValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text == nullptr ? std::string() : *text;
}

Result<void> addTable(const SqliteFile& database, const FeatureTable& table, GisFile& file) {
    std::vector<SqliteRow> rows;
    SVT_TRY(names, database.select("SELECT * FROM " + quotedName(table.name),
                                   [&](SqliteRow row) { rows.push_back(std::move(row)); }));
    for (const SqliteRow& row : rows) {
        GisFeature feature;
        for (std::size_t n = 0; n < row.size(); ++n) {
            const std::string& name = (*names)[n];
            if (equalsIgnoringCase(name, table.geometry)) {
                const auto* blob = std::get_if<SqliteBlob>(&row[n]);
                const auto wkb = blob == nullptr ? std::nullopt : wkbOf(blob->bytes);
                if (!wkb || !WkbReader(*wkb).read(feature.polygons)) {
                    ++file.skipped;
                    feature.polygons.clear();
                }
            } else if (const auto* text = std::get_if<std::string>(&row[n])) {
                feature.attributes.push_back({name, *text});
            } else if (const auto* whole = std::get_if<std::int64_t>(&row[n])) {
                feature.attributes.push_back({name, *whole});
            } else if (const auto* number = std::get_if<double>(&row[n])) {
                feature.attributes.push_back({name, *number});
            }
        }
        file.features.push_back(std::move(feature));
    }
    return {};
}

}  // namespace

Result<GisFile> readGeoPackage(const std::filesystem::path& path) {
    SVT_TRY(database, SqliteFile::open(path));
    std::vector<FeatureTable> tables;
    SVT_DO(database->select(
        "SELECT table_name, column_name, srs_id FROM gpkg_geometry_columns", [&](const SqliteRow& row) {
            const auto* reference = std::get_if<std::int64_t>(&row[2]);
            tables.push_back({textOf(row[0]), textOf(row[1]), reference == nullptr ? 0 : *reference});
        }));
    GisFile file;
    for (const FeatureTable& table : tables) {
        SVT_DO(addTable(*database, table, file));
        if (file.epsg != 0 || table.reference <= 0) continue;
        SVT_DO(database->select(
            fmt::format("SELECT organization, organization_coordsys_id, srs_name FROM gpkg_spatial_ref_sys "
                        "WHERE srs_id={}",
                        table.reference),
            [&](const SqliteRow& row) {
                const auto* code = std::get_if<std::int64_t>(&row[1]);
                file.crsText = textOf(row[2]);
                if (equalsIgnoringCase(textOf(row[0]), "EPSG") && code != nullptr) file.epsg = static_cast<int>(*code);
                file.isUnknownCrs = file.epsg == 0;
            }));
    }
    return file;
}

}  // namespace svt::readers::gis
