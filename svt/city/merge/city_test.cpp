// From files to a city and back: the same bytes whatever builds it, and what is damaged is named.
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_bytes.hpp>
#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/city/city_view.hpp>
#include <svt/city/merge/city_proof.hpp>
#include <svt/city/merge/index_file.hpp>
#include <svt/city/search/words.hpp>
#include <svt/city/store/store.hpp>
#include <svt/city/tile/tile_builder.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/city_sample.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <set>
#include <thread>

namespace svt::city {
namespace {

TEST(Sha256, AnswersAsTheStandardDoes) {
    EXPECT_EQ(hexOf(digestOf("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hexOf(digestOf("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hexOf(digestOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    Sha256 parts;
    const std::string text(1'000'000, 'a');
    for (std::size_t at = 0; at < text.size(); at += 777) parts.add(std::string_view(text).substr(at, 777));
    const Digest digest = parts.finish();
    EXPECT_EQ(hexOf(digest), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_EQ(digestFromHex(hexOf(digest)), digest);
    EXPECT_EQ(idHash("abc"), 0xba7816bf8f01cfeaull);
}

TEST(TileKey, HasATextAndAPlaceOnTheCurve) {
    const TileKey key{9, -3, 754};
    const auto read = TileKey::fromString(key.toString());
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, key);
    for (const char* text : {"", "9", "9/1", "9/1/", "9/1/2/", "9/1/2 ", "11/0/0", "-1/0/0", "a/b/c"})
        EXPECT_FALSE(TileKey::fromString(text)) << text;
    // A tile begins where its south-western quarter does; the quarters follow in the order of the curve.
    EXPECT_EQ(mortonOf({10, 1, 1}), mortonOf({9, 2, 2}));
    EXPECT_LT(mortonOf({9, 2, 2}), mortonOf({9, 3, 2}));
    EXPECT_LT(mortonOf({9, 3, 2}), mortonOf({9, 2, 3}));
    EXPECT_LT(mortonOf({9, 3, 3}), mortonOf({10, 2, 0}));
}

TEST(Index, GivesBackWhatWasPutIn) {
    std::vector<PlacedEntry> entries;
    for (std::int32_t n = 0; n < 60'000; ++n) {
        const TileKey tile{7 + n % 3, n % 251 - 100, n / 251};
        entries.push_back({{tile, n % 2, std::uint32_t(n / 100), std::uint64_t(48 + 8 * n), std::uint64_t(100 + n),
                            n % 50 - 9, n % 50 + 20, std::uint32_t(n % 256)},
                           {n % 251, n / 251, n % 251 + 1, n / 251 + 1}});
    }
    const std::string bytes = indexBytes(entries);
    const std::size_t root =
        bytes[12] ? static_cast<unsigned char>(bytes[12]) + 256u * static_cast<unsigned char>(bytes[13]) : 0;
    const auto refs = takeRefs(std::string_view(bytes).substr(kIndexHead, root * PageRef::kBytes));
    ASSERT_TRUE(refs);
    std::size_t found = 0;
    for (const PageRef& ref : *refs) {
        EXPECT_LE(ref.size, kIndexPage);
        const auto page =
            takeEntries(std::string_view(bytes).substr(kIndexHead + root * PageRef::kBytes + ref.offset, ref.size));
        ASSERT_TRUE(page);
        for (const IndexEntry& entry : *page) {
            const auto n = static_cast<std::size_t>((entry.offset - 48) / 8);
            ASSERT_LT(n, entries.size());
            const IndexEntry& own = entries[n].entry;
            EXPECT_TRUE(entry.tile == own.tile && entry.detail == own.detail && entry.pack == own.pack &&
                        entry.size == own.size && entry.lowest == own.lowest && entry.highest == own.highest &&
                        entry.buildings == own.buildings);
            ++found;
        }
    }
    EXPECT_EQ(found, entries.size());
}

class SmallCity : public ::testing::Test {
protected:
    void write(const std::filesystem::path& to, samples::CityProfile profile, int files) {
        std::filesystem::create_directories(to);
        const samples::CitySampleOptions options{profile, 96, files, 3};
        for (int n = 0; n < files; ++n) {
            std::string text;
            ASSERT_TRUE(samples::writeCitySample(options, n, [&](std::string_view part) {
                text += part;
                return true;
            }));
            test::writeText(to / samples::citySampleFileName(options, n), text);
        }
    }
    Plan plan(double spacing = 1) {
        PlanOptions options;
        options.city.spacing = spacing;
        options.program = "test";
        const std::filesystem::path input = folder / "files";
        const auto files = cityInputs(std::span(&input, 1));
        EXPECT_TRUE(files);
        auto made = makePlan(*files, folder / "city", options, findings);
        EXPECT_TRUE(made) << made.error().toString();
        return *made;
    }
    void build(const Plan& made, const PackOptions& options = {}) {
        for (std::uint32_t pack = 0; pack < made.packs; ++pack) {
            const auto report = runPack(folder / "city", made, pack, options);
            ASSERT_TRUE(report) << report.error().toString();
        }
        const auto merged = mergeCity(folder / "city", made);
        ASSERT_TRUE(merged) << merged.error().toString();
    }
    City open() {
        auto city = City::open(folder / "city");
        EXPECT_TRUE(city) << city.error().toString();
        return *city;
    }
    std::string bytes(const char* name) { return test::readText(folder / "city" / name); }

    test::TemporaryFolder folder;
    Diagnostics findings;
};

std::uint64_t voxelsOf(const volume::SemanticVolume& volume) {
    std::uint64_t sum = 0;
    for (const volume::Label& label : volume.labels.labels) sum += label.voxels;
    return sum;
}

TEST_F(SmallCity, KeepsReplicasOnceAndEachBuilding) {
    write(folder / "files", samples::CityProfile::Berlin, 4);
    const Plan made = plan();
    EXPECT_EQ(made.features, 96u);
    EXPECT_GT(made.replicas, 0u);
    EXPECT_GT(findings.count(Code::Replica), 0u);
    build(made);
    const City city = open();
    EXPECT_EQ(city.buildings(), 96u);
    const auto entries = city.find(0, {-1e9, -1e9, 1e9, 1e9});
    ASSERT_TRUE(entries);
    std::uint32_t buildings = 0;
    for (const IndexEntry& entry : *entries) {
        buildings += entry.buildings;
        const auto volume = city.read(entry);
        ASSERT_TRUE(volume);
        // On the lattice of the city.
        for (int axis = 0; axis < 3; ++axis) {
            const double steps = volume->grid.origin()[axis] / city.spacing() - 0.5;
            EXPECT_EQ(steps, std::round(steps));
            EXPECT_EQ(std::fmod(steps, 4), 0);
        }
    }
    EXPECT_EQ(buildings, 96u);
}

TEST_F(SmallCity, HasABuildingOfEachAtDetailOne) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    build(plan());
    const City city = open();
    const auto entries = city.find(1, {-1e9, -1e9, 1e9, 1e9});
    ASSERT_TRUE(entries);
    std::size_t buildings = 0;
    for (const IndexEntry& entry : *entries) {
        const auto coarse = city.read(entry);
        ASSERT_TRUE(coarse);
        EXPECT_EQ(coarse->grid.spacing(), (Vec3d{2, 2, 2}));
        const std::vector<volume::Label>& labels = coarse->labels.labels;
        for (const volume::Label& label : labels) {
            if (label.parent != volume::kNoLabel) {
                EXPECT_EQ(labels[label.parent].parent, volume::kNoLabel);
                EXPECT_GT(label.voxels, 0u);
                EXPECT_NE(label.className, labels[label.parent].className);
                continue;
            }
            ++buildings;
            EXPECT_GT(label.volume, 0) << label.id;
        }
    }
    EXPECT_EQ(buildings, 96u);
}

// Cells by a second way to count: all samples of each, one by one.
TEST_F(SmallCity, ShowsRoofsAndWallsAtDetailOne) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const City city = open();
    const auto fine = city.find(0, {-1e9, -1e9, 1e9, 1e9}), coarse = city.find(1, {-1e9, -1e9, 1e9, 1e9});
    ASSERT_TRUE(fine && coarse && fine->size() == coarse->size());
    std::map<std::string, std::size_t> cells;
    for (std::size_t t = 0; t < fine->size(); ++t) {
        const auto from = city.read((*fine)[t]), to = city.read((*coarse)[t]);
        ASSERT_TRUE(from && to);
        const std::vector<std::uint32_t> labelOf = from->labels.labelOfScalar(), shownOf = to->labels.labelOfScalar();
        const auto rootOf = [](const volume::LabelTable& table, std::uint32_t label) {
            while (table.labels[label].parent != volume::kNoLabel) label = table.labels[label].parent;
            return label;
        };
        const Vec3i n = to->grid.dimension();
        for (std::int32_t k = 0; k < n.z; ++k)
            for (std::int32_t j = 0; j < n.y; ++j)
                for (std::int32_t i = 0; i < n.x; ++i) {
                    std::map<std::string, std::map<std::string, int>> counts;  // by id of the root, by class
                    for (int c = 0; c < 8; ++c) {
                        const volume::Scalar scalar =
                            from->columns.scalarAt(2 * i + (c & 1), 2 * j + ((c >> 1) & 1), 2 * k + (c >> 2));
                        if (scalar == 0) continue;
                        const volume::Label& root = from->labels.labels[rootOf(from->labels, labelOf[scalar])];
                        ++counts[root.id][from->labels.labels[labelOf[scalar]].className];
                    }
                    const volume::Scalar shown = to->columns.scalarAt(i, j, k);
                    ASSERT_EQ(shown == 0, counts.empty());
                    if (shown == 0) continue;
                    const volume::Label& label = to->labels.labels[shownOf[shown]];
                    const volume::Label& root = to->labels.labels[rootOf(to->labels, shownOf[shown])];
                    ++cells[label.className];
                    const auto sum = [](const std::map<std::string, int>& classes) {
                        int all = 0;
                        for (const auto& entry : classes) all += entry.second;
                        return all;
                    };
                    for (const auto& [id, classes] : counts) ASSERT_LE(sum(classes), sum(counts[root.id]));
                    const std::map<std::string, int>& own = counts[root.id];
                    if (label.className == root.className) {
                        ASSERT_EQ(own.size(), 1u) << "its body, where nothing else is";
                        continue;
                    }
                    for (const auto& [name, samples] : own) {
                        if (name == root.className) continue;
                        ASSERT_LE(samples, own.at(label.className));
                    }
                }
    }
    EXPECT_GT(cells["RoofSurface"], 1000u);
    EXPECT_GT(cells["WallSurface"], 1000u);
}

// Each sample of detail 1 lies under a filled column of each coarser detail.
TEST_F(SmallCity, LosesNoBuildingAtAnyDetail) {
    write(folder / "files", samples::CityProfile::Berlin, 2);
    build(plan(0.15));
    const City city = open();
    ASSERT_GE(city.topDetail(), 3);
    ASSERT_EQ(city.classes().size(), 1u);
    EXPECT_EQ(city.classes()[0].name, "Building");
    EXPECT_EQ(city.classes()[0].buildings, 96u);
    const std::array<double, 6> all{-1e6, -1e7, -1e3, 1e6, 1e7, 1e4};
    const auto fine = extractVolume(city, {{}, {}, all, true, 1});
    ASSERT_TRUE(fine);
    for (int detail = 2; detail <= city.topDetail(); ++detail) {
        const auto coarse = extractVolume(city, {{}, {}, all, true, detail});
        ASSERT_TRUE(coarse) << coarse.error().toString();
        EXPECT_EQ(coarse->grid.spacing(), spacingOf(detail, 0.15));
        const Vec3i n = fine->grid.dimension(), m = coarse->grid.dimension();
        std::size_t filled = 0;
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const auto runs = fine->columns.column(i, j);
                if (runs.size() == 1 && runs[0].scalar == 0) continue;
                const Vec3d at = fine->grid.origin() + scaled(Vec3d{double(i), double(j), 0}, fine->grid.spacing());
                const Vec3d step = coarse->grid.spacing(), corner = coarse->grid.origin() - step * 0.5;
                const auto x = static_cast<std::int32_t>(std::floor((at.x - corner.x) / step.x)),
                           y = static_cast<std::int32_t>(std::floor((at.y - corner.y) / step.y));
                ASSERT_TRUE(x >= 0 && y >= 0 && x < m.x && y < m.y);
                const auto above = coarse->columns.column(x, y);
                EXPECT_FALSE(above.size() == 1 && above[0].scalar == 0);
                ++filled;
            }
        EXPECT_GT(filled, 1000u);
    }
    EXPECT_EQ(extractVolume(city, {{}, {}, all, true, city.topDetail() + 1}).error().code(), Code::BadArgument);
    EXPECT_EQ(extractVolume(city, {{}, {"x"}, {}, false, 2}).error().code(), Code::BadArgument);
    // The top is what city.json says, and one tile.
    const auto top = city.find(city.topDetail(), {-1e9, -1e9, 1e9, 1e9});
    ASSERT_TRUE(top);
    ASSERT_EQ(top->size(), 1u);
    EXPECT_EQ(top->front().offset, city.top().offset);
    EXPECT_EQ(top->front().pack, city.top().pack);
    EXPECT_TRUE(city.read(city.top()));
}

TEST_F(SmallCity, RefusesAnIndexOfWordsWithImpossibleCounts) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    // No page of buildings, and a page of words whose word has building 5 of 2^64 - 1.
    const std::string page("\0\1a\1\5", 5);
    std::string words("svtwords\1\0\0\0\0\1\0\0", 16);
    words += page;
    const std::uint64_t fenceAt = words.size();
    std::string fence("\0\1\5", 3);
    appendBytes(fence, idHash(page));
    fence += std::string("\1a", 2);
    words += fence;
    test::writeText(folder / "city/words.bin", words);
    auto json = nlohmann::ordered_json::parse(bytes("city.json"));
    for (const std::uint64_t count : {std::uint64_t{6}, ~std::uint64_t{0}}) {
        json["words"]["bytes"] = words.size();
        json["words"]["sha256"] = hexOf(digestOf(words));
        json["words"]["count"] = count;
        json["words"]["fenceAt"] = fenceAt;
        json["words"]["fence"] = fmt::format("{:016x}", idHash(fence));
        test::writeText(folder / "city/city.json", sealedJson(json));
        const auto found = open().search("a", 5);
        ASSERT_FALSE(found) << count;
        EXPECT_EQ(found.error().code(), Code::BadCity);
    }
}

// All words of all tiles, read without the index.
std::vector<WordsOfBuilding> wordsOfAll(const City& city) {
    std::vector<WordsOfBuilding> all;
    const auto entries = city.find(0, kEverywhere);
    EXPECT_TRUE(entries);
    for (const IndexEntry& entry : *entries) {
        const auto volume = city.read(entry);
        EXPECT_TRUE(volume);
        const auto& labels = volume->labels.labels;
        for (std::uint32_t n = 0; n < labels.size(); ++n)
            if (labels[n].parent == volume::kNoLabel) all.push_back(wordsOfBuilding(volume->labels, n));
    }
    return all;
}

TEST_F(SmallCity, FindsBuildingsByTheirWords) {
    write(folder / "files", samples::CityProfile::Berlin, 4);
    build(plan());
    const City city = open();
    const std::vector<WordsOfBuilding> all = wordsOfAll(city);
    ASSERT_EQ(all.size(), 96u);
    const auto has = [](const WordsOfBuilding& building, std::string_view word, bool isBeginning) {
        return std::any_of(building.words.begin(), building.words.end(),
                           [&](const std::string& own) { return isBeginning ? own.starts_with(word) : own == word; });
    };
    for (const char* query : {"roofType=1000", "1000", "310", "roofType=1000 storeysAboveGround=3", "class=Building 31",
                              "class=Bridge", "Gemeindeschluessel", "nobody"}) {
        std::set<std::string> expected;
        const std::vector<WantedWord> wanted = wantedWords(query);
        for (const WordsOfBuilding& building : all)
            if (std::all_of(wanted.begin(), wanted.end(),
                            [&](const WantedWord& w) { return has(building, w.word, w.isBeginning); }))
                expected.insert(building.id);
        const auto found = city.search(query, 1000);
        ASSERT_TRUE(found) << found.error().toString();
        EXPECT_EQ(found->count, expected.size()) << query;
        std::set<std::string> ids;
        for (const auto& building : found->buildings) ids.insert(building.id);
        EXPECT_EQ(ids, expected) << query;
    }
    const auto few = city.search("31", 5);
    ASSERT_TRUE(few);
    EXPECT_TRUE(few->count > 5 && few->buildings.size() == 5 && few->buildings[0].className == "Building");
    EXPECT_EQ(city.search(" ", 5).error().code(), Code::BadArgument);
}

TEST_F(SmallCity, FindsWordsInBytesThatAreGivenLater) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const auto whole = open().search("roofType=1", 7);
    ASSERT_TRUE(whole);
    CityBytes bytes;
    const auto found = [&] {
        for (int round = 0;; ++round) {
            auto city = City::open(bytes.store(), {});
            auto result = city ? city->search("roofType=1", 7) : Result<City::Found>(city.error());
            const auto wanted = bytes.wanted();
            if (result || wanted.empty() || round > 9) return result;
            for (const CityBytes::Range& range : wanted) {
                const std::string all = this->bytes(range.name.c_str());
                bytes.give(range, all.substr(std::min<std::size_t>(range.offset, all.size()), range.size), all.size());
            }
        }
    }();
    ASSERT_TRUE(found) << found.error().toString();
    EXPECT_EQ(found->count, whole->count);
    ASSERT_EQ(found->buildings.size(), whole->buildings.size());
    EXPECT_EQ(found->buildings[0].id, whole->buildings[0].id);
}

TEST_F(SmallCity, NamesDamageOfTheIndexOfWords) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    const Plan made = plan();
    build(made);
    const std::string good = bytes("words.bin");
    // Bytes of ranges, as on a server: the size is right, and only pages are compared.
    const auto searched = [&](const std::string& spoiled) {
        CityBytes given;
        for (int round = 0; round < 10; ++round) {
            auto city = City::open(given.store(), {});
            auto result = city ? city->search("roofType=1", 96) : Result<City::Found>(city.error());
            const auto wanted = given.wanted();
            if (wanted.empty()) return result;
            for (const CityBytes::Range& range : wanted) {
                const std::string all = range.name == "words.bin" ? spoiled : bytes(range.name.c_str());
                given.give(range, all.substr(std::min<std::size_t>(range.offset, all.size()), range.size), all.size());
            }
        }
        return Result<City::Found>(Error(Code::BadArgument, "no end"));
    };
    const auto count = searched(good);
    ASSERT_TRUE(count);
    int refused = 0;
    for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 400) {
        std::string spoiled = good;
        spoiled[at] = static_cast<char>(spoiled[at] ^ 0x41);
        const auto result = searched(spoiled);
        if (result)
            EXPECT_EQ(result->count, count->count) << at;
        else
            EXPECT_EQ(result.error().code(), Code::BadCity) << at << result.error().toString();
        refused += result ? 0 : 1;
    }
    EXPECT_GT(refused, 50);
    // A folder compares the whole file, and the message says how to mend it.
    test::writeText(folder / "city" / "words.bin", good.substr(1));
    const auto city = City::open(folder / "city");
    ASSERT_FALSE(city);
    EXPECT_EQ(city.error().code(), Code::BadCity);
    ASSERT_TRUE(mergeCity(folder / "city", made));
    EXPECT_TRUE(bytes("words.bin") == good);
}

