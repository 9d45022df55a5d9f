#include <svt/city/base/bytes.hpp>
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_folder.hpp>
#include <svt/city/merge/index_file.hpp>
#include <svt/core/file.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace svt::city {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNamedPacks = 20;

struct Merging {
    std::vector<PlacedEntry> entries;
    std::vector<IdEntry> ids;
    std::string packs;  // packs.bin
    Box3d box;
    std::uint64_t tiles = 0;
};

void addPack(const Pack& pack, std::uint32_t number, Merging& to) {
    std::uint32_t buildings = 0;
    for (const PackMember& member : pack.members()) {
        // Detail 0 comes first of each tile, with its buildings.
        if (member.detail == 0) {
            buildings = static_cast<std::uint32_t>(member.buildings.size());
            ++to.tiles;
        }
        const auto down = [](double value) { return static_cast<std::int32_t>(std::floor(std::max(value, -2e9))); };
        const auto up = [](double value) { return static_cast<std::int32_t>(std::ceil(std::min(value, 2e9))); };
        to.entries.push_back(
            {{member.tile, member.detail, number, member.offset, member.size, down(member.box.min.z),
              up(member.box.max.z), buildings},
             {down(member.box.min.x), down(member.box.min.y), up(member.box.max.x), up(member.box.max.y)}});
        to.box.add(member.box);
        for (const PackBuilding& building : member.buildings)
            to.ids.push_back({building.idHash, member.tile, building.label});
    }
}

std::string cityJson(const Plan& plan, const CityStatus& status, const Merging& merged, std::uint64_t indexBytes,
                     std::uint64_t idsBytes) {
    Json json;
    json["format"] = "svt-city";
    json["version"] = 1;
    json["program"] = plan.program;
    json["plan"] = plan.digest;
    json["crs"] = plan.crs;
    json["crsName"] = plan.crsName;
    json["box"] = {merged.box.min.x, merged.box.min.y, merged.box.min.z,
                   merged.box.max.x, merged.box.max.y, merged.box.max.z};
    json["tileScheme"] = {{"largestSide", 1 << Plan::kTopLevel}, {"order", "morton"}};
    json["details"] = Json::array();
    json["details"].push_back({{"detail", 0}, {"spacing", plan.options.spacing}, {"holds", "labels"}});
    json["details"].push_back({{"detail", 1}, {"spacing", plan.options.spacing * 2}, {"holds", "buildings"}});
    json["buildings"] = status.buildings;
    json["tiles"] = merged.tiles;
    json["packs"] = {{"count", plan.packs},
                     {"names", "packs/%05u.svtp"},
                     {"bytes", status.bytes},
                     {"missing", status.missing.size()}};
    Json named = Json::array();
    for (std::size_t n = 0; n < std::min(kNamedPacks, status.missing.size()); ++n) named.push_back(status.missing[n]);
    json["packs"]["firstMissing"] = named;
    json["skippedFeatures"] = status.skipped.size() + plan.skipped;
    json["replicas"] = plan.replicas;
    json["index"] = {{"file", "index.bin"}, {"bytes", indexBytes}};
    json["ids"] = {{"file", "ids.bin"}, {"bytes", idsBytes}};
    json["packDigests"] = "packs.bin";
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

CityStatus cityStatus(const std::filesystem::path& folder, const Plan& plan, bool isProven) {
    CityStatus status;
    status.packs = plan.packs;
    for (std::uint32_t pack = 0; pack < plan.packs; ++pack) {
        const auto report = provenReport(folder, plan, pack, isProven);
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

Result<CityStatus> mergeCity(const std::filesystem::path& folder, const Plan& plan, const Progress* progress) {
    CityStatus status = cityStatus(folder, plan, false);
    if (status.missing.size() == plan.packs)
        return Error(Code::CityIncomplete, "no pack of the city is done; run its tasks first (svt city run)",
                     {folder.string(), 0, 0, {}});
    Merging merged;
    std::size_t missing = 0;
    for (std::uint32_t number = 0; number < plan.packs; ++number) {
        Progress::tell(progress, "merge", double(number) / double(plan.packs));
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped while merging");
        if (missing < status.missing.size() && status.missing[missing] == number) {
            ++missing;
            put(merged.packs, std::uint64_t{0});
            merged.packs.append(32, '\0');
            continue;
        }
        const auto report = provenReport(folder, plan, number, false);
        if (!report) return report.error();
        put(merged.packs, report->bytes);
        const Digest digest = digestFromHex(report->sha256);
        merged.packs.append(reinterpret_cast<const char*>(digest.data()), digest.size());
        const auto pack = Pack::open(packPath(folder, number), plan.digest);
        if (!pack) return pack.error();
        addPack(*pack, number, merged);
    }
    const std::string index = indexBytes(merged.entries), ids = idsBytes(std::move(merged.ids));
    for (const auto& [name, text] : {std::pair<const char*, const std::string*>{"packs.bin", &merged.packs},
                                     {"index.bin", &index},
                                     {"ids.bin", &ids}})
        if (const auto written = writeFileAtomically(folder / name, *text); !written) return written.error();
    // Last, so that a city whose merge was stopped is the one before.
    const auto written =
        writeFileAtomically(folder / "city.json", cityJson(plan, status, merged, index.size(), ids.size()));
    if (!written) return written.error();
    return status;
}

}  // namespace svt::city
