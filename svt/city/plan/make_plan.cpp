#include <svt/city/base/sha256.hpp>
#include <svt/city/city_plan.hpp>
#include <svt/city/plan/plan_files.hpp>
#include <svt/city/plan/survey.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/file.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::city {
namespace {

constexpr std::uint64_t kTileCost = 4'000'000, kTaskCost = 300'000'000;  // microseconds
constexpr std::uint32_t kPackTiles = 2000;
constexpr std::uint32_t kMaxTasks = 1000;  // the index of Slurm's arrays ends there by default
constexpr std::int32_t kMaxTileSamples = 8192;

// The features of all tiles in their order, as numbers of surveyed ones.
class Tiling {
public:
    Tiling(const Survey& survey, const CityOptions& options) : survey_(survey) {
        // So fine that a tile's side has at most kMaxTileSamples.
        least_ = Plan::kTopLevel - 3;
        while (least_ > 0 && std::ldexp(1.0, least_) / options.spacing > kMaxTileSamples) --least_;
        top_ = Plan::kTopLevel;
        while (top_ > 0 && std::ldexp(1.0, top_) / options.spacing > kMaxTileSamples) --top_;
    }

    // Leaves out all but the first of features with equal id and text; counts them per file.
    std::vector<std::uint64_t> dropReplicas() {
        order_.resize(survey_.features.size());
        for (std::uint32_t n = 0; n < order_.size(); ++n) order_[n] = n;
        const auto key = [&](std::uint32_t n) {
            const Surveyed& f = survey_.features[n];
            return std::tuple(f.idHash, f.contentHash, f.size, n);
        };
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        std::vector<std::uint64_t> dropped(survey_.files.size(), 0);
        std::size_t kept = 0;
        for (const std::uint32_t n : order_) {
            const Surveyed& f = survey_.features[n];
            if (kept != 0) {
                const Surveyed& before = survey_.features[order_[kept - 1]];
                if (before.idHash == f.idHash && before.contentHash == f.contentHash && before.size == f.size) {
                    ++dropped[f.file];
                    continue;
                }
            }
            order_[kept++] = n;
        }
        order_.resize(kept);
        return dropped;
    }

    // A dropped feature, and the one of an earlier file that has its id; numbers of surveyed features.
    struct Conflict {
        std::uint32_t dropped = 0, kept = 0;
    };
    // Leaves out features whose id an earlier file gives to another feature. Call it after dropReplicas(), whose order
    // has equal ids next to each other.
    std::vector<Conflict> dropConflicts() {
        std::vector<Conflict> conflicts;
        std::size_t kept = 0;
        for (std::size_t begin = 0; begin < order_.size();) {
            std::size_t end = begin;
            const std::uint64_t id = survey_.features[order_[begin]].idHash;
            while (end < order_.size() && survey_.features[order_[end]].idHash == id) ++end;
            const std::uint32_t first = *std::min_element(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                                                          order_.begin() + static_cast<std::ptrdiff_t>(end));
            const bool isStated = (id & 1) != 0;
            for (; begin < end; ++begin) {
                const std::uint32_t own = order_[begin];
                if (isStated && survey_.features[own].file != survey_.features[first].file)
                    conflicts.push_back({own, first});
                else
                    order_[kept++] = own;
            }
        }
        order_.resize(kept);
        std::sort(conflicts.begin(), conflicts.end(),
                  [](const Conflict& a, const Conflict& b) { return a.dropped < b.dropped; });
        return conflicts;
    }

