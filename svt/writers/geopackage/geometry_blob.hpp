#pragma once
/// \file
/// Geometries as well-known binary (OGC 06-103r4), little-endian, with or without the header of a GeoPackage.

#include <svt/core/bytes.hpp>
#include <svt/writers/table.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace svt::writers {

using MapPoint = std::array<double, 2>;  ///< east and north, or right and up

struct MapBounds {
    double minX = 1e300, minY = 1e300, maxX = -1e300, maxY = -1e300;

    void add(std::span<const MapPoint> points) noexcept {
        for (const auto& [x, y] : points) {
            minX = std::min(minX, x);
            minY = std::min(minY, y);
            maxX = std::max(maxX, x);
            maxY = std::max(maxY, y);
        }
    }
    void add(const MapBounds& other) noexcept {
        if (other.isEmpty()) return;
        const MapPoint corners[] = {{other.minX, other.minY}, {other.maxX, other.maxY}};
        add(corners);
    }
    [[nodiscard]] bool isEmpty() const noexcept { return !(minX <= maxX); }
};

enum class WkbType : std::uint32_t { LineString = 2, Polygon = 3, MultiLineString = 5, MultiPolygon = 6 };

class GeometryBlob {
public:
    /// Well-known binary only.
    GeometryBlob() = default;
    /// Begins with the header of a GeoPackage: reference system and extent.
    GeometryBlob(std::int64_t reference, const MapBounds& bounds) : bytes_{'G', 'P', '\0', '\3'} {
        appendBytes(bytes_, static_cast<std::int32_t>(reference));
        for (const double value : {bounds.minX, bounds.maxX, bounds.minY, bounds.maxY}) appendBytes(bytes_, value);
    }

    /// Begins a geometry of `count` parts: rings of a polygon, members of a collection.
    void begin(WkbType type, std::size_t count) {
        beginLine(type);
        appendBytes(bytes_, static_cast<std::uint32_t>(count));
    }
    void addLine(std::span<const MapPoint> points) {
        beginLine(WkbType::LineString);
        addPoints(points, 0);
    }
    /// \param ring  without repeating the first point
    void addRing(std::span<const MapPoint> ring) { addPoints(ring, 1); }
    void addPolygon(std::span<const MapPoint> ring) {
        begin(WkbType::Polygon, 1);
        addRing(ring);
    }

    [[nodiscard]] Blob take() { return {std::move(bytes_)}; }

private:
    void beginLine(WkbType type) {
        bytes_ += '\1';  // little-endian
        appendBytes(bytes_, static_cast<std::uint32_t>(type));
    }
    void addPoints(std::span<const MapPoint> points, std::size_t repeated) {
        const std::size_t count = points.size() + repeated;
        appendBytes(bytes_, static_cast<std::uint32_t>(count));
        for (std::size_t n = 0; n < count; ++n)
            for (const double value : points[n % points.size()]) appendBytes(bytes_, value);
    }

    std::string bytes_;
};

}  // namespace svt::writers
