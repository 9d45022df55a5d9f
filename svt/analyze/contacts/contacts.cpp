#include <svt/analyze/contacts.hpp>

#include <svt/core/hash_index.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace svt::analyze {
namespace {

constexpr std::int32_t kCell = 8, kRegion = 64, kBlocks = kRegion / kCell, kFootprint = kCell + 1;

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) noexcept {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
    return hash ^ (hash >> 29);
}

std::uint64_t pairOf(std::uint32_t a, std::uint32_t b) noexcept {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

// Sums of contacts by pair, in order of first occurrence.
class ContactSum {
public:
    Contact& of(std::uint64_t pair) {
        const auto a = static_cast<std::uint32_t>(pair >> 32), b = static_cast<std::uint32_t>(pair & 0xFFFFFFFFu);
        const std::uint32_t number = index_.findOrAdd(
            mix(0, pair), [&](std::uint32_t n) { return list_[n].a == a && list_[n].b == b; },
            [&] {
                list_.push_back({a, b, 0, {}});
                return static_cast<std::uint32_t>(list_.size() - 1);
            });
        return list_[number];
    }
    [[nodiscard]] std::vector<Contact> take() { return std::move(list_); }

private:
    HashIndex index_;
    std::vector<Contact> list_;
};

// The faces of one pair of labels in a cell that have the same direction.
struct DirectedFaces {
    std::uint32_t count = 0;
    std::array<std::uint8_t, 3> low{255, 255, 255}, high{};  // bounds of the voxels above the faces, in the cell
};

struct CellPair {
    std::uint64_t pair = 0;
    std::int32_t cell = 0;
    std::array<DirectedFaces, 6> faces{};  // index 2 axis + (1 if the label with the lower number is below the face)
};

// The surface between two labels in a cell, from its faces: their area across each axis, and their arrangement.
class CellShape {
public:
    CellShape(const CellPair& pair, const std::array<double, 3>& faceArea) noexcept {
        for (std::size_t s = 0; s < 6; ++s) {
            const DirectedFaces& faces = pair.faces[s];
            const std::size_t axis = s / 2;
            if (faces.count == 0) continue;
            count_[axis] += faces.count;
            area_[axis] += faces.count * faceArea[axis];
            isFlat_[axis] = isFlat_[axis] && faces.low[axis] == faces.high[axis];
            for (std::size_t along = 0; along < 3; ++along) {
                reach_[axis][along] = std::max(reach_[axis][along], faces.high[along] - faces.low[along] + 1);
                if (faces.low[along] == 0 || faces.high[along] == kCell - 1) reachesCellSide_[axis][along] = true;
            }
        }
    }

    [[nodiscard]] double area() const noexcept {
        std::array<std::size_t, 3> axes{};
        std::size_t count = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (count_[axis] != 0) axes[count++] = axis;
        if (isBox(std::span(axes).first(count))) return area_[0] + area_[1] + area_[2];
        double apart = 0, squares = 0;
        for (const std::size_t axis : std::span(axes).first(count))
            if (isApart(axis))
                apart += area_[axis];
            else
                squares += area_[axis] * area_[axis];
        return apart + std::sqrt(squares);
    }

private:
    // Whether the faces across each axis are in one plane, and no step is that of a digital plane, one side of which is
    // a single voxel.
    [[nodiscard]] bool isBox(std::span<const std::size_t> axes) const noexcept {
        for (const std::size_t a : axes) {
            if (!isFlat_[a]) return false;
            for (const std::size_t b : axes)
                if (a != b &&
                    !((reach_[a][b] >= 2 || reachesCellSide_[a][b]) && (reach_[a][b] >= 2 || reach_[b][a] >= 2)))
                    return false;
        }
        return true;
    }
    // Whether the faces across an axis are an axis-aligned plane that meets an oblique one. Steps of a digital plane
    // are either narrow or low.
    [[nodiscard]] bool isApart(std::size_t axis) const noexcept {
        if (!isFlat_[axis] || count_[axis] <= 2 * kCell) return false;
        for (std::size_t other = 0; other < 3; ++other)
            if (other != axis && count_[other] != 0 && reach_[other][axis] < 3) return false;
        return true;
    }

    std::array<std::uint32_t, 3> count_{};
    std::array<double, 3> area_{};
    std::array<bool, 3> isFlat_{true, true, true};
    std::array<std::array<int, 3>, 3> reach_{};  // extent of faces across the first axis along the second, voxels
    std::array<std::array<bool, 3>, 3> reachesCellSide_{};  // whether they reach a side of the cell there
};

// Measures footprints: 8 x 8 columns, with those to their west and south.
class FootprintMeter {
public:
    FootprintMeter(const volume::Grid& grid, std::span<const std::uint32_t> labelOf) : labelOf_(labelOf) {
        const Vec3d s = grid.spacing();
        faceArea_ = {s.y * s.z, s.x * s.z, s.x * s.y};
    }

    using Columns = std::array<std::span<const volume::Run>, kFootprint * kFootprint>;

    void measure(const Columns& columns, std::uint64_t times, ContactSum& contacts) {
        index_.clear();
        pairs_.clear();
        for (std::int32_t y = 1; y < kFootprint; ++y)
            for (std::int32_t x = 1; x < kFootprint; ++x) {
                const auto& own = columns[std::size_t(x + kFootprint * y)];
                const std::array<std::int32_t, 2> at{x - 1, y - 1};
                addLevels(own, at);
                addBetween(columns[std::size_t(x - 1 + kFootprint * y)], own, 0, at);
                addBetween(columns[std::size_t(x + kFootprint * (y - 1))], own, 1, at);
            }
        for (const CellPair& pair : pairs_) {
            Contact& contact = contacts.of(pair.pair);
            for (std::size_t axis = 0; axis < 3; ++axis)
                contact.faces[axis] += times * (pair.faces[2 * axis].count + pair.faces[2 * axis + 1].count);
            contact.area += double(times) * CellShape(pair, faceArea_).area();
        }
    }

private:
    // Adds the faces between the runs of a column, including those at its ends.
    void addLevels(std::span<const volume::Run> runs, std::array<std::int32_t, 2> at) {
        std::uint32_t below = volume::kNoLabel, end = 0;
        for (const volume::Run& run : runs) {
            const std::uint32_t above = labelOf_[run.scalar];
            if (above != below) add(below, above, 2, at, end, end + 1);
            below = above;
            end = run.end;
        }
        if (below != volume::kNoLabel) add(below, volume::kNoLabel, 2, at, end, end + 1);
    }

    void addBetween(std::span<const volume::Run> low, std::span<const volume::Run> high, int axis,
                    std::array<std::int32_t, 2> at) {
        if (low.data() == high.data()) return;
        std::uint32_t begin = 0;
        for (std::size_t l = 0, h = 0; l < low.size() && h < high.size();) {
            const std::uint32_t end = std::min(low[l].end, high[h].end);
            const std::uint32_t a = labelOf_[low[l].scalar], b = labelOf_[high[h].scalar];
            if (a != b) add(a, b, axis, at, begin, end);
            begin = end;
            if (low[l].end == end) ++l;
            if (high[h].end == end) ++h;
        }
    }

    // Adds the lower faces (along `axis`) of voxels [begin, end) of column `at`.
    void add(std::uint32_t low, std::uint32_t high, int axis, std::array<std::int32_t, 2> at, std::uint32_t begin,
             std::uint32_t end) {
        const std::size_t s = std::size_t(2 * axis) + (low < high ? 1 : 0);
        while (begin < end) {
            const std::uint32_t cell = begin / kCell, stop = std::min(end, (cell + 1) * kCell);
            DirectedFaces& faces = pairIn(static_cast<std::int32_t>(cell), pairOf(low, high)).faces[s];
            faces.count += stop - begin;
            const auto x = static_cast<std::uint8_t>(at[0]), y = static_cast<std::uint8_t>(at[1]);
            const auto z0 = static_cast<std::uint8_t>(begin % kCell),
                       z1 = static_cast<std::uint8_t>((stop - 1) % kCell);
            faces.low = {std::min(faces.low[0], x), std::min(faces.low[1], y), std::min(faces.low[2], z0)};
            faces.high = {std::max(faces.high[0], x), std::max(faces.high[1], y), std::max(faces.high[2], z1)};
            begin = stop;
        }
    }

    CellPair& pairIn(std::int32_t cell, std::uint64_t pair) {
        const std::uint32_t number = index_.findOrAdd(
            mix(mix(std::uint64_t(cell), pair), 1),
            [&](std::uint32_t n) { return pairs_[n].pair == pair && pairs_[n].cell == cell; },
            [&] {
                pairs_.push_back({pair, cell, {}});
                return static_cast<std::uint32_t>(pairs_.size() - 1);
            });
        return pairs_[number];
    }

    std::span<const std::uint32_t> labelOf_;
    std::array<double, 3> faceArea_{};
    HashIndex index_{1024};
    std::vector<CellPair> pairs_;
};

// Contacts of one region of 64 x 64 columns. Regions extend one column beyond the volume, where there is background.
std::vector<Contact> contactsOfRegion(const volume::ColumnVolume& columns, Vec3i corner, FootprintMeter& meter) {
    const Vec3i dimension = columns.dimension();
    const std::array<volume::Run, 1> nothing{volume::Run{static_cast<std::uint32_t>(dimension.z), 0}};
    const auto columnAt = [&](std::int32_t i, std::int32_t j) -> std::span<const volume::Run> {
        if (i < 0 || j < 0 || i >= dimension.x || j >= dimension.y) return nothing;
        return columns.column(i, j);
    };
    // Equal footprints are measured once. Columns are shared in a tile, so equal addresses mean equal columns.
    std::vector<FootprintMeter::Columns> footprints;
    std::vector<std::uint64_t> times;
    HashIndex index;
    for (std::int32_t y = 0; y < kBlocks; ++y)
        for (std::int32_t x = 0; x < kBlocks; ++x) {
            FootprintMeter::Columns footprint;
            std::uint64_t hash = 0;
            for (std::size_t n = 0; n < footprint.size(); ++n) {
                footprint[n] = columnAt(corner.x + kCell * x - 1 + std::int32_t(n % kFootprint),
                                        corner.y + kCell * y - 1 + std::int32_t(n / kFootprint));
                hash = mix(hash, reinterpret_cast<std::uintptr_t>(footprint[n].data()));
            }
            const std::uint32_t number = index.findOrAdd(
                hash,
                [&](std::uint32_t known) {
                    return std::equal(footprint.begin(), footprint.end(), footprints[known].begin(),
                                      [](const auto& a, const auto& b) { return a.data() == b.data(); });
                },
                [&] {
                    footprints.push_back(footprint);
                    times.push_back(0);
                    return static_cast<std::uint32_t>(footprints.size() - 1);
                });
            ++times[number];
        }
    ContactSum contacts;
    for (std::size_t n = 0; n < footprints.size(); ++n) meter.measure(footprints[n], times[n], contacts);
    return contacts.take();
}

}  // namespace

