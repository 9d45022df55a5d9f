#include <svt/city/base/sha256.hpp>
#include <svt/city/city_folder.hpp>
#include <svt/city/levels/level_builder.hpp>
#include <svt/city/merge/city_proof.hpp>
#include <svt/city/merge/index_file.hpp>
#include <svt/city/pack/pack_format.hpp>
#include <svt/city/search/words_file.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/file.hpp>
#include <svt/core/parallel.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <optional>

namespace svt::city {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNamedPacks = 20;
constexpr std::uint64_t kMaxPackBytes = 256'000'000;
constexpr std::size_t kBatch = 32;  // members of detail 1 that are in memory at a time

struct Merging {
    std::vector<PlacedEntry> entries;
    std::vector<IdEntry> ids;
    std::vector<ColumnRange> ranges;  // of the members of detail 1
    std::string packs;                // packs.bin
    Box3d box;
    std::uint64_t tiles = 0;
    // The coarse levels.
    std::uint32_t packCount = 0;
    std::uint64_t levelBytes = 0;
    int top = 0;
    LevelClasses classes;
};

void addEntry(const PackMember& member, std::uint32_t pack, std::uint32_t buildings, Merging& to) {
    const auto down = [](double value) { return static_cast<std::int32_t>(std::floor(std::max(value, -2e9))); };
    const auto up = [](double value) { return static_cast<std::int32_t>(std::ceil(std::min(value, 2e9))); };
    to.entries.push_back(
        {{member.tile,
          member.detail,
          pack,
          member.offset,
          member.size,
          down(member.box.min.z),
          up(member.box.max.z),
          buildings,
          {}},
         {down(member.box.min.x), down(member.box.min.y), up(member.box.max.x), up(member.box.max.y)}});
}

void addPack(const Pack& pack, std::uint32_t number, double spacing, Merging& to) {
    std::uint32_t buildings = 0;
    for (const PackMember& member : pack.members()) {
        // Detail 0 comes first of each tile, with its buildings.
        if (member.detail == 0) {
            buildings = static_cast<std::uint32_t>(member.buildings.size());
            ++to.tiles;
        } else if (member.detail == 1) {
            const auto column = [&](double side) { return std::llround(side / (2 * spacing)); };
            to.ranges.push_back({{column(member.box.min.x), column(member.box.min.y)},
                                 {column(member.box.max.x) - 1, column(member.box.max.y) - 1},
                                 member.tile});
        }
        addEntry(member, number, buildings, to);
        to.box.add(member.box);
        for (const PackBuilding& building : member.buildings)
            to.ids.push_back({building.idHash, member.tile, building.label});
    }
}

Result<std::vector<WordsOfBuilding>> wordsOfTile(const Pack& pack, const PackMember& member) {
    SVT_TRY(labels, pack.readLabels(member));
    std::vector<WordsOfBuilding> buildings;
    for (const PackBuilding& building : member.buildings)
        if (building.label < labels->labels.size()) buildings.push_back(wordsOfBuilding(*labels, building.label));
    return buildings;
}

// Adds the buildings of a pack to the index of words, in the order of its tiles and labels.
Result<void> addWords(const Pack& pack, int threads, WordsWriter& to) {
    std::vector<const PackMember*> members;
    for (const PackMember& member : pack.members())
        if (member.detail == 0) members.push_back(&member);
    for (std::size_t begin = 0; begin < members.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, members.size() - begin);
        std::vector<std::optional<Result<std::vector<WordsOfBuilding>>>> read(count);
        parallelFor(count, 1, threads, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) read[n] = wordsOfTile(pack, *members[begin + n]);
        });
        for (auto& buildings : read) {
            if (!*buildings) return buildings->error();
            for (WordsOfBuilding& building : **buildings) SVT_DO(to.add(std::move(building)));
        }
    }
    return {};
}

// Writes the coarse levels into packs behind those of the plan: each detail into its own, the coarsest first.
class LevelPacks {
public:
    LevelPacks(const std::filesystem::path& folder, const Plan& plan, Merging& merged)
        : folder_(folder), plan_(plan), merged_(merged) {}

    Result<void> run(int threads, const Progress* progress) {
        LevelBuilder builder(merged_.ranges, plan_.options.spacing, plan_.crsName, threads);
        merged_.top = builder.top();
        writers_.resize(static_cast<std::size_t>(builder.top() + 1));
        std::vector<std::uint32_t> packs;
        for (const PlacedEntry& placed : merged_.entries)
            if (packs.empty() || packs.back() != placed.entry.pack) packs.push_back(placed.entry.pack);
        for (std::size_t n = 0; n < packs.size(); ++n) {
            Progress::tell(progress, "levels", double(n) / double(packs.size()));
            if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped while merging");
            SVT_DO(addPack(packs[n], threads, builder));
        }
        for (std::size_t detail = 0; detail < writers_.size(); ++detail) SVT_DO(finish(static_cast<int>(detail)));
        merged_.classes = builder.classes();
        putDigests();
        return {};
    }

private:
    struct Writing {
        std::optional<PackWriter> writer;
        std::uint32_t number = 0, series = 0;
        std::vector<PackMember> members;
    };
    struct Done {
        std::uint64_t bytes = 0;
        Digest digest{};
    };

