#include <svt/city/plan/plan_files.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/file.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace svt::city {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPlanVersion = 1;
constexpr std::uint64_t kMaxPlanJson = std::uint64_t{256} << 20;

Error badPlan(const std::filesystem::path& file, std::string_view what) {
    return {Code::BadPlan, fmt::format("{}; make the plan again (svt city plan)", what), {file.string(), 0, 0, {}}};
}

std::filesystem::path planFile(const std::filesystem::path& folder, const char* name) { return folder / "plan" / name; }

void readJson(const Json& json, Plan& plan) {
    plan.program = json.at("program").get<std::string>();
    plan.digest = json.at("digest").get<std::string>();
    plan.featuresDigest = json.at("featuresSha256").get<std::string>();
    plan.crs = json.at("crs").get<int>();
    plan.crsName = json.at("crsName").get<std::string>();
    const Json& options = json.at("options");
    plan.options = {options.at("spacing").get<double>(), options.at("lod").get<double>(), options.at("crs").get<int>(),
                    options.at("packSeconds").get<double>()};
    plan.options.axisOrder = options.value("axisOrder", 0);
    plan.options.unit = options.value("unit", 0.0);
    plan.options.date = options.value("date", std::string());
    for (const Json& file : json.at("files"))
        plan.files.push_back({file.at("path").get<std::string>(), file.at("bytes").get<std::uint64_t>(),
                              file.at("crs").get<int>(), file.at("axisOrder").get<int>(),
                              file.at("head").get<std::uint64_t>()});
    plan.features = json.at("features").get<std::uint64_t>();
    plan.replicas = json.at("replicas").get<std::uint64_t>();
    plan.skipped = json.at("skipped").get<std::uint64_t>();
    if (json.contains("idConflicts")) {
        plan.conflicts = json.at("idConflicts").at("count").get<std::uint64_t>();
        plan.conflictIds = json.at("idConflicts").at("ids").get<std::vector<std::string>>();
    }
    plan.packs = json.at("packs").get<std::uint32_t>();
    plan.tasks = json.at("tasks").get<std::uint32_t>();
}

// Tiles follow each other without gaps, in features and in packs.
bool takeTiles(std::string_view bytes, Plan& plan) {
    if (bytes.size() % kTileBytes != 0) return false;
    ByteReader from(bytes);
    std::uint64_t features = 0;
    std::uint32_t pack = 0;
    plan.tiles.reserve(bytes.size() / kTileBytes);
    while (from.left() > 0) {
        PlanTile tile;
        from.take(tile.key.level, tile.key.x, tile.key.y, tile.pack, tile.firstFeature, tile.featureCount);
        from.skip(4);
        from.take(tile.cost);
        const bool isNext = plan.tiles.empty() ? tile.pack == 0 : tile.pack == pack || tile.pack == pack + 1;
        if (!isNext || tile.firstFeature != features || tile.key.level < 0 || tile.key.level > Plan::kTopLevel)
            return false;
        features += tile.featureCount;
        pack = tile.pack;
        plan.tiles.push_back(tile);
    }
    return features == plan.features && !plan.tiles.empty() && plan.packs == pack + 1;
}

}  // namespace

std::string TileKey::toString() const { return fmt::format("{}/{}/{}", level, x, y); }

Result<TileKey> TileKey::fromString(const std::string& text, int most) {
    TileKey key;
    const char *at = text.data(), *end = at + text.size();
    bool isGood = true;
    const auto number = [&](int& value, char after) {
        const auto [next, failed] = std::from_chars(at, end, value);
        isGood = isGood && failed == std::errc{} && (after == '\0' ? next == end : next != end && *next == after);
        at = next + (isGood && after != '\0' ? 1 : 0);
    };
    number(key.level, '/');
    number(key.x, '/');
    number(key.y, '\0');
    if (!isGood || key.level < 0 || key.level > most)
        return Error(Code::BadArgument,
                     fmt::format("'{}' is not a tile; expected LEVEL/X/Y, such as 10/390/5812", text));
    return key;
}

std::uint64_t mortonOf(const TileKey& key) noexcept {
    const auto spread = [](std::uint64_t v) {
        v = (v | v << 16) & 0x0000FFFF0000FFFFull;
        v = (v | v << 8) & 0x00FF00FF00FF00FFull;
        v = (v | v << 4) & 0x0F0F0F0F0F0F0F0Full;
        v = (v | v << 2) & 0x3333333333333333ull;
        return (v | v << 1) & 0x5555555555555555ull;
    };
    const auto metres = [&](std::int32_t cell) {
        const std::int64_t at = (static_cast<std::int64_t>(cell) << key.level) + (std::int64_t{1} << 31);
        return static_cast<std::uint64_t>(at) & 0xFFFFFFFFull;
    };
    return spread(metres(key.x)) | spread(metres(key.y)) << 1;
}

std::string tileBytes(const PlanTile& tile) {
    std::string bytes;
    appendBytes(bytes, tile.key.level, tile.key.x, tile.key.y, tile.pack, tile.firstFeature, tile.featureCount,
                std::uint32_t{0}, tile.cost);
    return bytes;
}

std::string featureBytes(const PlanFeature& feature) {
    std::string bytes;
    appendBytes(bytes, feature.span.begin, feature.span.size, feature.contentHash, feature.file, feature.idHash);
    return bytes;
}