// A call whose bytes come later names them, and gives the same once they are there.
TEST_F(SmallCity, IsReadFromBytesThatAreGivenLater) {
    write(folder / "files", samples::CityProfile::Berlin, 2);
    build(plan());
    const City city = open();
    const auto files = openStore((folder / "city").string());
    CityBytes bytes;
    int given = 0;
    const auto give = [&](const std::vector<CityBytes::Range>& ranges) {
        for (const CityBytes::Range& range : ranges) {
            EXPECT_NE(range.name, "packs.bin");
            bytes.give(range, *files->read(range.name, range.offset, range.size), *files->size(range.name));
            ++given;
        }
        return !ranges.empty();
    };
    auto opened = City::open(bytes.store(), {});
    while (!opened && give(bytes.wanted())) opened = City::open(bytes.store(), {});
    ASSERT_TRUE(opened) << opened.error().toString();
    EXPECT_EQ(given, 2);  // city.json and the begin of the index
    auto entries = opened->find(0, {-1e9, -1e9, 1e9, 1e9});
    while (!entries && give(bytes.wanted())) entries = opened->find(0, {-1e9, -1e9, 1e9, 1e9});
    ASSERT_TRUE(entries);
    ASSERT_FALSE(entries->empty());
    // All members are asked for together.
    for (const IndexEntry& entry : *entries) EXPECT_FALSE(opened->readBytes(entry));
    EXPECT_TRUE(bytes.isWanting());
    const auto wanted = bytes.wanted();
    EXPECT_EQ(wanted.size(), entries->size());
    EXPECT_FALSE(bytes.isWanting());
    bytes.refuse(wanted.front(), "nobody answers");
    give({wanted.begin() + 1, wanted.end()});
    std::size_t refused = 0;
    for (const IndexEntry& entry : *entries) {
        const auto own = opened->readBytes(entry);
        if (own)
            EXPECT_EQ(*own, *city.readBytes(entry));
        else
            refused += own.error().message().find("nobody answers") != std::string::npos;
    }
    EXPECT_EQ(refused, 1u);
    EXPECT_FALSE(bytes.isWanting());
    bytes.forget();
    EXPECT_FALSE(opened->readBytes(entries->front()));
    EXPECT_TRUE(bytes.isWanting());
}