    Result<void> addPack(std::uint32_t number, int threads, LevelBuilder& builder) {
        SVT_TRY(pack, Pack::open(packPath(folder_, number), plan_.packDigests[number]));
        std::vector<const PackMember*> members;
        for (const PackMember& member : pack->members())
            if (member.detail == 1) members.push_back(&member);
        for (std::size_t begin = 0; begin < members.size(); begin += kBatch) {
            const std::size_t count = std::min(kBatch, members.size() - begin);
            std::vector<std::optional<Result<volume::SemanticVolume>>> read(count);
            parallelFor(count, 1, threads, [&](std::size_t first, std::size_t last) {
                for (std::size_t n = first; n < last; ++n) read[n] = pack->read(*members[begin + n]);
            });
            std::vector<volume::SemanticVolume> volumes;
            for (auto& volume : read) {
                if (!*volume) return volume->error();
                volumes.push_back(std::move(**volume));
            }
            SVT_DO(builder.add(volumes, [&](LevelMember member) { return write(std::move(member)); }));
        }
        return {};
    }

    // Packs of a detail that needs several have numbers between which those of the other details lie, so that they are
    // known from the begin.
    Result<void> write(LevelMember member) {
        const int detail = member.member.detail;
        Writing& to = writers_[static_cast<std::size_t>(detail)];
        if (to.writer && to.writer->size() + member.bytes.size() > kMaxPackBytes) SVT_DO(finish(detail));
        if (!to.writer) {
            const auto details = static_cast<std::uint32_t>(merged_.top - kFirstClassDetail + 1);
            to.number = plan_.packs + to.series++ * details + static_cast<std::uint32_t>(merged_.top - detail);
            SVT_TRY(writer, PackWriter::create(packPath(folder_, to.number), plan_.digest));
            to.writer = std::move(*writer);
        }
        SVT_TRY(added, to.writer->add(member.member, member.bytes));
        addEntry(*added, to.number, 0, merged_);
        return {};
    }

    Result<void> finish(int detail) {
        Writing& own = writers_[static_cast<std::size_t>(detail)];
        if (!own.writer) return {};
        SVT_TRY(sum, own.writer->commit());
        done_[own.number] = {own.writer->size(), digestFromHex(*sum)};
        own.writer.reset();
        return {};
    }

    void putDigests() {
        merged_.packCount = done_.empty() ? plan_.packs : done_.rbegin()->first + 1;
        for (std::uint32_t number = plan_.packs; number < merged_.packCount; ++number) {
            const Done& done = done_[number];
            appendBytes(merged_.packs, done.bytes, done.digest);
            merged_.levelBytes += done.bytes;
        }
    }

    const std::filesystem::path& folder_;
    const Plan& plan_;
    Merging& merged_;
    std::vector<Writing> writers_;  // by detail
    std::map<std::uint32_t, Done> done_;
};

Json detailsJson(const Plan& plan, const Merging& merged) {
    Json details = Json::array();
    for (int detail = 0; detail <= merged.top; ++detail) {
        const Vec3d spacing = spacingOf(detail, plan.options.spacing);
        std::uint64_t tiles = 0, bytes = 0;
        for (const PlacedEntry& placed : merged.entries)
            if (placed.entry.detail == detail) {
                ++tiles;
                bytes += placed.entry.size;
            }
        const char* holds = detail == 0 ? "labels" : detail == 1 ? "buildings" : detail == 2 ? "classes" : "mixtures";
        Json json{{"detail", detail}, {"spacing", spacing.x}, {"holds", holds}, {"tiles", tiles}, {"bytes", bytes}};
        if (detail >= kFirstClassDetail) json["verticalSpacing"] = spacing.z;
        details.push_back(json);
    }
    return details;
}

Json topJson(const Merging& merged) {
    for (const PlacedEntry& placed : merged.entries)
        if (placed.entry.detail == merged.top)
            return {{"detail", merged.top},
                    {"tile", placed.entry.tile.toString()},
                    {"pack", placed.entry.pack},
                    {"offset", placed.entry.offset},
                    {"bytes", placed.entry.size}};
    return nullptr;
}