std::vector<Contact> findContacts(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                  const volume::LabelTable& labels, int threads) {
    const std::vector<std::uint32_t> labelOf = labels.labelOfScalar();
    const auto across = static_cast<std::size_t>(columns.dimension().x / kRegion + 1);
    const auto down = static_cast<std::size_t>(columns.dimension().y / kRegion + 1);
    std::vector<std::vector<Contact>> regions(across * down);
    parallelFor(regions.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        FootprintMeter meter(grid, labelOf);
        for (std::size_t r = begin; r < end; ++r) {
            const Vec3i corner{std::int32_t(r % across) * kRegion, std::int32_t(r / across) * kRegion, 0};
            regions[r] = contactsOfRegion(columns, corner, meter);
        }
    });
    ContactSum all;
    for (std::vector<Contact>& region : regions) {
        for (const Contact& part : region) {
            Contact& contact = all.of(pairOf(part.a, part.b));
            contact.area += part.area;
            for (std::size_t axis = 0; axis < 3; ++axis) contact.faces[axis] += part.faces[axis];
        }
        region = {};
    }
    std::vector<Contact> contacts = all.take();
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& a, const Contact& b) { return std::tie(a.a, a.b) < std::tie(b.a, b.b); });
    return contacts;
}

std::vector<Neighbor> findNeighbors(std::uint32_t label, const std::vector<Contact>& contacts) {
    std::vector<Neighbor> neighbors;
    for (const std::size_t c : contactsWith(label, contacts))
        neighbors.push_back({contacts[c].a == label ? contacts[c].b : contacts[c].a, contacts[c].area});
    std::sort(neighbors.begin(), neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
        return a.area != b.area ? a.area > b.area : a.label < b.label;
    });
    return neighbors;
}

std::vector<std::size_t> contactsWith(std::uint32_t label, const std::vector<Contact>& contacts) {
    std::vector<std::size_t> with;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (contacts[c].a == label || contacts[c].b == label) with.push_back(c);
    return with;
}

}  // namespace svt::analyze