TEST_F(SmallCity, ExtractsByIdTileAndBox) {
    write(folder / "files", samples::CityProfile::Berlin, 2);
    build(plan());
    const City city = open();
    const auto all = extractVolume(city, {{}, {}, {-1e6, -1e7, -1e3, 1e6, 1e7, 1e4}, true, 0});
    ASSERT_TRUE(all) << all.error().toString();
    std::map<std::string, std::uint64_t> voxels;
    std::uint64_t sum = 0;
    for (std::uint32_t l = 0; l < all->labels.labels.size(); ++l) {
        const volume::Label& label = all->labels.labels[l];
        if (label.parent != volume::kNoLabel) continue;
        std::uint64_t own = 0;
        for (std::uint32_t below = l; below < label.subtreeEnd; ++below) own += all->labels.labels[below].voxels;
        voxels[label.id] = own;
        sum += own;
    }
    EXPECT_EQ(voxels.size(), 96u);
    EXPECT_EQ(sum, voxelsOf(*all));
    for (const auto& [id, own] : voxels) {
        Extract extract;
        extract.ids = {id};
        const auto one = extractVolume(city, extract);
        ASSERT_TRUE(one) << one.error().toString();
        EXPECT_GE(voxelsOf(*one), own) << id;  // where two tiles fill a sample, the first has it
        EXPECT_LT(one->grid.dimension().x, 60);
    }
    std::uint64_t ofTiles = 0;
    const auto entries = city.find(0, {-1e9, -1e9, 1e9, 1e9});
    for (const IndexEntry& entry : *entries) {
        Extract extract;
        extract.tiles = {entry.tile};
        const auto tile = extractVolume(city, extract);
        ASSERT_TRUE(tile);
        ofTiles += voxelsOf(*tile);
    }
    EXPECT_GE(ofTiles, sum);
    EXPECT_LE(double(ofTiles), double(sum) * 1.01);
    Extract nobody;
    nobody.ids = {"nobody"};
    EXPECT_EQ(extractVolume(city, nobody).error().code(), Code::NothingSelected);
}