std::string colorText(Vec3f color) {
    const auto byte = [](float value) { return static_cast<int>(std::lround(double(value) * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.x), byte(color.y), byte(color.z));
}

// Classes of buildings, and in them those of their parts.
Json classesJson(const LevelClasses& classes) {
    constexpr std::size_t kMost = 64;  // of both, so that city.json stays small
    Json json = Json::array();
    std::size_t count = 0;
    for (const auto& [name, number] : classes.numberOf) {
        const std::string& root = classes.roots[number];
        if (name != root || count++ == kMost) continue;
        Json parts = Json::array();
        for (auto at = classes.numberOf.lower_bound(root + "/");
             at != classes.numberOf.end() && at->first.starts_with(root + "/") && count < kMost; ++at, ++count)
            parts.push_back(
                {{"class", at->first.substr(root.size() + 1)}, {"color", colorText(classes.colors[at->second])}});
        json.push_back({{"class", name},
                        {"buildings", classes.buildings[number]},
                        {"color", colorText(classes.colors[number])},
                        {"parts", parts}});
        if (count >= kMost) break;
    }
    return json;
}

std::string cityJson(const Plan& plan, const CityStatus& status, const Merging& merged, std::string_view index,
                     std::string_view ids, const CityProof::Words& words) {
    Json json;
    json["format"] = "svt-city";
    json["version"] = City::kVersion;
    json["program"] = plan.program;
    json["plan"] = plan.digest;
    json["crs"] = plan.crs;
    json["crsName"] = plan.crsName;
    json["box"] = {merged.box.min.x, merged.box.min.y, merged.box.min.z,
                   merged.box.max.x, merged.box.max.y, merged.box.max.z};
    json["tileScheme"] = {{"largestSide", 1 << Plan::kTopLevel}, {"order", "morton"}};
    json["details"] = detailsJson(plan, merged);
    json["top"] = topJson(merged);
    json["classes"] = classesJson(merged.classes);
    json["buildings"] = status.buildings;
    json["tiles"] = merged.tiles;
    json["packs"] = {{"count", merged.packCount},
                     {"ofTasks", plan.packs},
                     {"names", "packs/%05u.svtp"},
                     {"bytes", status.bytes + merged.levelBytes},
                     {"missing", status.missing.size()}};
    Json named = Json::array();
    for (std::size_t n = 0; n < std::min(kNamedPacks, status.missing.size()); ++n) named.push_back(status.missing[n]);
    json["packs"]["firstMissing"] = named;
    json["skippedFeatures"] = status.skipped.size() + plan.skipped;
    json["replicas"] = plan.replicas;
    if (plan.conflicts != 0) json["idConflicts"] = {{"count", plan.conflicts}, {"ids", plan.conflictIds}};
    putProofs(json, index, ids, merged.packs, words);
    return sealedJson(std::move(json));
}

}  // namespace

CityStatus cityStatus(const std::filesystem::path& folder, const Plan& plan, bool isProven) {
    CityStatus status;
    status.packs = plan.packs;
    const std::filesystem::path work = workFolder(folder);
    status.isUpdate = work != folder;
    for (std::uint32_t pack = 0; pack < plan.packs; ++pack) {
        const auto report = provenReport(work, plan, pack, isProven);
        if (!report) {
            status.missing.push_back(pack);
            continue;
        }
        status.bytes += report->bytes;
        status.buildings += report->buildings;
        status.skipped.insert(status.skipped.end(), report->skipped.begin(), report->skipped.end());
    }
    return status;
}

Result<CityStatus> mergeCity(const std::filesystem::path& folder, const Plan& plan, int threads,
                             const Progress* progress) {
    SVT_DO(publishUpdate(folder));
    CityStatus status = cityStatus(folder, plan, false);
    // An update replaces the city as a whole, or not yet.
    if (status.isUpdate && !status.missing.empty()) return status;
    const std::filesystem::path work = workFolder(folder);
    if (status.missing.size() == plan.packs)
        return Error(Code::CityIncomplete, "no pack of the city is done; run its tasks first (svt city run)",
                     {folder.string(), 0, 0, {}});
    for (const char* name : {"packs.bin", "index.bin", "ids.bin", "words.bin", "city.json"})
        SVT_DO(checkNoStream(work / name));
    SVT_TRY(words, WordsWriter::create(work / "words.bin"));
    Merging merged;
    std::size_t missing = 0;
    for (std::uint32_t number = 0; number < plan.packs; ++number) {
        Progress::tell(progress, "merge", double(number) / double(plan.packs));
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped while merging");
        if (missing < status.missing.size() && status.missing[missing] == number) {
            ++missing;
            appendBytes(merged.packs, std::uint64_t{0}, Digest{});
            continue;
        }
        SVT_TRY(report, provenReport(work, plan, number, false));
        appendBytes(merged.packs, report->bytes, digestFromHex(report->sha256));
        SVT_TRY(pack, Pack::open(packPath(work, number), plan.packDigests[number]));
        addPack(*pack, number, plan.options.spacing, merged);
        SVT_DO(addWords(*pack, threads, *words));
    }
    SVT_DO(LevelPacks(work, plan, merged).run(threads, progress));
    const std::string index = indexBytes(merged.entries), ids = idsBytes(std::move(merged.ids));
    for (const auto& [name, text] : {std::pair<const char*, const std::string*>{"packs.bin", &merged.packs},
                                     {"index.bin", &index},
                                     {"ids.bin", &ids}})
        SVT_DO(writeFileAtomically(work / name, *text));
    SVT_TRY(proof, words->finish());
    // Last: while it is the one before, it names other files, and the city is merged again.
    SVT_TRY(written, writeFileAtomically(work / "city.json", cityJson(plan, status, merged, index, ids, *proof)));
    if (status.isUpdate) SVT_DO(publishUpdate(folder));
    return status;
}

}  // namespace svt::city
