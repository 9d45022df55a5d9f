#include <svt/city/city_view.hpp>
#include <svt/city/city_walk.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace svt::city {
namespace {

using drawing::PlanePoint;
using drawing::SectionDrawing;

// Collects the drawings of tiles in the coordinates of the city.
class Collector {
public:
    Collector(const drawing::SectionPlane& plane, volume::SemanticVolume frame) {
        section_.volume = std::move(frame);
        section_.drawing.plane = plane;
        section_.drawing.axes = drawing::makePlaneAxes(plane, section_.volume.grid);
    }

    void add(SectionDrawing drawing, const volume::SemanticVolume& tile) {
        SectionDrawing& to = section_.drawing;
        to.drawingUnit = std::max(to.drawingUnit, drawing.drawingUnit);
        to.tolerance = std::max(to.tolerance, drawing.tolerance);
        by_ = to.axes.planeFromWorld(drawing.axes.origin);
        numberOf_.clear();
        for (drawing::SectionComponent& component : drawing.components) {
            component.label = numberOf(component.label, tile);
            for (drawing::SectionPolygon& polygon : component.polygons) {
                move(polygon.outer);
                for (drawing::Ring& hole : polygon.holes) move(hole);
            }
            to.area += component.area;
            to.components.push_back(std::move(component));
        }
        for (drawing::SectionBorder& border : drawing.borders) {
            border.left = numberOf(border.left, tile);
            border.right = numberOf(border.right, tile);
            move(border.points);
            to.borders.push_back(std::move(border));
        }
        for (drawing::SectionLine& line : drawing.lines) {
            line.label = numberOf(line.label, tile);
            move(line.points);
            to.lines.push_back(std::move(line));
        }
        for (const drawing::ClassArea& own : drawing.classes) {
            drawing::ClassArea& sum = classes_[own.className];
            sum.className = own.className;
            sum.components += own.components;
            sum.area += own.area;
        }
    }

    CitySection finish() {
        SectionDrawing& drawing = section_.drawing;
        const auto byLabel = [](const auto& a, const auto& b) { return a.label < b.label; };
        std::stable_sort(drawing.components.begin(), drawing.components.end(), byLabel);
        std::stable_sort(drawing.lines.begin(), drawing.lines.end(), byLabel);
        for (auto& [name, sum] : classes_) drawing.classes.push_back(std::move(sum));
        return std::move(section_);
    }

private:
    // All coordinates of a drawing are multiples of its unit.
    void move(std::vector<PlanePoint>& points) const {
        const double unit = section_.drawing.drawingUnit;
        const auto rounded = [&](double value) { return unit > 0 ? std::round(value / unit) * unit : value; };
        for (PlanePoint& point : points) point = {rounded(point.u + by_.u), rounded(point.v + by_.v)};
    }

    std::uint32_t numberOf(std::uint32_t label, const volume::SemanticVolume& tile) {
        if (label == volume::kNoLabel) return label;
        std::vector<volume::Label>& labels = section_.volume.labels.labels;
        const auto [known, isNew] = numberOf_.emplace(label, static_cast<std::uint32_t>(labels.size()));
        if (!isNew) return known->second;
        volume::Label& own = labels.emplace_back(tile.labels.labels[label]);
        own.parent = volume::kNoLabel;
        own.groups.clear();
        own.subtreeEnd = static_cast<std::uint32_t>(labels.size());
        own.first = static_cast<volume::Scalar>(labels.size());
        own.count = own.count > 0 ? 1 : 0;
        return known->second;
    }

    CitySection section_;
    PlanePoint by_;
    std::map<std::uint32_t, std::uint32_t> numberOf_;
    std::map<std::string, drawing::ClassArea> classes_;
};

// Distances from a plane of the nearest and the farthest corner of a box. \param world  of a corner
template <class World>
std::pair<double, double> distances(const drawing::SectionPlane& plane, Vec3d low, Vec3d high, const World& world) {
    double nearest = INFINITY, farthest = -INFINITY;
    for (int n = 0; n < 8; ++n) {
        const Vec3d corner{(n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y, (n & 4) != 0 ? high.z : low.z};
        const double distance = dot(world(corner) - plane.point, plane.normal);
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    return {nearest, farthest};
}

// Whether a plane may cut a building of a tile.
bool mayCut(const drawing::SectionPlane& plane, const IndexEntry& entry) {
    const double side = std::ldexp(1.0, entry.tile.level);
    const Vec3d low{entry.tile.x * side - kMostReach, entry.tile.y * side - kMostReach, double(entry.lowest)};
    const Vec3d high{(entry.tile.x + 1) * side + kMostReach, (entry.tile.y + 1) * side + kMostReach,
                     double(entry.highest)};
    const auto [nearest, farthest] = distances(plane, low, high, [](Vec3d corner) { return corner; });
    return nearest <= 0 && farthest >= 0;
}

// Whether a plane cuts the samples of a volume.
bool cuts(const drawing::SectionPlane& plane, const volume::Grid& grid) {
    const Vec3d half{0.5, 0.5, 0.5};
    const auto world = [&](Vec3d index) { return grid.worldFromIndex(index); };
    const auto [nearest, farthest] = distances(plane, -half, toDouble(grid.dimension()) - half, world);
    return nearest < 0 && farthest > 0;
}

}  // namespace

Result<std::vector<IndexEntry>> tilesOfSection(const City& city, const std::string& text) {
    SVT_TRY(frame, frameVolume(city));
    SVT_TRY(plane, drawing::parseSectionPlane(text, *frame));
    SVT_TRY(entries, city.find(0, kEverywhere));
    std::erase_if(*entries, [&](const IndexEntry& entry) { return !mayCut(*plane, entry); });
    return std::move(*entries);
}

Result<CitySection> cutCity(const City& city, const std::string& text, const drawing::SectionOptions& options,
                            const Progress* progress) {
    SVT_TRY(frame, frameVolume(city));
    SVT_TRY(plane, drawing::parseSectionPlane(text, *frame));
    Collector collector(*plane, std::move(*frame));
    const auto cut = [&](const volume::SemanticVolume& tile) -> Result<void> {
        if (!cuts(*plane, tile.grid)) return {};
        SVT_TRY(drawing, drawing::drawSection(tile, *plane, options));
        collector.add(std::move(*drawing), tile);
        return {};
    };
    const auto isWanted = [&](const IndexEntry& entry) { return mayCut(*plane, entry); };
    SVT_DO(forEachTile(city, kEverywhere, options.threads, progress, cut, isWanted));
    return collector.finish();
}

}  // namespace svt::city