    void cut(Plan& plan) {
        const auto key = [&](std::uint32_t n) {
            const Surveyed& f = survey_.features[n];
            return std::tuple(mortonOf(keyOf(f, least_)), f.file, f.begin);
        };
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (std::size_t begin = 0; begin < order_.size();) {
            const TileKey top = keyOf(survey_.features[order_[begin]], top_);
            std::size_t end = begin + 1;
            while (end < order_.size() && keyOf(survey_.features[order_[end]], top_) == top) ++end;
            split(top, begin, end, plan);
            begin = end;
        }
        pack(plan);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

private:
    [[nodiscard]] static TileKey keyOf(const Surveyed& feature, int level) {
        const std::int64_t side = std::int64_t{100} << level;
        const auto cell = [&](std::int64_t at) {
            return static_cast<std::int32_t>(at >= 0 ? at / side : -((-at + side - 1) / side));
        };
        return {level, cell(feature.x), cell(feature.y)};
    }

    void split(TileKey key, std::size_t begin, std::size_t end, Plan& plan) {
        std::uint64_t cost = 0;
        for (std::size_t n = begin; n < end; ++n) cost += survey_.features[order_[n]].cost;
        const bool isLarge = end - begin > Plan::kMaxFeatures || (cost > kTileCost && end - begin > 1);
        if (!isLarge || key.level <= least_) {
            // Within a tile the order of files counts, so that files next to each other are read in one go.
            std::sort(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                      order_.begin() + static_cast<std::ptrdiff_t>(end), [&](std::uint32_t a, std::uint32_t b) {
                          const Surveyed &f = survey_.features[a], &g = survey_.features[b];
                          return std::tie(f.file, f.begin) < std::tie(g.file, g.begin);
                      });
            plan.tiles.push_back({key, begin, static_cast<std::uint32_t>(end - begin), 0, cost});
            return;
        }
        while (begin < end) {
            const TileKey quarter = keyOf(survey_.features[order_[begin]], key.level - 1);
            std::size_t last = begin + 1;
            while (last < end && keyOf(survey_.features[order_[last]], key.level - 1) == quarter) ++last;
            split(quarter, begin, last, plan);
            begin = last;
        }
    }

    // A pack is a square of the quadtree with little enough work, or a tile: so tiles of another district do not move
    // it.
    static void packSquare(Plan& plan, std::size_t begin, std::size_t end, int level) {
        std::uint64_t cost = 0;
        for (std::size_t n = begin; n < end; ++n) cost += plan.tiles[n].cost;
        if (end - begin == 1 || (double(cost) <= plan.options.packSeconds * 1e6 && end - begin <= kPackTiles)) {
            for (std::size_t n = begin; n < end; ++n) plan.tiles[n].pack = plan.packs;
            ++plan.packs;
            return;
        }
        const auto quarter = [&](std::size_t n) { return mortonOf(plan.tiles[n].key) >> 2 * (level - 1); };
        while (begin < end) {
            std::size_t last = begin + 1;
            while (last < end && quarter(last) == quarter(begin)) ++last;
            packSquare(plan, begin, last, level - 1);
            begin = last;
        }
    }

    static void pack(Plan& plan) {
        packSquare(plan, 0, plan.tiles.size(), 32);
        std::uint64_t all = 0;
        for (const PlanTile& tile : plan.tiles) all += tile.cost;
        if (plan.tasks == 0)
            plan.tasks = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(all / kTaskCost + 1, 1, kMaxTasks));
        plan.tasks = std::min(plan.tasks, plan.packs);
    }

    const Survey& survey_;
    int least_ = 0, top_ = 0;
    std::vector<std::uint32_t> order_;
};

// The digest of each pack: of the program, the options, and the tiles with all that their features are read from.
class PackDigests {
public:
    explicit PackDigests(const Plan& plan) : plan_(plan) {}

    void add(const PlanTile& tile) {
        if (tile.pack != pack_ || !isBegun_) begin(tile.pack);
        std::string text;
        appendBytes(text, tile.key.level, tile.key.x, tile.key.y, tile.featureCount);
        sum_.add(text);
    }
    void add(const PlanFeature& feature) {
        const PlanFile& file = plan_.files[feature.file];
        std::string text;
        // Features of one file follow each other as one model.
        appendBytes(text, feature.span.size, feature.contentHash, file.headHash, file.crs, file.axisOrder,
                    std::uint32_t{feature.file == file_ ? 0u : 1u});
        file_ = feature.file;
        sum_.add(text);
    }
    // \return all digests, 32 bytes each
    std::string finish(Plan& plan) {
        end();
        for (ByteReader from(bytes_); from.left() > 0;) plan.packDigests.push_back(hexOf(from.take<Digest>()));
        return std::move(bytes_);
    }

private:
    void begin(std::uint32_t pack) {
        if (isBegun_) end();
        isBegun_ = true;
        pack_ = pack;
        file_ = 0xFFFFFFFF;
        sum_ = Sha256();
        const CityOptions& options = plan_.options;
        sum_.add(fmt::format("svt-city-pack 2\n{}\n{} {}\n", plan_.program, options.spacing, options.lod));
        if (options.unit != 0 || !options.date.empty()) sum_.add(fmt::format("{} {}\n", options.unit, options.date));
    }
    void end() {
        const Digest digest = sum_.finish();
        bytes_.append(reinterpret_cast<const char*>(digest.data()), digest.size());
    }

