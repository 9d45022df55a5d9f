#include <svt/writers/gltf/label_surface.hpp>

#include <svt/core/parallel.hpp>
#include <svt/volume/label_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

namespace svt::writers {
namespace {

using volume::ColumnVolume;
using volume::kNoLabel;
using volume::Run;

// A rectangle of voxel faces of one label perpendicular to `axis` at `plane` (in voxels), from `from` to `to` along the
// two other axes in the order (axis + 1) % 3, (axis + 2) % 3.
struct Rectangle {
    std::uint32_t label = 0;
    std::uint8_t axis = 0;
    bool isUpper = false;  // faces +axis
    std::int32_t plane = 0;
    std::array<std::int32_t, 2> from{}, to{};
};

// A strip of faces in a line: from `begin` to `end` along the line. Strips with different `key` are never merged.
struct Strip {
    std::uint64_t key = 0;
    std::uint32_t begin = 0, end = 0;
    std::int32_t since = 0;  // line at which the rectangle began
    [[nodiscard]] bool isSame(const Strip& other) const {
        return key == other.key && begin == other.begin && end == other.end;
    }
    friend bool operator<(const Strip& a, const Strip& b) {
        return a.key != b.key ? a.key < b.key : a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
    }
};

// Merges equal strips of consecutive lines; both in order. `emit(strip, line)` receives strips that end before `line`.
template <class Emit>
void nextLine(std::vector<Strip>& open, std::vector<Strip>& strips, std::int32_t line, Emit emit) {
    std::size_t o = 0;
    for (Strip& strip : strips) {
        while (o < open.size() && open[o] < strip) emit(open[o++], line);
        const bool goesOn = o < open.size() && open[o].isSame(strip);
        strip.since = goesOn ? open[o++].since : line;
    }
    while (o < open.size()) emit(open[o++], line);
    open.swap(strips);
}

std::uint64_t keyOf(std::uint32_t label, bool isUpper) { return std::uint64_t(label) << 1 | (isUpper ? 1 : 0); }

class Faces {
public:
    Faces(const ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar)
        : columns_(columns), labelOfScalar_(labelOfScalar) {}

    // Faces perpendicular to x (axis 0) or y (axis 1) at one plane, 0..n: strips along z, merged along the other axis.
    void addPlane(int axis, std::int32_t plane, std::vector<Rectangle>& out) {
        const int other = 1 - axis;
        open_.clear();
        const auto emit = [&](const Strip& strip, std::int32_t line) {
            Rectangle r{static_cast<std::uint32_t>(strip.key >> 1),
                        static_cast<std::uint8_t>(axis),
                        (strip.key & 1) != 0,
                        plane,
                        {},
                        {}};
            // Across x: y, z. Across y: z, x.
            const std::size_t z = axis == 0 ? 1 : 0;
            r.from[z] = static_cast<std::int32_t>(strip.begin);
            r.to[z] = static_cast<std::int32_t>(strip.end);
            r.from[1 - z] = strip.since;
            r.to[1 - z] = line;
            out.push_back(r);
        };
        const Run* lastBefore = nullptr;
        const Run* lastAfter = nullptr;
        for (std::int32_t line = 0; line < columns_.dimension()[other]; ++line) {
            const auto before = columnOrNone(axis, plane - 1, line), after = columnOrNone(axis, plane, line);
            if (line > 0 && before.data() == lastBefore && after.data() == lastAfter) continue;
            lastBefore = before.data();
            lastAfter = after.data();
            strips_.clear();
            if (before.data() != after.data()) addStrips(before, after);
            std::sort(strips_.begin(), strips_.end());
            nextLine(open_, strips_, line, emit);
        }
        strips_.clear();
        nextLine(open_, strips_, columns_.dimension()[other], emit);
    }

    // Faces perpendicular to z of all columns: strips along x, merged along y. Stops early at more than `limit`.
    void addLayers(std::vector<Rectangle>& out, std::size_t limit) {
        open_.clear();
        // The key packs plane, label and side; 16, 32 and 1 bits.
        const auto emit = [&](const Strip& strip, std::int32_t line) {
            out.push_back({static_cast<std::uint32_t>(strip.key >> 1),
                           2,
                           (strip.key & 1) != 0,
                           static_cast<std::int32_t>(strip.key >> 33),
                           {static_cast<std::int32_t>(strip.begin), strip.since},
                           {static_cast<std::int32_t>(strip.end), line}});
        };
        for (std::int32_t j = 0; j < columns_.dimension().y && out.size() <= limit; ++j) {
            if (j > 0 && isRepeated(j)) continue;
            addLayersOfRow(j);
            nextLine(open_, strips_, j, emit);
        }
        strips_.clear();
        nextLine(open_, strips_, columns_.dimension().y, emit);
    }

private:
    [[nodiscard]] std::uint32_t labelOf(volume::Scalar scalar) const {
        return scalar < labelOfScalar_.size() ? labelOfScalar_[scalar] : kNoLabel;
    }

