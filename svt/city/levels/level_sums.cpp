#include <svt/city/levels/level_sums.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::city {
namespace {

using volume::Run;
using volume::Scalar;

std::int64_t floorDiv(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

// Number of samples of detail 1 in one sample of `detail` along z, as a power of two.
int heightShift(int detail, double spacing) {
    int shift = 0;
    while (shift < detail - 2 && 2 * spacing * std::ldexp(1.0, shift + 1) <= 4) ++shift;
    return shift;
}

// Classes of a column and their eighths, the largest first.
using Coverage = std::vector<std::pair<std::uint32_t, int>>;

// The classes of a tile's column before scalars are assigned.
struct Look {
    Coverage roof, side;  // of the highest sample, and of those below it
    std::int64_t low = 0, top = 0;
    double volume = 0;
};

class LevelVolume {
public:
    LevelVolume(const LevelSums& sums, double spacing, const LevelClasses& classes)
        : sums_(sums), spacing_(spacing), classes_(classes), shift_(heightShift(sums.detail, spacing)) {}

    Result<volume::SemanticVolume> run(const std::string& crsName) {
        look();
        volume::SemanticVolume result;
        if (scalarOf_.empty()) return result;
        number(result.labels);
        const Vec3i dimension{std::max(2, high_[0] - low_[0]), std::max(2, high_[1] - low_[1]),
                              static_cast<std::int32_t>(std::max<std::int64_t>(2, top_ - bottom_))};
        const Vec3d step = spacingOf(sums_.detail, spacing_);
        const auto at = [](std::int64_t number, double size) { return (double(number) + 0.5) * size; };
        const auto grid = volume::Grid::fromParts(
            dimension, step,
            {at(sums_.first[0] + low_[0], step.x), at(sums_.first[1] + low_[1], step.y), at(bottom_, step.z)},
            {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        if (!grid) return grid.error();
        result.grid = *grid;
        result.crsName = crsName;
        result.columns = columns(dimension);
        const auto counts = result.columns.countVoxels(result.labels.scalarCount());
        for (volume::Label& label : result.labels.labels)
            if (label.count > 0) label.voxels = counts[label.first];
        return result;
    }

private:
    void look() {
        looks_.resize(sums_.low.size());
        low_ = sums_.size;
        for (std::int32_t j = 0; j < sums_.size[1]; ++j)
            for (std::int32_t i = 0; i < sums_.size[0]; ++i) {
                Look& look = looks_[indexOf(i, j)];
                lookAt(indexOf(i, j), look);
                if (look.roof.empty()) continue;
                const bool isFirst = scalarOf_.empty();
                scalarOf_[look.roof] = 0;
                if (look.top - look.low > 1) scalarOf_[look.side] = 0;
                bottom_ = isFirst ? look.low : std::min(bottom_, look.low);
                top_ = isFirst ? look.top : std::max(top_, look.top);
                low_ = {std::min(low_[0], i), std::min(low_[1], j)};
                high_ = {std::max(high_[0], i + 1), std::max(high_[1], j + 1)};
            }
    }

    [[nodiscard]] std::size_t indexOf(std::int32_t i, std::int32_t j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(sums_.size[0]) + static_cast<std::size_t>(i);
    }

    using Areas = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

    // Areas of the classes of a column, the largest first, equal ones by name.
    [[nodiscard]] Areas areasAt(const LevelSums::ByClass& from, std::size_t n) const {
        Areas areas;
        for (const auto& [number, all] : from)
            if (all[n] != 0) areas.emplace_back(all[n], number);
        std::sort(areas.begin(), areas.end(), [&](const auto& a, const auto& b) {
            if (a.first != b.first) return a.first > b.first;
            return classes_.names[a.second] < classes_.names[b.second];
        });
        return areas;
    }

    void lookAt(std::size_t n, Look& look) const {
        const Areas areas = areasAt(sums_.areaOf, n);
        if (areas.empty()) return;
        std::int64_t area = 0;
        for (const auto& entry : areas) area += static_cast<std::int64_t>(entry.first);
        // The middle between samples is rounded up.
        const std::int64_t step = std::int64_t{1} << shift_;
        const auto mean = [&](std::int64_t sum) { return floorDiv(2 * sum + area * step, 2 * area * step); };
        look.low = mean(sums_.low[n]);
        look.top = std::max(look.low + 1, mean(sums_.top[n]));
        const double sample = 2 * spacing_;
        look.volume = double(sums_.top[n] - sums_.low[n]) * sample * sample * sample;
        look.roof = coverage(areas, std::ldexp(1.0, 2 * (sums_.detail - 1)));
        const Areas sides = areasAt(sums_.sideOf, n);
        double faces = 0;
        for (const auto& entry : sides) faces += static_cast<double>(entry.first);
        look.side = sides.empty() ? look.roof : coverage(sides, faces);
    }

    // \param whole  area that corresponds to all eighths
    [[nodiscard]] Coverage coverage(const Areas& areas, double whole) const {
        constexpr std::size_t kMost = 4;
        if (sums_.detail == kFirstClassDetail) return {{areas[0].second, kCoverageSteps}};
        Coverage result;
        int sum = 0;
        for (std::size_t n = 0; n < std::min(kMost, areas.size()); ++n) {
            const double share = std::min(1.0, double(areas[n].first) / whole);
            result.emplace_back(areas[n].second,
                                std::max(1, static_cast<int>(std::floor(kCoverageSteps * share + 0.5))));
            sum += result.back().second;
        }
        // Each class keeps at least an eighth, and the sum is at most a column: the first of the largest is reduced.
        for (; sum > kCoverageSteps; --sum)
            --std::max_element(result.begin(), result.end(), [](const auto& a, const auto& b) {
                  return a.second < b.second;
              })->second;
        return result;
    }

    [[nodiscard]] std::string idOf(const Coverage& coverage) const {
        if (sums_.detail == kFirstClassDetail) return classes_.names[coverage[0].first];
        std::string id;
        for (const auto& [number, eighths] : coverage)
            id += fmt::format("{}{} {}/{}", id.empty() ? "" : ", ", classes_.names[number], eighths, kCoverageSteps);
        return id;
    }

    // A label for each class of buildings. Below it, by id, a label for each mixture whose first class is one of such
    // buildings or of their parts. At detail 2, a column with the class itself uses the label of the class.
    void number(volume::LabelTable& table) {
        std::map<std::pair<std::string, std::string>, const Coverage*> sorted;
        for (const auto& [coverage, scalar] : scalarOf_) {
            const std::string& root = classes_.roots[coverage[0].first];
            sorted[{root, {}}];
            const std::string id = idOf(coverage);
            sorted[{root, id == root ? std::string() : id}] = &coverage;
        }
        std::map<Coverage, double> volumes;
        for (const Look& look : looks_)
            if (!look.roof.empty()) volumes[look.roof] += look.volume;
        std::uint32_t root = 0;
        Scalar next = 1;
        for (const auto& [key, coverage] : sorted) {
            const auto own = static_cast<std::uint32_t>(table.labels.size());
            volume::Label& label = table.labels.emplace_back();
            const bool isRoot = key.second.empty();
            if (isRoot) root = own;
            label.id = isRoot ? key.first : key.second;
            label.className = isRoot ? key.first : partOf(classes_.names[(*coverage)[0].first]);
            label.parent = isRoot ? volume::kNoLabel : root;
            label.subtreeEnd = table.labels[root].subtreeEnd = own + 1;
            if (coverage == nullptr) continue;
            label.name = sums_.detail == kFirstClassDetail ? std::string() : label.id;
            label.filling = volume::Filling::Solid;
            label.first = next++;
            label.count = 1;
            label.volume = volumes[*coverage];
            label.color = colorOf(*coverage);
            if (sums_.detail != kFirstClassDetail)
                for (const auto& [number, eighths] : *coverage)
                    label.attributes.push_back({classes_.names[number], std::int64_t{eighths}, {}});
            scalarOf_[*coverage] = label.first;
        }
    }

    // "RoofSurface" of "Building/RoofSurface".
    static std::string partOf(const std::string& name) { return name.substr(name.find('/') + 1); }

    [[nodiscard]] Vec3f colorOf(const Coverage& coverage) const {
        Vec3d sum;
        double all = 0;
        for (const auto& [number, eighths] : coverage) {
            const Vec3f own = classes_.colors[number];
            sum = sum + Vec3d{own.x, own.y, own.z} * double(eighths);
            all += eighths;
        }
        const auto part = [&](double value) { return static_cast<float>(std::floor(value / all * 255 + 0.5) / 255); };
        return {part(sum.x), part(sum.y), part(sum.z)};
    }

    [[nodiscard]] volume::ColumnVolume columns(Vec3i dimension) const {
        constexpr std::int32_t kSize = volume::ColumnVolume::kTileSize;
        std::vector<volume::ColumnTileData> tiles;
        for (std::int32_t j = 0; j < dimension.y; j += kSize)
            for (std::int32_t i = 0; i < dimension.x; i += kSize) {
                const std::int32_t width = std::min(kSize, dimension.x - i);
                volume::ColumnTileBuilder builder(width);
                std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
                for (std::int32_t y = j; y < std::min(j + kSize, dimension.y); ++y) {
                    for (std::int32_t x = 0; x < width; ++x)
                        row[std::size_t(x)] = builder.addColumn(column(low_[0] + i + x, low_[1] + y, dimension.z));
                    builder.addRow(row);
                }
                tiles.push_back(builder.finish());
            }
        return volume::ColumnVolume::fromTiles(dimension, std::move(tiles));
    }

    [[nodiscard]] std::vector<Run> column(std::int32_t i, std::int32_t j, std::int32_t height) const {
        const auto end = static_cast<std::uint32_t>(height);
        if (i >= sums_.size[0] || j >= sums_.size[1]) return {{end, 0}};
        const Look& look = looks_[indexOf(i, j)];
        if (look.roof.empty()) return {{end, 0}};
        const auto low = static_cast<std::uint32_t>(look.low - bottom_),
                   top = static_cast<std::uint32_t>(look.top - bottom_);
        const Scalar roof = scalarOf_.at(look.roof);
        std::vector<Run> runs;
        if (low > 0) runs.push_back({low, 0});
        if (top - low > 1 && scalarOf_.at(look.side) != roof) runs.push_back({top - 1, scalarOf_.at(look.side)});
        runs.push_back({top, roof});
        if (top < end) runs.push_back({end, 0});
        return runs;
    }

    const LevelSums& sums_;
    double spacing_;
    const LevelClasses& classes_;
    int shift_;
    std::vector<Look> looks_;
    std::map<Coverage, Scalar> scalarOf_;
    std::array<std::int32_t, 2> low_{}, high_{};
    std::int64_t bottom_ = 0, top_ = 0;
};

}  // namespace

double tileSide(const TileKey& tile, int detail, double spacing) noexcept {
    const double side = std::ldexp(1.0, tile.level);
    return detail < kFirstClassDetail ? side : side * spacing * kLevelCells * (1 << kFirstClassDetail);
}

TileKey tileAbove(const TileKey& tile, int detail, double spacing) noexcept {
    if (detail == 0) return tile;
    if (detail >= kFirstClassDetail) return {tile.level + 1, tile.x >> 1, tile.y >> 1};
    const double own = tileSide(tile, detail, spacing), above = tileSide({0, 0, 0}, kFirstClassDetail, spacing);
    const auto cell = [&](std::int32_t at) { return static_cast<std::int32_t>(std::floor((at + 0.5) * own / above)); };
    return {0, cell(tile.x), cell(tile.y)};
}

Vec3d spacingOf(int detail, double spacing) noexcept {
    const double side = std::ldexp(spacing, detail);
    if (detail < kFirstClassDetail) return {side, side, side};
    return {side, side, std::ldexp(2 * spacing, heightShift(detail, spacing))};
}

std::vector<std::pair<std::string, int>> coverageOf(const volume::Label& label) {
    std::vector<std::pair<std::string, int>> result;
    for (const Attribute& attribute : label.attributes)
        if (const auto* eighths = std::get_if<std::int64_t>(&attribute.value);
            eighths != nullptr && *eighths > 0 && *eighths <= kCoverageSteps)
            result.emplace_back(attribute.name, static_cast<int>(*eighths));
    return result;
}

std::uint32_t LevelClasses::add(const volume::Label& root, const volume::Label& label) {
    const bool isRoot = &root == &label;
    // An empty class gets a name as well, so that each label has an id.
    const std::string& own = root.className.empty() ? std::string("Feature") : root.className;
    const std::string name = isRoot ? own : own + "/" + label.className;
    const auto [at, isNew] = numberOf.emplace(name, static_cast<std::uint32_t>(names.size()));
    if (isNew) {
        names.push_back(name);
        roots.push_back(own);
        colors.push_back(label.color);
        buildings.push_back(0);
    }
    buildings[at->second] += isRoot;
    return at->second;
}

LevelSource LevelSource::from(const volume::SemanticVolume& volume, LevelClasses& classes) {
    LevelSource source;
    source.columns = &volume.columns;
    const Vec3d origin = volume.grid.origin(), spacing = volume.grid.spacing();
    source.first = {std::llround(origin.x / spacing.x - 0.5), std::llround(origin.y / spacing.y - 0.5)};
    source.lowest = std::llround(origin.z / spacing.z - 0.5);
    source.classOf.assign(volume.labels.scalarCount(), 0);
    for (const volume::Label& label : volume.labels.labels) {
        const bool isRoot = label.parent == volume::kNoLabel;
        const std::uint32_t number = classes.add(isRoot ? label : volume.labels.labels[label.parent], label);
        for (Scalar s = 0; s < label.count; ++s) source.classOf[label.first + s] = number;
    }
    return source;
}

LevelSums::LevelSums(int ofDetail, std::array<std::int64_t, 2> firstColumn, std::array<std::int32_t, 2> columns)
    : detail(ofDetail), first(firstColumn), size(columns) {
    const std::size_t count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    low.resize(count);
    top.resize(count);
}

std::vector<std::uint64_t>& LevelSums::ofClass(ByClass& all, std::uint32_t number) const {
    std::vector<std::uint64_t>& own = all[number];
    if (own.empty()) own.resize(low.size());
    return own;
}

namespace {

// Calls face(scalar, count) for the filled samples of a column below `end` where the neighbouring column `other` is
// empty.
template <class Face>
void forFaces(std::span<const Run> runs, std::span<const Run> other, std::uint32_t end, const Face& face) {
    std::uint32_t from = 0;
    std::size_t beside = 0;
    for (const Run& run : runs)
        while (from < std::min(run.end, end)) {
            while (beside < other.size() && other[beside].end <= from) ++beside;
            std::uint32_t to = std::min(run.end, end);
            const bool isOpen = beside == other.size() || other[beside].scalar == 0;
            if (beside < other.size()) to = std::min(to, other[beside].end);
            if (isOpen && run.scalar != 0) face(run.scalar, to - from);
            from = to;
        }
}

}  // namespace

void LevelSums::addColumn(const LevelSource& source, std::int32_t i, std::int32_t j) {
    const std::span<const Run> runs = source.columns->column(i, j);
    if (runs.size() == 1 && runs[0].scalar == 0) return;
    const std::uint32_t bottom = runs[0].scalar == 0 ? runs[0].end : 0;
    const std::size_t highest = runs.size() - (runs.back().scalar == 0 ? 2 : 1);
    const std::uint32_t end = runs[highest].end;
    const auto cell = [&](std::size_t axis, std::int32_t at) {
        return ((source.first[axis] + at) >> (detail - 1)) - first[axis];
    };
    const auto to = static_cast<std::size_t>(cell(1, j) * size[0] + cell(0, i));
    low[to] += source.lowest + bottom;
    top[to] += source.lowest + end;
    ++ofClass(areaOf, source.classOf[runs[highest].scalar])[to];
    const Vec3i n = source.columns->dimension();
    for (const auto& [x, y] : {std::pair{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
        const bool isInside = x >= 0 && y >= 0 && x < n.x && y < n.y;
        const auto other = isInside ? source.columns->column(x, y) : std::span<const Run>();
        forFaces(runs, other, end - 1,
                 [&](Scalar scalar, std::uint32_t count) { ofClass(sideOf, source.classOf[scalar])[to] += count; });
    }
}

void LevelSums::add(const LevelSource& source) {
    const Vec3i n = source.columns->dimension();
    // Columns of detail 1 in which both lie.
    const auto range = [&](std::size_t axis, std::int32_t count) {
        const std::int64_t begin = first[axis] << (detail - 1);
        const std::int64_t end = (first[axis] + size[axis]) << (detail - 1);
        return std::array{static_cast<std::int32_t>(std::clamp<std::int64_t>(begin - source.first[axis], 0, count)),
                          static_cast<std::int32_t>(std::clamp<std::int64_t>(end - source.first[axis], 0, count))};
    };
    const auto [iBegin, iEnd] = range(0, n.x);
    const auto [jBegin, jEnd] = range(1, n.y);
    for (std::int32_t j = jBegin; j < jEnd; ++j)
        for (std::int32_t i = iBegin; i < iEnd; ++i) addColumn(source, i, j);
}

void LevelSums::add(const LevelSums& finer) {
    const auto eachColumn = [&](auto&& body) {
        for (std::int32_t j = 0; j < finer.size[1]; ++j)
            for (std::int32_t i = 0; i < finer.size[0]; ++i) {
                const std::int64_t x = ((finer.first[0] + i) >> 1) - first[0],
                                   y = ((finer.first[1] + j) >> 1) - first[1];
                if (x < 0 || y < 0 || x >= size[0] || y >= size[1]) continue;
                body(static_cast<std::size_t>(y * size[0] + x),
                     static_cast<std::size_t>(j) * static_cast<std::size_t>(finer.size[0]) +
                         static_cast<std::size_t>(i));
            }
    };
    eachColumn([&](std::size_t to, std::size_t from) {
        low[to] += finer.low[from];
        top[to] += finer.top[from];
    });
    const auto addAll = [&](const ByClass& from, ByClass& to) {
        for (const auto& entry : from) {
            std::vector<std::uint64_t>& own = ofClass(to, entry.first);
            eachColumn([&](std::size_t at, std::size_t n) { own[at] += entry.second[n]; });
        }
    };
    addAll(finer.areaOf, areaOf);
    addAll(finer.sideOf, sideOf);
}

Result<volume::SemanticVolume> LevelSums::volume(double spacing, const LevelClasses& classes,
                                                 const std::string& crsName) const {
    return LevelVolume(*this, spacing, classes).run(crsName);
}

}  // namespace svt::city
