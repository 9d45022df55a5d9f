#include <svt/core/bytes.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/gis/gis_features.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace svt::readers::gis {
namespace {

constexpr std::size_t kHeader = 100, kFieldSize = 32;

std::uint32_t bigEndian(std::span<const std::byte> bytes, std::size_t at) noexcept {
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < 4; ++n) value = value << 8 | static_cast<std::uint32_t>(bytes[at + n]);
    return value;
}
template <class T>
T littleEndian(std::span<const std::byte> bytes, std::size_t at) noexcept {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
}

bool isInside(const GisRing& ring, Vec3d p) noexcept {
    bool inside = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec3d a = ring[n], b = ring[(n + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

// Outer rings are clockwise; each hole belongs to the smallest outer ring around it.
std::vector<GisPolygon> polygonsOf(std::vector<GisRing> rings) {
    std::vector<GisPolygon> polygons;
    std::vector<GisRing> holes;
    for (GisRing& ring : rings) {
        if (!tidyRing(ring)) continue;
        if (twiceAreaOf(ring) < 0 || rings.size() == 1)
            polygons.push_back({{std::move(ring)}});
        else
            holes.push_back(std::move(ring));
    }
    for (GisRing& hole : holes) {
        const Vec3d middle = (hole[0] + hole[1]) * 0.5;
        GisPolygon* best = nullptr;
        for (GisPolygon& polygon : polygons)
            if (isInside(polygon.rings[0], middle) &&
                (best == nullptr || std::abs(twiceAreaOf(polygon.rings[0])) < std::abs(twiceAreaOf(best->rings[0]))))
                best = &polygon;
        if (best != nullptr)
            best->rings.push_back(std::move(hole));
        else
            polygons.push_back({{std::move(hole)}});  // an outer ring with the wrong direction
    }
    return polygons;
}

// A record of a polygon; empty if its counts do not fit into it.
std::optional<std::vector<GisPolygon>> readRecord(std::span<const std::byte> record) {
    if (record.size() < 44) return std::nullopt;
    const auto parts = littleEndian<std::uint32_t>(record, 36), points = littleEndian<std::uint32_t>(record, 40);
    const std::uint64_t need = 44 + 4 * std::uint64_t{parts} + 16 * std::uint64_t{points};
    if (need > record.size()) return std::nullopt;
    std::vector<GisRing> rings;
    const std::size_t first = 44 + 4 * std::size_t{parts};
    for (std::uint32_t part = 0; part < parts; ++part) {
        const auto begin = littleEndian<std::uint32_t>(record, 44 + 4 * std::size_t{part});
        const auto end = part + 1 < parts ? littleEndian<std::uint32_t>(record, 48 + 4 * std::size_t{part}) : points;
        if (begin > end || end > points) return std::nullopt;
        GisRing& ring = rings.emplace_back();
        for (std::size_t n = begin; n < end; ++n)
            ring.push_back(
                {littleEndian<double>(record, first + 16 * n), littleEndian<double>(record, first + 16 * n + 8), 0});
    }
    return polygonsOf(std::move(rings));
}

// Text of a table: UTF-8, else Latin-1.
std::string textOfField(std::string_view raw) {
    raw = withoutBlanks(raw.substr(0, raw.find('\0')));
    if (findInvalidUtf8(raw) >= raw.size()) return std::string(raw);
    std::string text;
    for (const char c : raw) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            text += c;
        } else {
            text += static_cast<char>(0xC0 | byte >> 6);
            text += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return text;
}

struct DbfField {
    std::string name;
    char type = 'C';
    std::size_t at = 0, size = 0;
};

// The rows of a dBASE table; fewer than there are features if it is cut off.
std::vector<std::vector<Attribute>> readTable(std::span<const std::byte> bytes) {
    std::vector<std::vector<Attribute>> rows;
    if (bytes.size() < 32) return rows;
    const auto count = littleEndian<std::uint32_t>(bytes, 4);
    const std::size_t header = littleEndian<std::uint16_t>(bytes, 8), size = littleEndian<std::uint16_t>(bytes, 10);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::vector<DbfField> fields;
    std::size_t at = 1;
    for (std::size_t field = 32; field + kFieldSize <= std::min(header, bytes.size()) && text[field] != '\r';
         field += kFieldSize) {
        const std::size_t width = static_cast<unsigned char>(text[field + 16]);
        fields.push_back({textOfField(text.substr(field, 11)), text[field + 11], at, width});
        at += width;
    }
    if (size == 0 || at > size) return rows;
    for (std::uint64_t row = 0; row < count && header + (row + 1) * size <= bytes.size(); ++row) {
        std::vector<Attribute>& attributes = rows.emplace_back();
        for (const DbfField& field : fields) {
            const std::string value = textOfField(text.substr(header + row * size + field.at, field.size));
            if (value.empty()) continue;
            const auto whole = parseInteger<std::int64_t>(value);
            const auto number = parseNumber(value);
            const bool isNumeric = field.type == 'N' || field.type == 'F';
            if (isNumeric && whole)
                attributes.push_back({field.name, *whole});
            else if (isNumeric && number)
                attributes.push_back({field.name, *number});
            else
                attributes.push_back({field.name, value});
        }
    }
    return rows;
}

}  // namespace

Result<GisFile> readShapefile(std::span<const std::byte> bytes, std::span<const std::byte> table,
                              std::string_view projection, const std::string& name) {
    const auto bad = [&](std::string_view problem) {
        return Error(Code::BadValue, fmt::format("shapefile: {}; export the parcels again", problem), {name, 0, 0, {}});
    };
    if (bytes.size() < kHeader || bigEndian(bytes, 0) != 9994) return bad("the header is missing");
    const auto type = littleEndian<std::int32_t>(bytes, 32);
    if (type != 5 && type != 15 && type != 25) return bad("its shapes are not polygons");
    GisFile file;
    file.epsg = epsgOfText(projection);
    file.crsText = std::string(projection.substr(0, 60));
    file.isUnknownCrs = file.epsg == 0 && !withoutBlanks(projection).empty();
    auto rows = readTable(table);
    for (std::size_t at = kHeader; at < bytes.size();) {
        if (bytes.size() - at < 12) return bad("it is cut off");
        const std::uint64_t size = 2 * std::uint64_t{bigEndian(bytes, at + 4)};
        if (size < 4 || size > bytes.size() - at - 8) return bad("it is cut off");
        const auto record = bytes.subspan(at + 8, static_cast<std::size_t>(size));
        GisFeature feature;
        if (const std::size_t n = file.features.size(); n < rows.size()) feature.attributes = std::move(rows[n]);
        if (littleEndian<std::int32_t>(record, 0) == type) {
            auto polygons = readRecord(record);
            if (!polygons) return bad(fmt::format("record {} has counts that do not fit", file.features.size() + 1));
            feature.polygons = std::move(*polygons);
        }
        file.features.push_back(std::move(feature));
        at += 8 + static_cast<std::size_t>(size);
    }
    return file;
}

}  // namespace svt::readers::gis