TEST_F(SmallCity, IsTheSameWheneverItIsBuilt) {
    write(folder / "files", samples::CityProfile::Plateau, 2);
    const Plan made = plan();
    build(made);
    const std::string pack = bytes("packs/00000.svtp"), index = bytes("index.bin"), ids = bytes("ids.bin"),
                      json = bytes("city.json");
    std::filesystem::remove_all(folder / "city" / "packs");
    build(made);
    EXPECT_EQ(bytes("packs/00000.svtp"), pack);
    EXPECT_EQ(bytes("index.bin"), index);
    EXPECT_EQ(bytes("ids.bin"), ids);
    EXPECT_EQ(bytes("city.json"), json);
}

TEST_F(SmallCity, SkipsWhatIsProvenAndRepairsWhatIsNot) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    const Plan made = plan();
    build(made);
    const std::string good = bytes("packs/00000.svtp");
    const auto written = std::filesystem::last_write_time(folder / "city" / "packs/00000.svtp");
    ASSERT_TRUE(runPack(folder / "city", made, 0, {}));
    EXPECT_EQ(std::filesystem::last_write_time(folder / "city" / "packs/00000.svtp"), written);
    std::string damaged = good;
    damaged[damaged.size() / 2] ^= 1;
    test::writeText(folder / "city" / "packs/00000.svtp", damaged);
    EXPECT_EQ(cityStatus(folder / "city", made, false).missing.size(), 0u);
    EXPECT_EQ(cityStatus(folder / "city", made, true).missing.size(), 1u);
    ASSERT_TRUE(runPack(folder / "city", made, 0, {}));
    EXPECT_EQ(bytes("packs/00000.svtp"), good);
}