    [[nodiscard]] std::span<const Run> columnOrNone(int axis, std::int32_t at, std::int32_t line) const {
        if (at < 0 || at >= columns_.dimension()[axis]) return {};
        return axis == 0 ? columns_.column(at, line) : columns_.column(line, at);
    }

    // Appends [begin, end) of `key` to the strips, or extends the last strip `last` of this side.
    void extend(std::size_t& last, std::uint64_t key, std::uint32_t begin, std::uint32_t end) {
        if (last != kNone && strips_[last].key == key && strips_[last].end == begin) {
            strips_[last].end = end;
            return;
        }
        last = strips_.size();
        strips_.push_back({key, begin, end, 0});
    }

    // Faces where the labels of two columns differ; an empty column has no labels.
    void addStrips(std::span<const Run> before, std::span<const Run> after) {
        std::size_t lastUpper = kNone, lastLower = kNone;
        const auto nz = static_cast<std::uint32_t>(columns_.dimension().z);
        std::uint32_t begin = 0;
        for (std::size_t i = 0, j = 0; begin < nz;) {
            const std::uint32_t endA = before.empty() ? nz : before[i].end, endB = after.empty() ? nz : after[j].end;
            const std::uint32_t a = before.empty() ? kNoLabel : labelOf(before[i].scalar);
            const std::uint32_t b = after.empty() ? kNoLabel : labelOf(after[j].scalar);
            const std::uint32_t end = std::min(endA, endB);
            if (a != b && a != kNoLabel) extend(lastUpper, keyOf(a, true), begin, end);
            if (a != b && b != kNoLabel) extend(lastLower, keyOf(b, false), begin, end);
            begin = end;
            i += endA == end ? 1 : 0;
            j += endB == end ? 1 : 0;
        }
    }

    [[nodiscard]] bool isRepeated(std::int32_t j) const {
        if (j % ColumnVolume::kTileSize == 0) return false;
        const auto y = static_cast<std::size_t>(j % ColumnVolume::kTileSize);
        for (std::int32_t tileX = 0; tileX < columns_.tilesX(); ++tileX) {
            const auto& tile = columns_.tiles()[std::size_t(tileX) + std::size_t(columns_.tilesX()) *
                                                                         std::size_t(j / ColumnVolume::kTileSize)];
            if (tile.rowOf[y] != tile.rowOf[y - 1]) return false;
        }
        return true;
    }

    // The horizontal faces of a column, by plane, label and side.
    void addEnds(std::span<const Run> runs, std::vector<std::uint64_t>& ends) const {
        std::uint32_t below = kNoLabel, plane = 0;
        const auto add = [&](std::uint32_t above) {
            if (above != below && below != kNoLabel) ends.push_back(std::uint64_t(plane) << 33 | keyOf(below, true));
            if (above != below && above != kNoLabel) ends.push_back(std::uint64_t(plane) << 33 | keyOf(above, false));
            below = above;
        };
        for (const Run& run : runs) {
            add(labelOf(run.scalar));
            plane = run.end;
        }
        add(kNoLabel);
        std::sort(ends.begin(), ends.end());
    }

