#include <svt/city/levels/level_sums.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::city {
namespace {

using volume::Run;
using volume::Scalar;

std::int64_t floorDiv(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

// Samples of detail 1 that are one of `detail` along z, as a power of two.
int heightShift(int detail, double spacing) {
    int shift = 0;
    while (shift < detail - 2 && 2 * spacing * std::ldexp(1.0, shift + 1) <= 4) ++shift;
    return shift;
}

// Classes of a column and their eighths, the largest first.
using Coverage = std::vector<std::pair<std::uint32_t, int>>;

// What a tile's columns look like before they are numbered.
struct Look {
    Coverage coverage;
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
        for (volume::Label& label : result.labels.labels) label.voxels = counts[label.first];
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
                if (look.coverage.empty()) continue;
                const bool isFirst = scalarOf_.empty();
                scalarOf_[look.coverage] = 0;
                bottom_ = isFirst ? look.low : std::min(bottom_, look.low);
                top_ = isFirst ? look.top : std::max(top_, look.top);
                low_ = {std::min(low_[0], i), std::min(low_[1], j)};
                high_ = {std::max(high_[0], i + 1), std::max(high_[1], j + 1)};
            }
    }

    [[nodiscard]] std::size_t indexOf(std::int32_t i, std::int32_t j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(sums_.size[0]) + static_cast<std::size_t>(i);
    }

    void lookAt(std::size_t n, Look& look) const {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> areas;
        std::int64_t area = 0;
        for (const auto& [number, all] : sums_.areaOf) {
            if (all[n] == 0) continue;
            areas.emplace_back(all[n], number);
            area += static_cast<std::int64_t>(all[n]);
        }
        if (areas.empty()) return;
        std::sort(areas.begin(), areas.end(), [&](const auto& a, const auto& b) {
            if (a.first != b.first) return a.first > b.first;
            return classes_.names[a.second] < classes_.names[b.second];
        });
        // The middle between samples counts up.
        const std::int64_t step = std::int64_t{1} << shift_;
        const auto mean = [&](std::int64_t sum) { return floorDiv(2 * sum + area * step, 2 * area * step); };
        look.low = mean(sums_.low[n]);
        look.top = std::max(look.low + 1, mean(sums_.top[n]));
        const double sample = 2 * spacing_;
        look.volume = double(sums_.top[n] - sums_.low[n]) * sample * sample * sample;
        look.coverage = coverage(areas);
    }

    [[nodiscard]] Coverage coverage(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& areas) const {
        constexpr std::size_t kMost = 4;
        if (sums_.detail == kFirstClassDetail) return {{areas[0].second, kCoverageSteps}};
        const double whole = std::ldexp(1.0, 2 * (sums_.detail - 1));
        Coverage result;
        int sum = 0;
        for (std::size_t n = 0; n < std::min(kMost, areas.size()); ++n) {
            const double share = std::min(1.0, double(areas[n].first) / whole);
            result.emplace_back(areas[n].second,
                                std::max(1, static_cast<int>(std::floor(kCoverageSteps * share + 0.5))));
            sum += result.back().second;
        }
        // Nothing vanishes, and together they cover a column at most: the first of the largest gives way.
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

    // One label a mixture that occurs, by name of the first class, then by id.
    void number(volume::LabelTable& table) {
        std::map<std::pair<std::string, std::string>, const Coverage*> sorted;
        for (const auto& [coverage, scalar] : scalarOf_)
            sorted[{classes_.names[coverage[0].first], idOf(coverage)}] = &coverage;
        std::map<Coverage, double> volumes;
        for (const Look& look : looks_)
            if (!look.coverage.empty()) volumes[look.coverage] += look.volume;
        for (const auto& [key, coverage] : sorted) {
            volume::Label label;
            label.className = key.first;
            label.id = key.second;
            label.name = sums_.detail == kFirstClassDetail ? std::string() : key.second;
            label.filling = volume::Filling::Solid;
            label.first = static_cast<Scalar>(table.labels.size() + 1);
            label.count = 1;
            label.subtreeEnd = static_cast<std::uint32_t>(table.labels.size() + 1);
            label.volume = volumes[*coverage];
            label.color = colorOf(*coverage);
            if (sums_.detail != kFirstClassDetail)
                for (const auto& [number, eighths] : *coverage)
                    label.attributes.push_back({classes_.names[number], std::int64_t{eighths}, {}});
            scalarOf_[*coverage] = label.first;
            table.labels.push_back(std::move(label));
        }
    }

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
        if (look.coverage.empty()) return {{end, 0}};
        const auto low = static_cast<std::uint32_t>(look.low - bottom_),
                   top = static_cast<std::uint32_t>(look.top - bottom_);
        std::vector<Run> runs;
        if (low > 0) runs.push_back({low, 0});
        runs.push_back({top, scalarOf_.at(look.coverage)});
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
    if (result.empty()) result.emplace_back(label.className, kCoverageSteps);
    return result;
}

std::uint32_t LevelClasses::add(const volume::Label& label) {
    const auto [at, isNew] = numberOf.emplace(label.className, static_cast<std::uint32_t>(names.size()));
    if (isNew) {
        names.push_back(label.className);
        colors.push_back(label.color);
        buildings.push_back(0);
    }
    ++buildings[at->second];
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
        const std::uint32_t number = classes.add(label);
        for (Scalar s = 0; s < label.count; ++s) source.classOf[label.first + s] = number;
    }
    return source;
}