// A feature that crashes, one that hangs: both are left out and named, all others are there.
TEST_F(SmallCity, LeavesOutFeaturesThatCrashOrHang) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    const Plan made = plan();
    PackOptions options;
    options.tileSeconds = 5;
    options.featureSeconds = 5;  // of which any other feature needs a thousandth
    options.beforeFeature = [](std::string_view text) {
        if (text.find("BLDG_0000000300000011\"") != std::string_view::npos) std::raise(SIGKILL);
        while (text.find("BLDG_0000000300000021\"") != std::string_view::npos)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    };
    build(made, options);
    const CityStatus status = cityStatus(folder / "city", made, true);
    ASSERT_EQ(status.skipped.size(), 2u);
    std::string reasons = status.skipped[0].reason + status.skipped[1].reason;
    EXPECT_NE(reasons.find("signal 9"), std::string::npos) << reasons;
    EXPECT_NE(reasons.find("took too long"), std::string::npos) << reasons;
    EXPECT_EQ(status.buildings, 94u);
    EXPECT_EQ(open().find("BLDG_0000000300000011")->size(), 0u);
    EXPECT_EQ(open().find("BLDG_0000000300000012")->size(), 1u);
}

TEST_F(SmallCity, NoticesFilesThatHaveChanged) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    const Plan made = plan();
    const std::filesystem::path file = folder / "files" / "00000.city.jsonl";
    std::string text = test::readText(file);
    text[text.size() - 20] = text[text.size() - 20] == '1' ? '2' : '1';
    test::writeText(file, text);
    EXPECT_EQ(runPack(folder / "city", made, 0, {}).error().code(), Code::InputChanged);
    test::writeText(file, text + " ");
    EXPECT_EQ(runPack(folder / "city", made, 0, {}).error().code(), Code::InputChanged);
}

