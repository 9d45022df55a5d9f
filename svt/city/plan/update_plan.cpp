// Replaces a plan with another, and builds its packs aside until they are merged.
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_pack.hpp>
#include <svt/city/pack/pack_format.hpp>
#include <svt/core/file.hpp>

#include <algorithm>
#include <iterator>
#include <map>

namespace svt::city {
namespace {

namespace fs = std::filesystem;

struct Content {
    std::map<std::tuple<int, std::int32_t, std::int32_t>, std::uint64_t> tiles;  // key -> hash
    std::vector<std::uint64_t> features, ids;                                    // hashes, ascending
    bool hasIds = true;                                                          // false: of an earlier program
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
                content.ids.push_back(feature.idHash);
                hashes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
            }
            content.tiles[{tile.key.level, tile.key.x, tile.key.y}] = contentHash(hashes);
        }
    }
    std::sort(content.features.begin(), content.features.end());
    std::sort(content.ids.begin(), content.ids.end());
    content.hasIds = content.ids.empty() || content.ids.back() != 0;
    return content;
}

// Number of hashes in `a` that `b` lacks.
std::uint64_t onlyIn(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
    std::vector<std::uint64_t> only;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
    return only.size();
}

void compare(const Content& before, const Content& now, PlanChanges& changes) {
    const bool hasIds = before.hasIds && now.hasIds;
    const auto& idsBefore = hasIds ? before.ids : before.features;
    const auto& idsNow = hasIds ? now.ids : now.features;
    changes.newFeatures = onlyIn(idsNow, idsBefore);
    changes.goneFeatures = onlyIn(idsBefore, idsNow);
    const std::uint64_t other = onlyIn(now.features, before.features);
    changes.changedFeatures = other - std::min(other, changes.newFeatures);
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

Error cannotWrite(const fs::path& path, std::string_view what) {
    return {Code::CannotWrite, std::string(what), {path.string(), 0, 0, {}}};
}

// Built packs by the digest of their content.
std::map<std::string, fs::path> builtPacks(const fs::path& folder) {
    std::map<std::string, fs::path> packs;  // reports
    for (const fs::path& from : {workFolder(folder), folder}) {
        std::error_code failed;
        for (fs::directory_iterator entry(from / "reports", failed), end; !failed && entry != end;
             entry.increment(failed)) {
            const auto report = readReport(entry->path());
            std::error_code missing;
            if (report && fs::file_size(packPath(from, report->pack), missing) == report->bytes && !missing)
                packs.emplace(report->content, entry->path());
        }
    }
    return packs;
}

// Takes the built packs of the new plan into the folder of the update, without a copy where the disk allows it.
// \return their number
Result<std::uint64_t> takeOver(const fs::path& folder, const Plan& now, const fs::path& update) {
    std::error_code failed;
    fs::remove_all(update, failed);
    fs::create_directories(update / "packs", failed);
    fs::create_directories(update / "reports", failed);
    if (failed) return cannotWrite(update, "the folder of the update cannot be made");
    const std::map<std::string, fs::path> built = builtPacks(folder);
    std::uint64_t kept = 0;
    for (std::uint32_t pack = 0; pack < now.packs; ++pack) {
        const auto found = built.find(now.packDigests[pack]);
        if (found == built.end()) continue;
        SVT_TRY(report, readReport(found->second));
        const fs::path from = packPath(found->second.parent_path().parent_path(), report->pack);
        fs::create_hard_link(from, packPath(update, pack), failed);
        if (failed) fs::copy_file(from, packPath(update, pack), failed);
        if (failed) return cannotWrite(packPath(update, pack), "a pack that stays cannot be taken over");
        report->pack = pack;
        SVT_TRY(written, writeFileAtomically(reportPath(update, pack), reportJson(*report)));
        ++kept;
    }
    return kept;
}

}  // namespace

Result<Plan> updatePlan(std::span<const fs::path> files, const fs::path& folder, const PlanOptions& options,
                        Diagnostics& diagnostics, PlanChanges& changes) {
    SVT_DO(publishUpdate(folder));
    auto before = readPlan(folder, {});
    std::error_code failed;
    // After an update that was killed between its files, the plan is unreadable.
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
            changes.keptPacks += provenReport(workFolder(folder), *now, pack, false) ? 1 : 0;
        return now;
    }
    // First the packs, then the plan: packs of another plan are built again, a plan without its packs is not.
    const fs::path next = folder / "update-new", update = folder / "update";
    SVT_TRY(kept, takeOver(folder, *now, next));
    changes.keptPacks = *kept;
    fs::remove_all(update, failed);
    fs::rename(next, update, failed);
    if (failed) return cannotWrite(update, "the folder of the update cannot be replaced");
    for (const char* name : {"features.bin", "tiles.bin", "packs.bin", "plan.json"}) {
        fs::rename(aside / "plan" / name, folder / "plan" / name, failed);
        if (failed) return cannotWrite(folder / "plan", "the new plan cannot be written; plan again");
    }
    fs::remove_all(aside, failed);
    return now;
}

fs::path workFolder(const fs::path& folder) {
    const fs::path update = folder / "update";
    std::error_code failed;
    return fs::exists(update / "packs", failed) || fs::exists(update / "city.json", failed) ? update : folder;
}

Result<void> publishUpdate(const fs::path& folder) {
    const fs::path update = folder / "update";
    std::error_code failed;
    if (!fs::exists(update / "city.json", failed)) return {};
    const auto move = [&](const fs::path& from, const fs::path& to) {
        if (!failed) fs::rename(from, to, failed);
    };
    fs::create_directories(update / "old", failed);
    // Options of a cluster belong to the folder, not to a plan.
    if (fs::exists(folder / "reports" / "slurm.json", failed) && fs::exists(update / "reports", failed))
        move(folder / "reports" / "slurm.json", update / "reports" / "slurm.json");
    // A name that the folder of the update lacks was moved before a crash.
    for (const char* name : {"reports", "packs"}) {
        if (!fs::exists(update / name, failed)) continue;
        fs::remove_all(update / "old" / name, failed);
        if (fs::exists(folder / name, failed)) move(folder / name, update / "old" / name);
        move(update / name, folder / name);
    }
    for (const char* name : {"packs.bin", "index.bin", "ids.bin", "words.bin", "city.json"})
        if (fs::exists(update / name, failed)) move(update / name, folder / name);
    if (failed) return cannotWrite(folder, "the update cannot replace the city; merge again (svt city merge)");
    fs::remove_all(update, failed);
    return {};
}

}  // namespace svt::city