    const Plan& plan_;
    Sha256 sum_;
    std::string bytes_;
    std::uint32_t pack_ = 0, file_ = 0;
    bool isBegun_ = false;
};

Result<void> writePlan(const std::filesystem::path& folder, const Survey& survey, const Tiling& tiling, Plan& plan) {
    std::error_code failed;
    std::filesystem::create_directories(folder / "plan", failed);
    for (const char* name : {"features.bin", "tiles.bin", "packs.bin", "plan.json"})
        SVT_DO(checkNoStream(folder / "plan" / name));
    SVT_TRY(features, AtomicFile::create(folder / "plan" / "features.bin"));
    Sha256 featureSum;
    PackDigests packDigests(plan);
    std::string tiles;
    for (const PlanTile& tile : plan.tiles) {
        tiles += tileBytes(tile);
        packDigests.add(tile);
        for (std::uint64_t n = tile.firstFeature; n < tile.firstFeature + tile.featureCount; ++n) {
            const Surveyed& f = survey.features[tiling.order()[n]];
            const std::uint64_t id = (f.idHash & 1) != 0 ? f.idHash : f.contentHash;
            const PlanFeature feature{f.file, {f.begin, f.size}, f.contentHash, static_cast<std::uint32_t>(id >> 32)};
            const std::string bytes = featureBytes(feature);
            featureSum.add(bytes);
            packDigests.add(feature);
            SVT_DO(features->write(bytes));
        }
    }
    plan.featuresDigest = hexOf(featureSum.finish());
    const std::string packs = packDigests.finish(plan);
    Sha256 sum;
    sum.add(planJson(plan, ""));
    sum.add(tiles);
    sum.add(packs);
    plan.digest = hexOf(sum.finish());
    SVT_DO(features->commit());
    SVT_DO(writeFileAtomically(folder / "plan" / "tiles.bin", tiles));
    SVT_DO(writeFileAtomically(folder / "plan" / "packs.bin", packs));
    // Last, so that there is no plan without its parts.
    SVT_DO(writeFileAtomically(folder / "plan" / "plan.json", planJson(plan, plan.digest)));
    return {};
}

// The id of a surveyed feature, read again from its file; empty if it cannot be read.
std::string idInFile(const Survey& survey, const Surveyed& feature) {
    auto file = readers::FeatureFile::open(survey.fileNames[feature.file]);
    if (!file) return {};
    std::string id;
    const readers::FeatureSpan span{feature.begin, feature.size};
    readers::ReadOptions reading;
    reading.date = "all";
    reading.keepFarFeatures = true;
    const auto picked = file->pick({&span, 1}, [&](std::size_t, std::string_view text) -> Result<void> {
        const auto model = file->read({&text, 1}, reading, nullptr);
        if (model && !model->roots.empty()) id = model->features[model->roots.front()].id;
        return {};
    });
    return picked ? id : std::string();
}

void noteConflicts(const Survey& survey, const std::vector<Tiling::Conflict>& conflicts, Plan& plan,
                   Diagnostics& diagnostics) {
    plan.conflicts = conflicts.size();
    for (const Tiling::Conflict& conflict : conflicts) {
        const Surveyed &dropped = survey.features[conflict.dropped], &kept = survey.features[conflict.kept];
        if (plan.conflictIds.size() == Plan::kNamedConflicts) break;
        plan.conflictIds.push_back(idInFile(survey, dropped));
        diagnostics.add(Severity::Warning, Code::IdConflict,
                        fmt::format("'{}' has the id of a feature with other content; this one is left out",
                                    survey.fileNames[kept.file]),
                        {survey.fileNames[dropped.file], 0, 0, plan.conflictIds.back()});
    }
}

// An error if more features cannot be read than allowed.
Result<void> checkReadable(const Survey& survey, double mostPercent) {
    const double all = double(survey.features.size() + survey.unreadable);
    if (double(survey.unreadable) <= all * mostPercent / 100) return {};
    return Error(Code::ManySkipped,
                 fmt::format("{} of {} features cannot be read, more than the {:g} % that may be left out; the first "
                             "because: {}. Correct the files or the options, or allow more (--max-left-out 100)",
                             survey.unreadable, survey.features.size() + survey.unreadable, mostPercent,
                             survey.firstUnreadable));
}

}  // namespace