    // strips_ of row j, in order.
    void addLayersOfRow(std::int32_t j) {
        strips_.clear();
        active_.clear();
        const Run* last = nullptr;
        const auto close = [&](const std::pair<std::uint64_t, std::uint32_t>& line, std::uint32_t i) {
            strips_.push_back({line.first, line.second, i, 0});
        };
        for (std::int32_t i = 0; i < columns_.dimension().x; ++i) {
            const auto runs = columns_.column(i, j);
            if (runs.data() == last) continue;
            last = runs.data();
            ends_.clear();
            addEnds(runs, ends_);
            next_.clear();
            std::size_t a = 0;
            for (const std::uint64_t key : ends_) {
                while (a < active_.size() && active_[a].first < key) close(active_[a++], std::uint32_t(i));
                const bool goesOn = a < active_.size() && active_[a].first == key;
                next_.emplace_back(key, goesOn ? active_[a].second : std::uint32_t(i));
                a += goesOn ? 1 : 0;
            }
            while (a < active_.size()) close(active_[a++], std::uint32_t(i));
            active_.swap(next_);
        }
        for (const auto& line : active_) close(line, std::uint32_t(columns_.dimension().x));
        std::sort(strips_.begin(), strips_.end());
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    const ColumnVolume& columns_;
    std::span<const std::uint32_t> labelOfScalar_;
    std::vector<Strip> open_, strips_;
    std::vector<std::uint64_t> ends_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> active_, next_;  // key, position where it began
};

// Packs a vertex position into one number, ordered by the axes `first`, `second`, `third`. 17 bits each.
struct PackedOrder {
    std::array<int, 3> axes;
    [[nodiscard]] std::uint64_t pack(Vec3i p) const {
        return static_cast<std::uint64_t>(p[axes[0]]) << 34 | static_cast<std::uint64_t>(p[axes[1]]) << 17 |
               static_cast<std::uint64_t>(p[axes[2]]);
    }
    [[nodiscard]] Vec3i unpack(std::uint64_t value) const {
        Vec3i p;
        p[axes[0]] = static_cast<std::int32_t>(value >> 34);
        p[axes[1]] = static_cast<std::int32_t>(value >> 17 & 0x1FFFF);
        p[axes[2]] = static_cast<std::int32_t>(value & 0x1FFFF);
        return p;
    }
};

// Entry a: vertices on one line along axis a are consecutive.
constexpr std::array<PackedOrder, 3> kOrders{{{{1, 2, 0}}, {{0, 2, 1}}, {{0, 1, 2}}}};

// Corners of a rectangle, counter-clockwise from outside.
std::array<Vec3i, 4> cornersOf(const Rectangle& r) {
    const int u = (r.axis + 1) % 3, v = (r.axis + 2) % 3;
    std::array<Vec3i, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) {
        corners[c][r.axis] = r.plane;
        corners[c][u] = c == 1 || c == 2 ? r.to[0] : r.from[0];
        corners[c][v] = c >= 2 ? r.to[1] : r.from[1];
    }
    if (!r.isUpper) std::swap(corners[1], corners[3]);
    return corners;
}

// Triangles of the rectangles of one label.
class Triangulation {
public:
    explicit Triangulation(std::span<const Rectangle> rectangles) : rectangles_(rectangles) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto& sorted = corners_[axis];
            sorted.reserve(4 * rectangles.size());
            for (const Rectangle& r : rectangles)
                for (const Vec3i corner : cornersOf(r)) sorted.push_back(kOrders[axis].pack(corner));
            std::sort(sorted.begin(), sorted.end());
            sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        }
    }

    LabelSurface run() {
        LabelSurface surface;
        surface.label = rectangles_.front().label;
        for (const std::uint64_t packed : corners_[2]) surface.vertices.push_back(kOrders[2].unpack(packed) * 2);
        surface.cornerCount = static_cast<std::uint32_t>(surface.vertices.size());
        for (const Rectangle& r : rectangles_) {
            border_.clear();
            const auto corners = cornersOf(r);
            for (std::size_t c = 0; c < 4; ++c) addSide(corners[c], corners[(c + 1) % 4]);
            if (border_.size() == 4) {
                surface.triangles.push_back({border_[0], border_[1], border_[2]});
                surface.triangles.push_back({border_[0], border_[2], border_[3]});
                continue;
            }
            const auto middle = static_cast<std::uint32_t>(surface.vertices.size());
            surface.vertices.push_back(corners[0] + corners[2]);
            surface.middles.push_back(
                {vertexAt(corners[0]), vertexAt(corners[1]), vertexAt(corners[2]), vertexAt(corners[3])});
            for (std::size_t b = 0; b < border_.size(); ++b)
                surface.triangles.push_back({middle, border_[b], border_[(b + 1) % border_.size()]});
        }
        return surface;
    }

private:
    [[nodiscard]] std::uint32_t vertexAt(Vec3i corner) const {
        const auto found = std::lower_bound(corners_[2].begin(), corners_[2].end(), kOrders[2].pack(corner));
        return static_cast<std::uint32_t>(found - corners_[2].begin());
    }

