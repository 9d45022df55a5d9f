// For any bytes the readers of a city's folder answer or name an error. Checksums are made right, so that what stands behind
// them is reached. The first byte chooses: 0 references of the index, 1 a leaf, 2 a pack, 3 ids, 4 a whole index, 5 a member,
// 6 a page of words, 7 a page of buildings, 8 the fence of both.
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/city/merge/index_file.hpp>
#include <svt/city/search/words_file.hpp>
#include <svt/core/bytes.hpp>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

using namespace svt;
using namespace svt::city;

void require(bool condition) {
    if (!condition) std::abort();
}

const std::filesystem::path& folder() {
    static const std::filesystem::path path = [] {
        const std::filesystem::path made =
            std::filesystem::temp_directory_path() / ("svt-city-fuzz-" + std::to_string(::getpid()));
        std::filesystem::create_directories(made / "packs");
        std::atexit([] { std::filesystem::remove_all(folder()); });
        return made;
    }();
    return path;
}

void write(const char* name, const std::string& text) { std::ofstream(folder() / name, std::ios::binary) << text; }

void openPack(std::string_view data) {
    std::string bytes("svtpack\0", 8);
    appendBytes(bytes, std::uint32_t{1});
    bytes.resize(48);
    ByteReader size(data);
    const std::size_t directory = size.take<std::uint16_t>();
    data = data.substr(std::min<std::size_t>(2, data.size()));
    const std::size_t body = data.size() - std::min(directory, data.size());
    bytes += data.substr(0, body);
    const std::uint64_t offset = bytes.size();
    bytes += data.substr(body);
    appendBytes(bytes, offset);
    appendBytes(bytes, static_cast<std::uint64_t>(data.size() - body));
    appendBytes(bytes, idHash(data.substr(body)));
    bytes += std::string_view("svtpend\0", 8);
    write("packs/00000.svtp", bytes);
    const auto pack = Pack::open(folder() / "packs/00000.svtp", {});
    if (!pack) return;
    for (const PackMember& member : pack->members()) {
        require(member.offset + member.size <= bytes.size());
        (void)pack->read(member);
    }
}

void openCity(const std::string& index, const std::string& ids) {
    write("city.json",
          R"({"format":"svt-city","version":1,"crsName":"","plan":"","details":[{"spacing":0.5}],"buildings":100000,)"
          R"("tiles":1,"packs":{"count":1,"bytes":1,"missing":0},"skippedFeatures":0,"box":[0,0,0,1,1,1],"classes":[],)"
          R"("top":{"detail":2,"tile":"0/0/0","pack":0,"offset":48,"bytes":1}})");
    write("index.bin", index);
    write("ids.bin", ids);
    const auto city = City::open(folder());
    if (!city) return;
    constexpr double kAll = 1e300;
    for (const int detail : {0, 1, 2})
        if (const auto entries = city->find(detail, {-kAll, -kAll, kAll, kAll}); entries)
            for (const IndexEntry& entry : *entries) require(entry.detail <= 255);
    for (const char* id : {"a", "b", ""}) (void)city->find(std::string(id));
}

// A root with right checksums: of itself, and in its first reference that of the page behind it.
std::string indexOf(std::string_view data) {
    std::string root(data.substr(0, std::min<std::size_t>(data.size(), 3 * PageRef::kBytes)));
    root.resize(root.size() / PageRef::kBytes * PageRef::kBytes);
    const std::string pages(data.substr(root.size()));
    if (!root.empty()) {
        const auto size = static_cast<std::uint32_t>(std::min(pages.size(), kIndexPage));
        std::memcpy(root.data() + 4, &size, sizeof size);
        std::memset(root.data() + 8, 0, 8);
        const std::uint64_t sum = idHash(pages.substr(0, size));
        std::memcpy(root.data() + PageRef::kBytes - 8, &sum, sizeof sum);
    }
    std::string bytes("svtindx\0", 8);
    appendBytes(bytes, std::uint32_t{1});
    appendBytes(bytes, static_cast<std::uint32_t>(root.size() / PageRef::kBytes));
    appendBytes(bytes, static_cast<std::uint64_t>(root.size()));
    appendBytes(bytes, idHash(root));
    return bytes + root + pages;
}

std::string idsOf(std::string_view data) {
    ByteReader from(data);
    const std::uint64_t count = from.take<std::uint16_t>(), pages = (count + kIdsOfPage - 1) / kIdsOfPage;
    const std::string fence(from.text(pages * 8));
    std::string bytes("svtids\0\0", 8);
    appendBytes(bytes, std::uint32_t{1});
    appendBytes(bytes, static_cast<std::uint32_t>(kIdsOfPage));
    appendBytes(bytes, count);
    appendBytes(bytes, static_cast<std::uint64_t>(fence.size()));
    appendBytes(bytes, idHash(fence));
    bytes += fence;
    while (from.left() > 0) {
        std::string page(from.text(std::min(from.left(), kIdPage - 8)));
        page.resize(kIdPage - 8);
        appendBytes(page, idHash(page));
        bytes += page;
    }
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    switch (data[0] % 9) {
        case 0:
            if (const auto refs = takeRefs(text)) require(refs->size() == text.size() / PageRef::kBytes);
            break;
        case 1:
            if (const auto entries = takeEntries(text))
                for (const IndexEntry& entry : *entries)
                    require(entry.tile.level >= 0 && entry.tile.level <= kMaxLevel);
            break;
        case 2: openPack(text); break;
        case 3: openCity(indexOf({}), idsOf(text)); break;
        case 4: openCity(indexOf(text), {}); break;
        case 6:
            if (const auto rows = takeWords(text, 1000))
                for (const WordRow& row : *rows)
                    for (const std::uint32_t building : row.buildings) require(building < 1000);
            for (const WantedWord& wanted : wantedWords(text))
                require(!wanted.word.empty() && wanted.word.size() <= kMostWordBytes);
            break;
        case 7:
            if (const auto buildings = takeBuildings(text)) require(buildings->size() <= kBuildingsOfPage);
            break;
        case 8:
            if (const auto fence = takeFence(text, text.size() * 8))
                for (const WordsPage& page : fence->words) require(page.offset + page.size <= text.size() * 8);
            break;
        default: {
            svt::volume::Label label;
            label.className = std::string(text);
            label.attributes.push_back({std::string(text), std::int64_t(size), {}});
            for (const auto& [name, eighths] : coverageOf(label)) require(eighths >= 1 && eighths <= kCoverageSteps);
            (void)TileKey::fromString(std::string(text));
        }
    }
    return 0;
}