TEST_F(SmallCity, RefusesPlansOfOthers) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    plan();
    EXPECT_TRUE(readPlan(folder / "city", "test"));
    EXPECT_EQ(readPlan(folder / "city", "other").error().code(), Code::PlanVersion);
    EXPECT_EQ(readPlan(folder / "files", "test").error().code(), Code::BadPlan);
    const std::string tiles = bytes("plan/tiles.bin"), json = bytes("plan/plan.json");
    test::writeText(folder / "city/plan/tiles.bin", tiles.substr(1));
    EXPECT_EQ(readPlan(folder / "city", "test").error().code(), Code::BadPlan);
    std::string changed = tiles;
    changed[32] ^= 1;  // the cost of a tile
    test::writeText(folder / "city/plan/tiles.bin", changed);
    EXPECT_EQ(readPlan(folder / "city", "test").error().code(), Code::BadPlan);
    test::writeText(folder / "city/plan/tiles.bin", tiles);
    test::writeText(folder / "city/plan/plan.json", json.substr(0, json.size() / 2));
    EXPECT_EQ(readPlan(folder / "city", "test").error().code(), Code::BadPlan);
}

CameraView lookingDown(const Box3d& box, double pixels) {
    CameraView view;
    view.isPerspective = false;
    view.eye = {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, box.max.z + 10};
    view.forward = {0, 0, -1};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.halfWidth = view.halfHeight = std::max(box.max.x - box.min.x, box.max.y - box.min.y) / 2 + 1;
    view.pixel = 2 * view.halfHeight / pixels;
    return view;
}