    // Adds the vertices from `from` up to but excluding `to`, including all that lie between.
    void addSide(Vec3i from, Vec3i to) {
        const std::size_t axis = from.x != to.x ? 0 : from.y != to.y ? 1 : 2;
        const auto& sorted = corners_[axis];
        const std::uint64_t a = kOrders[axis].pack(from), b = kOrders[axis].pack(to);
        const auto begin = std::lower_bound(sorted.begin(), sorted.end(), std::min(a, b));
        const auto end = std::lower_bound(begin, sorted.end(), std::max(a, b));
        if (a < b)
            for (auto at = begin; at != end; ++at) border_.push_back(vertexAt(kOrders[axis].unpack(*at)));
        else
            for (auto at = end; at != begin; --at) border_.push_back(vertexAt(kOrders[axis].unpack(*at)));
    }

    std::span<const Rectangle> rectangles_;
    std::array<std::vector<std::uint64_t>, 3> corners_;  // by kOrders
    std::vector<std::uint32_t> border_;
};

Error tooMany(std::uint64_t limit) {
    return Error(Code::GridTooLarge,
                 fmt::format("the surface has more than {} triangles; use a coarser volume or fewer features", limit));
}

// All rectangles, ordered by label and then by discovery.
Result<std::vector<Rectangle>> findRectangles(const ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar,
                                              const SurfaceOptions& options) {
    const Vec3i n = columns.dimension();
    const auto planesX = static_cast<std::size_t>(n.x) + 1, planesY = static_cast<std::size_t>(n.y) + 1;
    // Several planes per task; the first task is the layers, which take longest.
    constexpr std::size_t kPlanes = 16;
    const std::size_t piecesX = (planesX + kPlanes - 1) / kPlanes, piecesY = (planesY + kPlanes - 1) / kPlanes;
    std::vector<std::vector<Rectangle>> pieces(1 + piecesX + piecesY);
    std::atomic<std::uint64_t> count{0};
    // The layers are many planes in one.
    ProgressCounter progress(options.progress, "surface", 2 * (planesX + planesY));
    const auto isStopped = [&] {
        return Progress::isCancelled(options.progress) || 2 * count.load() > options.maxTriangles;
    };
    parallelFor(pieces.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        Faces faces(columns, labelOfScalar);
        for (std::size_t p = begin; p < end && !isStopped(); ++p) {
            if (p == 0) faces.addLayers(pieces[p], options.maxTriangles / 2);
            const int axis = p <= piecesX ? 0 : 1;
            const std::size_t first = (p == 0 ? 0 : p - 1 - (axis == 0 ? 0 : piecesX)) * kPlanes;
            const std::size_t last = p == 0 ? 0 : std::min(first + kPlanes, axis == 0 ? planesX : planesY);
            for (std::size_t plane = first; plane < last && !isStopped(); ++plane) {
                const std::size_t before = pieces[p].size();
                faces.addPlane(axis, static_cast<std::int32_t>(plane), pieces[p]);
                count += pieces[p].size() - before;
                progress.add();
            }
            if (p == 0) count += pieces[p].size();
            if (p == 0) progress.add(planesX + planesY);
        }
    });
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "the surface was stopped");
    if (2 * count.load() > options.maxTriangles) return tooMany(options.maxTriangles);
    std::vector<Rectangle> all;
    all.reserve(count.load());
    for (auto& piece : pieces) {
        all.insert(all.end(), piece.begin(), piece.end());
        piece = {};
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.label < b.label; });
    return all;
}

}  // namespace

Result<std::vector<LabelSurface>> labelSurfaces(const ColumnVolume& columns,
                                                std::span<const std::uint32_t> labelOfScalar,
                                                const SurfaceOptions& options) {
    SVT_TRY(rectangles, findRectangles(columns, labelOfScalar, options));
    std::vector<std::span<const Rectangle>> ofLabel;
    for (std::size_t begin = 0; begin < rectangles->size();) {
        std::size_t end = begin;
        while (end < rectangles->size() && (*rectangles)[end].label == (*rectangles)[begin].label) ++end;
        ofLabel.push_back(std::span(*rectangles).subspan(begin, end - begin));
        begin = end;
    }
    std::vector<LabelSurface> surfaces(ofLabel.size());
    std::atomic<std::uint64_t> triangles{0};
    ProgressCounter progress(options.progress, "triangles", rectangles->size());
    parallelFor(surfaces.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            if (Progress::isCancelled(options.progress) || triangles.load() > options.maxTriangles) return;
            surfaces[s] = Triangulation(ofLabel[s]).run();
            triangles += surfaces[s].triangles.size();
            progress.add(ofLabel[s].size());
        }
    });
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "the surface was stopped");
    if (triangles.load() > options.maxTriangles) return tooMany(options.maxTriangles);
    return surfaces;
}

}  // namespace svt::writers