Result<std::vector<std::filesystem::path>> cityInputs(std::span<const std::filesystem::path> inputs) {
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    std::error_code failed;
    for (const fs::path& input : inputs) {
        if (!fs::is_directory(input, failed)) {
            files.push_back(input);
            continue;
        }
        std::vector<fs::path> below;
        for (fs::recursive_directory_iterator entry(input, failed), end; !failed && entry != end;
             entry.increment(failed))
            // An entry that is not a regular file is not left out silently: reading it is an error.
            if (readers::hasModelEnding(entry->path()) && !entry->is_directory(failed)) below.push_back(entry->path());
        if (failed || below.empty())
            return Error(Code::CannotOpen,
                         fmt::format("the folder cannot be read, or has no file that ends as a model does ({}, each "
                                     "also with .gz)",
                                     fmt::join(readers::modelEndings(), ", ")),
                         {input.string(), 0, 0, {}});
        std::sort(below.begin(), below.end());
        files.insert(files.end(), below.begin(), below.end());
    }
    return files;
}

Result<Plan> makePlan(std::span<const std::filesystem::path> files, const std::filesystem::path& folder,
                      const PlanOptions& options, Diagnostics& diagnostics) {
    if (!(options.city.spacing >= 0.001 && options.city.spacing <= 100))
        return Error(Code::BadArgument,
                     fmt::format("spacing: {} is out of range; 0.001 to 100 m are possible", options.city.spacing));
    Survey survey;
    survey.crs = options.city.crs;
    for (const std::filesystem::path& file : files) SVT_DO(surveyFile(file, options, survey, diagnostics));
    return planSurveyed(survey, folder, options, diagnostics);
}

Result<Plan> planSurveyed(const Survey& survey, const std::filesystem::path& folder, const PlanOptions& options,
                          Diagnostics& diagnostics) {
    SVT_DO(checkReadable(survey, options.mostLeftOut));
    if (survey.features.empty()) return Error(Code::EmptyModel, "no file has a feature with geometry");
    if (survey.features.size() > 0xFFFFFFF0u)
        return Error(Code::InputTooBig, "a city has at most 4,294,967,280 features; plan it in parts");
    Tiling tiling(survey, options.city);
    const std::vector<std::uint64_t> replicas = tiling.dropReplicas();
    const std::vector<Tiling::Conflict> conflicts = tiling.dropConflicts();
    Plan plan;
    plan.options = options.city;
    plan.program = options.program;
    plan.crs = survey.crs;
    plan.crsName = survey.crsName;
    plan.files = survey.files;
    plan.tasks = options.tasks;
    plan.skipped = survey.skipped;
    noteConflicts(survey, conflicts, plan, diagnostics);
    for (std::size_t f = 0; f < replicas.size(); ++f) {
        plan.replicas += replicas[f];
        if (replicas[f] != 0)
            diagnostics.add(
                Severity::Note, Code::Replica,
                fmt::format("{} features stand in a file before with the same id and text; they are left out",
                            replicas[f]),
                {survey.fileNames[f], 0, 0, {}});
    }
    plan.features = tiling.order().size();
    tiling.cut(plan);
    SVT_DO(writePlan(folder, survey, tiling, plan));
    return plan;
}

}  // namespace svt::city