TEST_F(SmallCity, IsSeenAtTheDetailOfAPixel) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const City city = open();
    ASSERT_GE(city.topDetail(), 2);
    for (int detail = 0; detail <= city.topDetail(); ++detail) {
        const double voxel = spacingOf(detail, city.spacing()).x;
        CameraView view = lookingDown(city.box(), 1);
        view.pixel = 1.01 * voxel;
        const auto chosen = chooseTiles(city, view, 1'000'000'000);
        ASSERT_TRUE(chosen);
        const auto all = city.find(detail, {-1e300, -1e300, 1e300, 1e300});
        ASSERT_TRUE(all);
        ASSERT_EQ(chosen->entries.size(), all->size()) << "detail " << detail;
        for (const IndexEntry& entry : chosen->entries) EXPECT_EQ(entry.detail, detail);
        const auto volumes = readTiles(city, *chosen);
        ASSERT_TRUE(volumes) << volumes.error().toString();
        ASSERT_EQ(volumes->size(), 1u);
        const auto extracted = extractVolume(city, {{},
                                                    {},
                                                    {city.box().min.x, city.box().min.y, city.box().min.z,
                                                     city.box().max.x, city.box().max.y, city.box().max.z},
                                                    true,
                                                    detail});
        ASSERT_TRUE(extracted) << extracted.error().toString();
        EXPECT_EQ(voxelsOf(volumes->front()), voxelsOf(*extracted)) << "detail " << detail;
    }
}

TEST_F(SmallCity, IsReadOnlyWhereItIsSeen) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const City city = open();
    CameraView view = lookingDown(city.box(), 100);
    view.forward = {0, 0, 1};
    auto chosen = chooseTiles(city, view, 1'000'000'000);
    ASSERT_TRUE(chosen);
    EXPECT_TRUE(chosen->entries.empty()) << "looking into the sky";
    view.forward = {0, 0, -1};
    view.eye.x += 1e5;
    chosen = chooseTiles(city, view, 1'000'000'000);
    ASSERT_TRUE(chosen);
    EXPECT_TRUE(chosen->entries.empty()) << "looking elsewhere";
    // The sun in the east throws shadows to the west.
    view.eye.x = city.box().min.x - view.halfWidth - 60;
    view.towardsLight = normalized(Vec3d{1, 0, 0.05});
    chosen = chooseTiles(city, view, 1'000'000'000);
    ASSERT_TRUE(chosen);
    EXPECT_FALSE(chosen->entries.empty());
}

TEST_F(SmallCity, GrowsCoarserWhereMemoryIsShort) {
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const City city = open();
    CameraView view = lookingDown(city.box(), 1);
    view.pixel = 1.01 * city.spacing();
    const auto all = chooseTiles(city, view, 1'000'000'000);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->pixels, 1);
    const auto less = chooseTiles(city, view, kBytesAByte * (all->bytes - 1));
    ASSERT_TRUE(less);
    EXPECT_LT(less->bytes, all->bytes);
    EXPECT_GT(less->pixels, 1);
    EXPECT_FALSE(less->entries.empty());
    const auto least = chooseTiles(city, view, 1);
    ASSERT_TRUE(least);
    ASSERT_EQ(least->entries.size(), 1u) << "the top tile is always there";
    EXPECT_EQ(least->entries.front().detail, city.topDetail());
}

// Any changed byte of an index or a pack is an error with a name, or changes nothing.
TEST_F(SmallCity, NamesDamage) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    build(plan());
    const auto ask = [&]() -> std::string {
        const auto city = City::open(folder / "city");
        if (!city) return city.error().toString();
        const auto volume = extractVolume(*city, {{}, {"NL.IMBAG.Pand.0000030000000005"}, {}, false, 0});
        return volume ? "good " + std::to_string(voxelsOf(*volume)) : volume.error().toString();
    };
    const std::string good = ask();
    ASSERT_TRUE(good.starts_with("good")) << good;
    for (const std::string name : {"index.bin", "ids.bin", "packs.bin", "city.json", "packs/00000.svtp"}) {
        const bool isPack = name.starts_with("packs/");
        const std::string text = bytes(name.c_str());
        int named = 0;
        const auto expectNamed = [&](const std::string& damaged, const std::string& what) {
            test::writeText(folder / "city" / name, damaged);
            const std::string answer = ask();
            if (answer != good) ++named;
            // Members of a pack that nobody asks for are not read.
            if (isPack && answer == good) return;
            EXPECT_NE(answer.find(name), std::string::npos) << what << ": " << answer;
            EXPECT_NE(answer.find("merge"), std::string::npos) << what << ": " << answer;
        };
        for (std::size_t at = 0; at < text.size(); at += std::max<std::size_t>(1, text.size() / 60)) {
            std::string damaged = text;
            damaged[at] ^= 0x55;
            expectNamed(damaged, name + " byte " + std::to_string(at));
            expectNamed(text.substr(0, at), name + " cut at " + std::to_string(at));
        }
        if (!isPack)
            for (const char* more : {"x", " ", "\n{}"}) expectNamed(text + more, name + " with more bytes");
        EXPECT_GT(named, 0) << name;
        std::filesystem::remove(folder / "city" / name);
        EXPECT_FALSE(ask().starts_with("good")) << name << " is gone";
        test::writeText(folder / "city" / name, text);
    }
    EXPECT_EQ(ask(), good);
}

TEST_F(SmallCity, NamesFilesOfAnotherMerge) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    build(plan());
    const std::vector<std::string> names{"city.json", "index.bin", "ids.bin", "words.bin", "packs.bin"};
    std::map<std::string, std::string> first;
    for (const std::string& name : names) first[name] = bytes(name.c_str());
    std::filesystem::remove_all(folder / "city");
    build(plan(2));
    for (const std::string& name : names) {
        const std::string second = bytes(name.c_str());
        if (second == first[name]) continue;
        test::writeText(folder / "city" / name, first[name]);
        const auto city = City::open(folder / "city");
        ASSERT_FALSE(city) << name;
        EXPECT_EQ(city.error().code(), Code::BadCity);
        test::writeText(folder / "city" / name, second);
    }
    EXPECT_TRUE(City::open(folder / "city"));
}

// A page has only ranges: the root and the fence are those that city.json names.
TEST_F(SmallCity, NamesFilesOfAnotherMergeByRangesAlone) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    build(plan());
    const std::string oldIndex = bytes("index.bin"), oldIds = bytes("ids.bin");
    std::filesystem::remove_all(folder / "city");
    std::filesystem::remove_all(folder / "files");
    write(folder / "files", samples::CityProfile::Berlin, 1);
    build(plan());
    const std::string newIndex = bytes("index.bin");
    const auto openByRanges = [&]() -> Result<std::vector<City::Place>> {
        const auto files = openStore((folder / "city").string());
        CityBytes given;
        const auto give = [&] {
            const auto ranges = given.wanted();
            for (const CityBytes::Range& range : ranges)
                given.give(range, *files->read(range.name, range.offset, range.size), *files->size(range.name));
            return !ranges.empty();
        };
        auto city = City::open(given.store(), {});
        while (!city && give()) city = City::open(given.store(), {});
        if (!city) return city.error();
        auto found = city->find("BLDG_0000000300000012");
        while (!found && give()) found = city->find("BLDG_0000000300000012");
        return found;
    };
    const auto good = openByRanges();
    ASSERT_TRUE(good) << good.error().toString();
    EXPECT_EQ(good->size(), 1u);
    test::writeText(folder / "city/index.bin", oldIndex);
    EXPECT_EQ(openByRanges().error().code(), Code::BadCity);
    test::writeText(folder / "city/index.bin", newIndex);
    test::writeText(folder / "city/ids.bin", oldIds);
    const auto damaged = openByRanges();
    ASSERT_FALSE(damaged);
    EXPECT_NE(damaged.error().message().find("another merge"), std::string::npos) << damaged.error().message();
}

