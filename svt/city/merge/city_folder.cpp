#include <svt/city/city_folder.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/city/merge/city_proof.hpp>
#include <svt/city/merge/index_file.hpp>
#include <svt/city/store/store.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/file.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace svt::city {
namespace {

// The tile that city.json names. \return whether it is one
bool readTop(const nlohmann::json& json, IndexEntry& top) {
    const auto& row = json.at("top");
    top.detail = row.at("detail").get<int>();
    top.pack = row.at("pack").get<std::uint32_t>();
    top.offset = row.at("offset").get<std::uint64_t>();
    top.size = row.at("bytes").get<std::uint64_t>();
    const auto tile = TileKey::fromString(row.at("tile").get<std::string>(), kMaxLevel);
    if (!tile || top.detail < kFirstClassDetail || top.detail > kMaxLevel + kFirstClassDetail) return false;
    top.tile = *tile;
    return true;
}

void readClass(const nlohmann::json& row, City::Class& to) {
    to.name = row.at("class").get<std::string>();
    to.color = row.at("color").get<std::string>();
    to.buildings = row.at("buildings").get<std::uint64_t>();
    if (!row.contains("parts")) return;
    for (const auto& part : row.at("parts"))
        to.parts.emplace_back(part.at("class").get<std::string>(), part.at("color").get<std::string>());
}

bool meets(const std::array<double, 4>& a, double west, double south, double east, double north) {
    return a[0] <= east && west <= a[2] && a[1] <= north && south <= a[3];
}

constexpr std::size_t kPackEntry = 40;  // of packs.bin: bytes and SHA-256

std::string packName(std::uint32_t pack) { return packPath({}, pack).generic_string(); }

Error badMember(const std::string& place, const IndexEntry& entry, std::string_view what) {
    return {Code::BadPack,
            fmt::format("tile {}, detail {}, is damaged ({}); remove the file, run its task again and merge",
                        entry.tile.toString(), entry.detail, what),
            {place, 0, 0, {}}};
}

// Whether the samples of a grid can be those of an entry: they meet its square and have its heights.
bool isOf(const volume::Grid& grid, const IndexEntry& entry, double spacing, const Box3d& all) {
    const double side = tileSide(entry.tile, entry.detail, spacing);
    const Vec3d low = grid.origin(), high = low + scaled(toDouble(grid.dimension()), grid.spacing());
    const double slack = 2 + 2 * grid.spacing().z;
    if (entry.lowest < entry.highest &&
        (std::abs(low.z - entry.lowest) > slack || std::abs(high.z - entry.highest) > slack))
        return false;
    if (entry.hasRectangle()) {
        const std::array<double, 4> sides{low.x, low.y, high.x, high.y};
        const double width = 1 + grid.spacing().x;  // from samples to their sides, and rounded outwards
        for (std::size_t n = 0; n < sides.size(); ++n)
            if (std::abs(sides[n] - entry.rectangle[n]) > width) return false;
        return true;
    }
    // The coarsest tile may reach over its square.
    const double reach = entry.detail < kFirstClassDetail ? 0 : std::max(all.max.x - all.min.x, all.max.y - all.min.y);
    return low.x <= (entry.tile.x + 1) * side + reach && high.x >= entry.tile.x * side - reach &&
           low.y <= (entry.tile.y + 1) * side + reach && high.y >= entry.tile.y * side - reach;
}

}  // namespace

struct City::Page : PageRef {};

Error City::damaged(const char* file, std::string_view what) const {
    return {Code::BadCity,
            fmt::format("{}; merge the city again (svt city merge)", what),
            {(folder_ / file).string(), 0, 0, {}}};
}