std::string planJson(const Plan& plan, const std::string& digest) {
    Json json;
    json["format"] = "svt-city-plan";
    json["version"] = kPlanVersion;
    json["program"] = plan.program;
    json["digest"] = digest;
    json["featuresSha256"] = plan.featuresDigest;
    json["crs"] = plan.crs;
    json["crsName"] = plan.crsName;
    json["options"] = {{"spacing", plan.options.spacing},
                       {"lod", plan.options.lod},
                       {"crs", plan.options.crs},
                       {"packSeconds", plan.options.packSeconds}};
    if (plan.options.axisOrder != 0) json["options"]["axisOrder"] = plan.options.axisOrder;
    if (plan.options.unit != 0) json["options"]["unit"] = plan.options.unit;
    if (!plan.options.date.empty()) json["options"]["date"] = plan.options.date;
    json["features"] = plan.features;
    json["replicas"] = plan.replicas;
    json["skipped"] = plan.skipped;
    if (plan.conflicts != 0) json["idConflicts"] = {{"count", plan.conflicts}, {"ids", plan.conflictIds}};
    json["tiles"] = plan.tiles.size();
    json["packs"] = plan.packs;
    json["tasks"] = plan.tasks;
    json["files"] = Json::array();
    for (const PlanFile& file : plan.files)
        json["files"].push_back({{"path", file.path},
                                 {"bytes", file.size},
                                 {"crs", file.crs},
                                 {"axisOrder", file.axisOrder},
                                 {"head", file.headHash}});
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::array<std::size_t, 2> Plan::tilesOf(std::uint32_t pack) const {
    const auto [first, last] = std::equal_range(tiles.begin(), tiles.end(), PlanTile{{}, 0, 0, pack, 0},
                                                [](const PlanTile& a, const PlanTile& b) { return a.pack < b.pack; });
    return {static_cast<std::size_t>(first - tiles.begin()), static_cast<std::size_t>(last - tiles.begin())};
}

std::array<std::uint32_t, 2> Plan::packsOf(std::uint32_t task, std::uint32_t count) const {
    const auto at = [&](std::uint64_t n) { return static_cast<std::uint32_t>(n * packs / count); };
    return {at(task), at(std::uint64_t{task} + 1)};
}

Result<Plan> readPlan(const std::filesystem::path& folder, const std::string& program) {
    const std::filesystem::path path = planFile(folder, "plan.json");
    std::error_code failed;
    if (!std::filesystem::exists(path, failed))
        return badPlan(folder, "the folder has no plan of a city (plan/plan.json)");
    SVT_TRY(file, FileBytes::read(path, kMaxPlanJson));
    const auto tiles = FileBytes::read(planFile(folder, "tiles.bin"));
    if (!tiles) return badPlan(folder, "the plan lacks tiles.bin");
    Plan plan;
    try {
        const Json json = Json::parse(file->text());
        if (json.at("format") != "svt-city-plan") return badPlan(path, "this is not the plan of a city");
        if (json.at("version").get<int>() != kPlanVersion)
            return Error(Code::PlanVersion, "the plan has another version; make it again (svt city plan)",
                         {path.string(), 0, 0, {}});
        readJson(json, plan);
    } catch (const Json::exception&) {
        return badPlan(path, "the plan is damaged");
    }
    const auto packs = FileBytes::read(planFile(folder, "packs.bin"));
    if (!packs) return badPlan(folder, "the plan lacks packs.bin");
    if (packs->text().size() != plan.packs * sizeof(Digest))
        return badPlan(planFile(folder, "packs.bin"), "the digests of packs are damaged");
    for (ByteReader from(packs->text()); from.left() > 0;) plan.packDigests.push_back(hexOf(from.take<Digest>()));
    if (!takeTiles(tiles->text(), plan)) return badPlan(planFile(folder, "tiles.bin"), "the tiles are damaged");
    // The features are not read here: each has the hash of its text.
    Sha256 sum;
    sum.add(planJson(plan, ""));
    sum.add(tiles->text());
    sum.add(packs->text());
    if (hexOf(sum.finish()) != plan.digest) return badPlan(path, "plan and tiles do not fit the digest of the plan");
    if (!program.empty() && plan.program != program)
        return Error(Code::PlanVersion,
                     fmt::format("version '{}' of the program made this plan, this is '{}'; make the plan again, so "
                                 "that all of the city is of one version",
                                 plan.program, program),
                     {path.string(), 0, 0, {}});
    return plan;
}

Result<std::vector<PlanFeature>> readPlanFeatures(const std::filesystem::path& folder, const Plan& plan,
                                                  std::size_t first, std::size_t last) {
    const std::filesystem::path path = planFile(folder, "features.bin");
    std::vector<PlanFeature> features;
    if (first >= last) return features;
    const std::uint64_t begin = plan.tiles[first].firstFeature;
    const std::uint64_t end = plan.tiles[last - 1].firstFeature + plan.tiles[last - 1].featureCount;
    std::error_code failed;
    const std::uint64_t size = std::filesystem::file_size(path, failed);
    if (failed || end > size / kFeatureBytes) return badPlan(path, "the features are missing or end too early");
    std::ifstream file(path, std::ios::binary);
    std::string bytes(static_cast<std::size_t>((end - begin) * kFeatureBytes), '\0');
    file.seekg(static_cast<std::streamoff>(begin * kFeatureBytes));
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file || static_cast<std::size_t>(file.gcount()) != bytes.size())
        return badPlan(path, "the features end too early");
    ByteReader from(bytes);
    while (from.left() > 0) {
        PlanFeature feature;
        from.take(feature.span.begin, feature.span.size, feature.contentHash, feature.file, feature.idHash);
        if (feature.file >= plan.files.size() || feature.span.size > readers::FeatureFile::kMaxFeatureBytes * 64)
            return badPlan(path, "a feature is damaged");
        features.push_back(feature);
    }
    return features;
}

}  // namespace svt::city