LevelSums::LevelSums(int detail, std::array<std::int64_t, 2> first, std::array<std::int32_t, 2> size)
    : detail(detail), first(first), size(size) {
    const std::size_t count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    low.resize(count);
    top.resize(count);
}

std::vector<std::uint64_t>& LevelSums::areas(std::uint32_t number) {
    std::vector<std::uint64_t>& area = areaOf[number];
    if (area.empty()) area.resize(low.size());
    return area;
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
    std::vector<std::int64_t> filledOf;
    std::vector<std::uint32_t> met;
    for (std::int32_t j = jBegin; j < jEnd; ++j)
        for (std::int32_t i = iBegin; i < iEnd; ++i) {
            const std::span<const Run> runs = source.columns->column(i, j);
            if (runs.size() == 1 && runs[0].scalar == 0) continue;
            std::uint32_t begin = 0, bottom = 0, end = 0;
            bool isFilled = false;
            met.clear();
            for (const Run& run : runs) {
                if (run.scalar != 0) {
                    if (!isFilled) bottom = begin;
                    isFilled = true;
                    end = run.end;
                    const std::uint32_t number = source.classOf[run.scalar];
                    if (filledOf.size() <= number) filledOf.resize(number + 1);
                    if (filledOf[number] == 0) met.push_back(number);
                    filledOf[number] += run.end - begin;
                }
                begin = run.end;
            }
            std::uint32_t most = met[0];
            for (const std::uint32_t number : met)
                if (filledOf[number] > filledOf[most]) most = number;  // of equally many the lowest
            for (const std::uint32_t number : met) filledOf[number] = 0;
            const auto cell = [&](std::size_t axis, std::int32_t at) {
                return ((source.first[axis] + at) >> (detail - 1)) - first[axis];
            };
            const auto to = static_cast<std::size_t>(cell(1, j) * size[0] + cell(0, i));
            low[to] += source.lowest + bottom;
            top[to] += source.lowest + end;
            ++areas(most)[to];
        }
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
    for (const auto& entry : finer.areaOf) {
        std::vector<std::uint64_t>& own = areas(entry.first);
        eachColumn([&](std::size_t to, std::size_t from) { own[to] += entry.second[from]; });
    }
}

Result<volume::SemanticVolume> LevelSums::volume(double spacing, const LevelClasses& classes,
                                                 const std::string& crsName) const {
    return LevelVolume(*this, spacing, classes).run(crsName);
}

}  // namespace svt::city
