// Replaces a plan with another and keeps the built packs that both have.
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_pack.hpp>
#include <svt/city/pack/pack_format.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace svt::city {
namespace {

namespace fs = std::filesystem;

struct Content {
    std::map<std::tuple<int, std::int32_t, std::int32_t>, std::uint64_t> tiles;  // key -> hash
    std::vector<std::uint64_t> features;                                         // hashes, ascending
};

Result<Content> contentOf(const fs::path& folder, const Plan& plan) {
    Content content;
    for (std::uint32_t pack = 0; pack < plan.packs; ++pack) {
        const auto [first, last] = plan.tilesOf(pack);
        SVT_TRY(features, readPlanFeatures(folder, plan, first, last));
        std::size_t n = 0;
        for (std::size_t t = first; t < last; ++t) {
            const PlanTile& tile = plan.tiles[t];
            std::string hashes;
            for (const std::size_t end = n + tile.featureCount; n < end; ++n) {
                const PlanFeature& feature = (*features)[n];
                const std::uint64_t hash = feature.contentHash ^ plan.files[feature.file].headHash;
                content.features.push_back(hash);
                hashes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
            }
            content.tiles[{tile.key.level, tile.key.x, tile.key.y}] = contentHash(hashes);
        }
    }
    std::sort(content.features.begin(), content.features.end());
    return content;
}

void compare(const Content& before, const Content& now, PlanChanges& changes) {
    std::vector<std::uint64_t> only;
    std::set_difference(now.features.begin(), now.features.end(), before.features.begin(), before.features.end(),
                        std::back_inserter(only));
    changes.newFeatures = only.size();
    only.clear();
    std::set_difference(before.features.begin(), before.features.end(), now.features.begin(), now.features.end(),
                        std::back_inserter(only));
    changes.goneFeatures = only.size();
    for (const auto& [key, hash] : now.tiles) {
        const auto own = before.tiles.find(key);
        if (own == before.tiles.end())
            ++changes.newTiles;
        else if (own->second != hash)
            ++changes.changedTiles;
    }
    for (const auto& [key, hash] : before.tiles)
        if (!now.tiles.contains(key)) ++changes.goneTiles;
}

fs::path keptPath(const fs::path& folder, const std::string& content, const char* ending) {
    return folder / "packs" / fmt::format("kept-{}{}", content.substr(0, 32), ending);
}

Error cannotMove(const fs::path& path) {
    return {Code::CannotWrite, "a pack that stays cannot get its new name", {path.string(), 0, 0, {}}};
}

// Names packs of the previous plan after their content, and removes unused ones.
Result<void> putAside(const fs::path& folder, const Plan& before, const Plan& now) {
    std::error_code failed;
    const std::vector<std::string> wanted = [&] {
        std::vector<std::string> sorted = now.packDigests;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }();
    for (std::uint32_t pack = 0; pack < before.packs; ++pack) {
        const auto report = provenReport(folder, before, pack, false);
        const bool isKept = report && std::binary_search(wanted.begin(), wanted.end(), report->content);
        if (!isKept) continue;
        fs::rename(reportPath(folder, pack), keptPath(folder, report->content, ".json"), failed);
        if (!failed) fs::rename(packPath(folder, pack), keptPath(folder, report->content, ".svtp"), failed);
        if (failed) return cannotMove(packPath(folder, pack));
    }
    return {};
}

// \return how many packs have their new numbers
Result<std::uint64_t> takeBack(const fs::path& folder, const Plan& now) {
    std::uint64_t kept = 0;
    std::error_code failed;
    fs::create_directories(folder / "reports", failed);
    for (std::uint32_t pack = 0; pack < now.packs; ++pack) {
        const fs::path aside = keptPath(folder, now.packDigests[pack], ".svtp"),
                       reportAside = keptPath(folder, now.packDigests[pack], ".json");
        if (fs::exists(reportAside, failed)) {
            if (fs::exists(aside, failed)) fs::rename(aside, packPath(folder, pack), failed);
            auto report = readReport(reportAside);
            if (!failed && report) {
                report->pack = pack;
                SVT_DO(checkNoStream(reportPath(folder, pack)));
                SVT_TRY(written, writeFileAtomically(reportPath(folder, pack), reportJson(*report)));
                fs::remove(reportAside, failed);
            }
            if (failed) return cannotMove(aside);
        }
        if (provenReport(folder, now, pack, false)) ++kept;
    }
    return kept;
}

// Packs and reports that no pack of the plan has.
void removeOthers(const fs::path& folder, const Plan& now) {
    std::error_code failed;
    for (const char* below : {"packs", "reports"})
        for (fs::directory_iterator entry(folder / below, failed), end; !failed && entry != end;
             entry.increment(failed)) {
            const fs::path path = entry->path();
            const std::string number = path.stem().string(), ending = path.extension().string();
            const auto pack = parseInteger<std::uint64_t>(number);
            const bool isNumbered =
                number.size() >= 5 && number.size() <= 10 && pack && (ending == ".svtp" || ending == ".json");
            std::error_code ignored;
            if (isNumbered && *pack >= now.packs) fs::remove(path, ignored);
            if (number.starts_with("kept-")) fs::remove(path, ignored);
        }
}

}  // namespace

Result<Plan> updatePlan(std::span<const fs::path> files, const fs::path& folder, const PlanOptions& options,
                        Diagnostics& diagnostics, PlanChanges& changes) {
    auto before = readPlan(folder, {});
    std::error_code failed;
    // After an update that was killed between its files, the plan is unreadable; packs that it put aside are taken
    // back.
    if (!before && !fs::exists(folder / "plan", failed)) return before.error();
    if (!before) before = Plan();
    SVT_TRY(contentBefore, contentOf(folder, *before));
    // The new plan is made next to the old one, which stays if an error occurs.
    const fs::path aside = folder / "plan-new";
    fs::remove_all(aside, failed);
    auto now = makePlan(files, aside, options, diagnostics);
    if (!now) {
        fs::remove_all(aside, failed);
        return now;
    }
    SVT_TRY(contentNow, contentOf(aside, *now));
    compare(*contentBefore, *contentNow, changes);
    if (before->digest == now->digest) {  // the same files and options
        fs::remove_all(aside, failed);
        for (std::uint32_t pack = 0; pack < now->packs; ++pack)
            changes.keptPacks += provenReport(folder, *now, pack, false) ? 1 : 0;
        return now;
    }
    // Until the next merge there is no city.
    fs::remove(folder / "city.json", failed);
    SVT_DO(putAside(folder, *before, *now));
    for (const char* name : {"features.bin", "tiles.bin", "packs.bin", "plan.json"}) {
        fs::rename(aside / "plan" / name, folder / "plan" / name, failed);
        if (failed)
            return Error(Code::CannotWrite, "the new plan cannot be written; plan again",
                         {(folder / "plan").string(), 0, 0, {}});
    }
    fs::remove_all(aside, failed);
    SVT_TRY(kept, takeBack(folder, *now));
    changes.keptPacks = *kept;
    removeOthers(folder, *now);
    return now;
}

}  // namespace svt::city
