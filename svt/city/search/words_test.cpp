// Words of buildings, and the index that finds buildings by them: against a search through all words.
#include <svt/city/base/sha256.hpp>
#include <svt/city/search/words_file.hpp>
#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace svt::city {
namespace {

using Words = std::vector<std::string>;

volume::Label labelOf(std::string className, std::uint32_t end, std::vector<Attribute> attributes = {}) {
    volume::Label label;
    label.className = std::move(className);
    label.subtreeEnd = end;
    label.attributes = std::move(attributes);
    return label;
}

TEST(Words, AreThoseOfNamesAndAttributesOfABuildingAndItsParts) {
    volume::LabelTable table;
    table.labels = {labelOf("Building", 4,
                            {{"address/Street", std::string("Äußere  Hauptstraße")},
                             {"yearOfConstruction", std::int64_t{1965}},
                             {"measuredHeight", 9.53},
                             {"storeys", 4.0},
                             {"isListed", true},
                             {"note", std::string("")}}),
                    labelOf("WallSurface", 2, {{"material", std::string("brick")}}),
                    labelOf("BuildingPart", 3, {{"roofType", std::string("gabled 12-b")}}),
                    labelOf("BuildingRoom", 4, {{"use", std::string("kitchen")}})};
    table.labels[0].id = "B1";
    table.labels[0].name = "Rathaus (alt)";
    const WordsOfBuilding building = wordsOfBuilding(table, 0);
    EXPECT_EQ(building.id, "B1");
    EXPECT_EQ(building.name, "Rathaus (alt)");
    EXPECT_EQ(building.address, "Äußere  Hauptstraße");
    EXPECT_EQ(building.words, (Words{"12", "1965", "4", "alt", "b", "class=building", "gabled", "hauptstraße",
                                     "islisted=true", "name=rathaus (alt)", "rathaus", "rooftype=gabled 12-b",
                                     "storeys=4", "street=äußere hauptstraße", "yearofconstruction=1965", "äußere"}));
}

TEST(Words, OfLongTextsAreCutBeforeACharacter) {
    volume::LabelTable table;
    table.labels = {labelOf("Building", 1)};
    for (int n = 0; n < 100; ++n) table.labels[0].name += "ß";
    const Words words = wordsOfBuilding(table, 0).words;
    EXPECT_TRUE(std::count_if(words.begin(), words.end(), [](const std::string& word) { return word.size() == 64; }));
    EXPECT_TRUE(std::all_of(words.begin(), words.end(), [](const std::string& word) { return word.size() <= 64; }));
}

TEST(Words, OfAQueryAreWholeButTheLast) {
    const auto textOf = [](std::string_view query) {
        std::string text;
        for (const auto& [word, isBeginning] : wantedWords(query)) text += word + (isBeginning ? "* " : " ");
        return text;
    };
    EXPECT_EQ(textOf("Main Road"), "main road* ");
    EXPECT_EQ(textOf("Main Road "), "main road ");
    EXPECT_EQ(textOf("  street=\"Main  Road\" 12"), "street=main road 12* ");
    EXPECT_EQ(textOf("\"street=Main Road\""), "street=main road ");
    EXPECT_EQ(textOf("yearOfConstruction=19"), "yearofconstruction=19* ");
    EXPECT_EQ(textOf("St.-Martin"), "st martin* ");
    EXPECT_EQ(textOf("=x"), "x* ");
    EXPECT_EQ(textOf(" .,; "), "");
    EXPECT_EQ(textOf("\"open"), "open ");
}

// Buildings with words that many, few, or one of them has.
std::vector<WordsOfBuilding> someBuildings(std::uint32_t count) {
    std::vector<WordsOfBuilding> buildings;
    for (std::uint32_t n = 0; n < count; ++n) {
        std::set<std::string> words{"all", "n=" + std::to_string(n), "third" + std::to_string(n % 3)};
        if (n * 2654435761u % 97 < 5) words.insert("rare");
        words.insert(std::string(1 + n % 40, static_cast<char>('a' + n % 26)));
        buildings.push_back({"id-" + std::to_string(n),
                             n % 2 ? "Name " + std::to_string(n) : "",
                             "Building",
                             n % 5 ? "Road " + std::to_string(n / 9) : "",
                             {words.begin(), words.end()}});
    }
    return buildings;
}

TEST(WordsFile, HasEachWordWithItsBuildingsHoweverLittleMemoryItGets) {
    const test::TemporaryFolder folder;
    const std::vector<WordsOfBuilding> buildings = someBuildings(3000);
    std::map<std::string, std::vector<std::uint32_t>> expected;
    for (std::uint32_t n = 0; n < buildings.size(); ++n)
        for (const std::string& word : buildings[n].words) expected[word].push_back(n);
    std::string first;
    for (const std::size_t memory : {std::size_t{1} << 30, std::size_t{200'000}, std::size_t{20'000}}) {
        auto writer = WordsWriter::create(folder / "words.bin", memory);
        ASSERT_TRUE(writer);
        for (const WordsOfBuilding& building : buildings) ASSERT_TRUE(writer->add(building));
        const auto proof = writer->finish();
        ASSERT_TRUE(proof) << proof.error().toString();
        const std::string bytes = test::readText(folder / "words.bin");
        EXPECT_EQ(proof->bytes, bytes.size());
        EXPECT_EQ(proof->count, buildings.size());
        EXPECT_EQ(proof->sha256, hexOf(digestOf(bytes)));
        if (first.empty()) first = bytes;
        EXPECT_TRUE(bytes == first) << memory;
        const auto fence = takeFence(std::string_view(bytes).substr(proof->fenceAt), proof->fenceAt);
        ASSERT_TRUE(fence);
        std::map<std::string, std::vector<std::uint32_t>> read;
        for (const WordsPage& page : fence->words) {
            const std::string_view own = std::string_view(bytes).substr(page.offset, page.size);
            EXPECT_EQ(idHash(own), page.checksum);
            const auto rows = takeWords(own, proof->count);
            ASSERT_TRUE(rows);
            EXPECT_EQ(rows->front().word, page.first);
            for (const WordRow& row : *rows) EXPECT_TRUE(read.emplace(row.word, row.buildings).second) << row.word;
        }
        EXPECT_TRUE(read == expected);
        std::vector<WordsOfBuilding> listed;
        for (const WordsPage& page : fence->buildings) {
            const auto rows = takeBuildings(std::string_view(bytes).substr(page.offset, page.size));
            ASSERT_TRUE(rows);
            listed.insert(listed.end(), rows->begin(), rows->end());
        }
        ASSERT_EQ(listed.size(), buildings.size());
        for (std::size_t n = 0; n < listed.size(); ++n)
            EXPECT_TRUE(listed[n].id == buildings[n].id && listed[n].name == buildings[n].name &&
                        listed[n].address == buildings[n].address);
    }
}

TEST(WordsFile, RefusesPagesThatCannotBe) {
    const auto isRefused = [](std::string page) { return !takeWords(page, 10); };
    EXPECT_TRUE(takeWords(std::string("\0\1a\1\3", 5), 10));
    EXPECT_TRUE(isRefused(std::string("\1\1a\1\3", 5))) << "shares a byte with no word";
    EXPECT_TRUE(isRefused(std::string("\0\1a\1\12", 5))) << "the eleventh building of ten";
    EXPECT_TRUE(isRefused(std::string("\0\1a\2\3\0", 6))) << "a building twice";
    EXPECT_TRUE(isRefused(std::string("\0\1a\5\3", 5))) << "fewer buildings than stated";
    EXPECT_TRUE(isRefused(std::string("\0\177a", 3))) << "a word that is too long";
    EXPECT_FALSE(takeBuildings(std::string("\377\377\377\177", 4))) << "a page of 256 MB";
    EXPECT_FALSE(takeBuildings("\3abc"));
    EXPECT_FALSE(takeFence("\1", 100));
    EXPECT_FALSE(takeFence(std::string("\0\0", 2), 15));
    EXPECT_TRUE(takeFence(std::string("\0\0", 2), kWordsHead));
}

TEST(WordsFile, OfNoBuildingsIsAFile) {
    const test::TemporaryFolder folder;
    auto writer = WordsWriter::create(folder / "words.bin");
    ASSERT_TRUE(writer);
    const auto proof = writer->finish();
    ASSERT_TRUE(proof);
    EXPECT_EQ(proof->count, 0u);
    const std::string bytes = test::readText(folder / "words.bin");
    EXPECT_TRUE(takeFence(std::string_view(bytes).substr(proof->fenceAt), proof->fenceAt));
}

}  // namespace
}  // namespace svt::city