TEST_F(SmallCity, ReadsCitiesOfEarlierProgramsWhichTellNoDigests) {
    write(folder / "files", samples::CityProfile::Dutch, 1);
    build(plan());
    std::string json = bytes("city.json");
    const std::size_t digest = json.find(",\n \"digest\"");
    ASSERT_NE(digest, std::string::npos);
    json.erase(digest, json.find('\n', digest + 2) - digest);
    for (std::size_t at = 0; (at = json.find("\"sha256\"", at)) != std::string::npos;)
        json.replace(at, 8, "\"unused\"");
    test::writeText(folder / "city/city.json", json);
    const City city = open();
    EXPECT_EQ(city.buildings(), 96u);
    EXPECT_EQ(city.find("NL.IMBAG.Pand.0000030000000005")->size(), 1u);
    const auto found = city.search("Pand", 1);
    ASSERT_FALSE(found);
    EXPECT_TRUE(found.error().code() == Code::BadCity &&
                found.error().message().find("svt city merge") != std::string::npos);
}

TEST(CityInputs, AreAllFilesThatReadersTake) {
    const test::TemporaryFolder folder;
    std::vector<std::string> taken{"c.CityJSON"};
    for (const std::string_view ending : readers::modelEndings()) {
        taken.push_back("a" + std::string(ending));
        taken.push_back("b" + std::string(ending) + ".gz");
    }
    ASSERT_EQ(taken.size(), 17u);
    for (const std::string& name : taken) test::writeText(folder / name, "");
    for (const char* name : {"readme.txt", "e.zip", "gml", "f.gml.zip", "g.gz"}) test::writeText(folder / name, "");
    const std::filesystem::path input = folder.path();
    const auto files = cityInputs(std::span(&input, 1));
    ASSERT_TRUE(files) << files.error().toString();
    std::vector<std::string> names;
    for (const std::filesystem::path& file : *files) names.push_back(file.filename().string());
    std::sort(names.begin(), names.end());
    std::sort(taken.begin(), taken.end());
    EXPECT_EQ(names, taken);
}

}  // namespace
}  // namespace svt::city