Result<City> City::open(const std::filesystem::path& folder) {
    constexpr int kTries = 40;
    for (int n = 1;; ++n) {
        auto city = open(openStore(folder.string()), folder);
        std::error_code failed;
        // While an update moves its files into place, they are those of two merges.
        if (city || n == kTries || !std::filesystem::exists(folder / "update" / "city.json", failed)) return city;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

Result<City> City::open(std::shared_ptr<const Store> store, const std::filesystem::path& folder) {
    City city(folder);
    city.store_ = std::move(store);
    SVT_TRY(text, city.store_->read("city.json", 0, 1 << 20));
    if (text->empty()) {
        std::error_code failed;
        if (city.store_->isLocal() && !std::filesystem::exists(folder / "city.json", failed) &&
            std::filesystem::exists(folder / "plan" / "plan.json", failed))
            return Error(
                Code::BadCity,
                fmt::format("the city is planned, but not built; 'svt city run {}' builds it", folder.string()),
                {(folder / "city.json").string(), 0, 0, {}});
        return city.damaged("city.json", "the folder has no merged city");
    }
    SVT_DO(city.readJson(*text));
    SVT_DO(city.proveFolder());
    SVT_DO(city.readRoot());
    SVT_DO(city.readPackSizes());
    return city;
}

Result<void> City::readJson(const std::string& text) {
    try {
        const auto json = nlohmann::json::parse(text);
        if (json.at("format") != "svt-city") return damaged("city.json", "this is not a city");
        if (const int version = json.at("version").get<int>(); version < 1 || version > kVersion)
            return Error(Code::PlanVersion, "the city has a version that this program does not know",
                         {(folder_ / "city.json").string(), 0, 0, {}});
        if (!hasOwnDigest(text, json))
            return damaged("city.json", "the file is damaged or was changed: its digest is another one");
        crsName_ = json.at("crsName").get<std::string>();
        plan_ = json.at("plan").get<std::string>();
        spacing_ = json.at("details").at(0).at("spacing").get<double>();
        buildings_ = json.at("buildings").get<std::uint64_t>();
        tiles_ = json.at("tiles").get<std::uint64_t>();
        packs_ = json.at("packs").at("count").get<std::uint32_t>();
        packBytes_ = json.at("packs").at("bytes").get<std::uint64_t>();
        missing_ = json.at("packs").at("missing").get<std::uint64_t>();
        skipped_ = json.at("skippedFeatures").get<std::uint64_t>();
        if (json.contains("idConflicts")) {
            conflicts_ = json.at("idConflicts").at("count").get<std::uint64_t>();
            conflictIds_ = json.at("idConflicts").at("ids").get<std::vector<std::string>>();
        }
        const auto box = json.at("box").get<std::array<double, 6>>();
        box_ = {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
        if (!readTop(json, top_)) return damaged("city.json", "the top tile is damaged");
        for (const auto& row : json.at("classes")) readClass(row, classes_.emplace_back());
        proof_ = readProof(json);
    } catch (const nlohmann::json::exception&) {
        return damaged("city.json", "the file is damaged");
    }
    return {};
}

Result<void> City::proveFolder() const {
    if (!proof_ || !store_->isLocal()) return {};
    for (const auto& [name, file] :
         {std::pair{"index.bin", &proof_->index}, {"ids.bin", &proof_->ids}, {"packs.bin", &proof_->packs}}) {
        SVT_TRY(difference, differenceOf(*store_, name, *file));
        if (!difference->empty()) return damaged(name, *difference);
    }
    if (!proof_->words) return {};
    SVT_TRY(difference, differenceOf(*store_, "words.bin", *proof_->words));
    return difference->empty() ? Result<void>() : damaged("words.bin", *difference);
}

Result<void> City::readRoot() {
    SVT_TRY(read, store_->read("index.bin", 0, kIndexHead + kIndexPage));
    const std::string& head = *read;
    ByteReader from(head);
    const std::string_view magic = from.text(8);
    std::uint32_t version = 0, refs = 0;
    std::uint64_t size = 0, sum = 0;
    from.take(version, refs, size, sum);
    if (magic != std::string_view("svtindx\0", 8) || version != 1 || !from.isGood() || size > kIndexPage ||
        size != std::uint64_t{refs} * PageRef::kBytes || from.left() < size ||
        idHash(head.substr(kIndexHead, size)) != sum)
        return damaged("index.bin", "the root of the index is missing or damaged");
    if (proof_ && proof_->root != sum)
        return damaged("index.bin", "the index is not the one that city.json names: it is of another merge");
    root_ = head.substr(kIndexHead, size);
    return {};
}

Result<void> City::readPackSizes() {
    SVT_TRY(sizes, store_->read("packs.bin", 0, std::size_t{packs_} * kPackEntry));
    // A web page does not get the digests of whole packs.
    if (proof_ && !sizes->empty() && hexOf(digestOf(*sizes)) != proof_->packs.sha256)
        return damaged("packs.bin", "the file is damaged or of another merge: its digest is not the one of city.json");
    for (ByteReader packs(*sizes); packs.left() >= kPackEntry; packs.skip(kPackEntry - 8))
        packSizes_.push_back(packs.take<std::uint64_t>());
    return {};
}

Result<void> City::readEntries(const Page& page, std::vector<IndexEntry>& to) const {
    SVT_TRY(bytes, store_->read("index.bin", kIndexHead + root_.size() + page.offset, page.size));
    const auto entries = idHash(*bytes) == page.checksum ? takeEntries(*bytes) : std::nullopt;
    if (!entries) return damaged("index.bin", fmt::format("the page at byte {} is damaged", page.offset));
    to.insert(to.end(), entries->begin(), entries->end());
    return {};
}

Result<std::vector<IndexEntry>> City::find(int detail, const std::array<double, 4>& rectangle) const {
    std::vector<IndexEntry> found;
    auto open = takeRefs(root_);
    if (!open) return damaged("index.bin", "the root of the index is damaged");
    std::reverse(open->begin(), open->end());
    while (!open->empty()) {
        const PageRef ref = open->back();
        open->pop_back();
        if (ref.detail != detail ||
            !meets(rectangle, ref.rectangle[0], ref.rectangle[1], ref.rectangle[2], ref.rectangle[3]))
            continue;
        if (ref.isLeaf) {
            SVT_DO(readEntries({ref}, found));
            continue;
        }
        SVT_TRY(bytes, store_->read("index.bin", kIndexHead + root_.size() + ref.offset, ref.size));
        const auto below = idHash(*bytes) == ref.checksum ? takeRefs(*bytes) : std::nullopt;
        // A page comes before those that refer to it, so this ends.
        const bool isBefore =
            below && std::all_of(below->begin(), below->end(), [&](const PageRef& b) { return b.offset < ref.offset; });
        if (!isBefore) return damaged("index.bin", fmt::format("the page at byte {} is damaged", ref.offset));
        open->insert(open->end(), below->rbegin(), below->rend());
    }
    std::erase_if(found, [&](const IndexEntry& entry) {
        if (entry.hasRectangle())
            return !meets(rectangle, entry.rectangle[0], entry.rectangle[1], entry.rectangle[2], entry.rectangle[3]);
        const double side = tileSide(entry.tile, entry.detail, spacing_);
        // Only the pages know which buildings reach over the border of their tile.
        return !meets(rectangle, (entry.tile.x - 1) * side, (entry.tile.y - 1) * side, (entry.tile.x + 2) * side,
                      (entry.tile.y + 2) * side);
    });
    return found;
}

Result<std::vector<City::Place>> City::find(const std::string& id) const {
    const std::string path = "ids.bin";
    const auto head = store_->read(path, 0, kIdHead);
    const auto fileSize = store_->size(path);
    if (!head || !fileSize) return head ? fileSize.error() : head.error();
    ByteReader from(*head);
    const std::string_view magic = from.text(8);
    std::uint32_t version = 0, ofPage = 0;
    std::uint64_t count = 0, fenceSize = 0, sum = 0;
    from.take(version, ofPage, count, fenceSize, sum);
    const std::uint64_t pages = (count + kIdsOfPage - 1) / kIdsOfPage;
    if (magic != std::string_view("svtids\0\0", 8) || version != 1 || ofPage != kIdsOfPage || !from.isGood() ||
        fenceSize != pages * 8 || count > buildings_ + 1 || fenceSize > *fileSize)
        return damaged("ids.bin", "the index of ids is missing or damaged");
    if (proof_ && (proof_->fence != sum || proof_->idCount != count))
        return damaged("ids.bin", "the ids are not the ones that city.json names: they are of another merge");
    SVT_TRY(read, store_->read(path, kIdHead, fenceSize));
    const std::string& fence = *read;
    if (fence.size() != fenceSize || idHash(fence) != sum) return damaged("ids.bin", "the fence of the ids is damaged");
    std::vector<std::uint64_t> first;
    for (ByteReader fences(fence); fences.left() > 0;) first.push_back(fences.take<std::uint64_t>());
    const std::uint64_t hash = idHash(id);
    // The page before the first that begins with the hash may end with it.
    auto page = static_cast<std::uint64_t>(std::lower_bound(first.begin(), first.end(), hash) - first.begin());
    page -= page > 0 ? 1 : 0;
    std::vector<Place> found;
    for (; page < pages && first[page] <= hash; ++page) {
        SVT_TRY(own, store_->read(path, kIdHead + fenceSize + page * kIdPage, kIdPage));
        const std::string& bytes = *own;
        ByteReader tail(std::string_view(bytes).substr(std::min(bytes.size(), kIdPage - 8)));
        if (bytes.size() != kIdPage || tail.take<std::uint64_t>() != idHash(bytes.substr(0, kIdPage - 8)))
            return damaged("ids.bin", fmt::format("page {} of the ids is damaged", page));
        ByteReader entries(bytes);
        for (std::uint64_t n = 0; n < std::min<std::uint64_t>(kIdsOfPage, count - page * kIdsOfPage); ++n) {
            std::uint64_t ownHash = 0;
            Place place;
            entries.take(ownHash, place.tile.x, place.tile.y, place.label, place.tile.level);
            if (ownHash == hash) found.push_back(place);
        }
    }
    return found;
}

Result<std::string> City::readBytes(const IndexEntry& entry) const {
    const std::string name = packName(entry.pack);
    SVT_TRY(bytes, store_->read(name, entry.offset, entry.size));
    SVT_TRY(size, store_->size(name));
    if (entry.pack < packSizes_.size() && *size != packSizes_[entry.pack])
        return badMember(store_->place(name), entry, "the size of the pack changed since the merge");
    if (bytes->size() != entry.size)
        return badMember(store_->place(name), entry, "the pack is missing or ends before it");
    return bytes;
}

Result<volume::SemanticVolume> City::read(const IndexEntry& entry) const {
    auto volume = readWithMeshes(entry);
    if (volume) keepAsFootprints(*volume);
    return volume;
}

void keepAsFootprints(volume::SemanticVolume& tile) {
    if (tile.vectors.triangles.empty()) return;
    tile.footprints = std::move(tile.vectors);
    tile.vectors = {};
}

Result<volume::SemanticVolume> City::readWithMeshes(const IndexEntry& entry) const {
    SVT_TRY(bytes, readBytes(entry));
    const std::string place = store_->place(packName(entry.pack));
    auto volume = volume::readSvt(std::as_bytes(std::span(*bytes)), place);
    if (!volume) return badMember(place, entry, volume.error().message());
    // A pack of other content has other tiles there.
    if (!isOf(volume->grid, entry, spacing_, box_)) return badMember(place, entry, "another tile stands there");
    return volume;
}

}  // namespace svt::city
