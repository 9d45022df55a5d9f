#include <svt/analyze/owners.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace svt::analyze {
namespace {

using volume::kNoLabel;

// Two rooms of 10 x 20 x 30 voxels, a wall of 4 voxels between them, and below all a slab of 3 voxels under a third
// room, of half the width. Spacing 0.5 m.
//
//        a (10) | wall (4) | b (10)
//        ------- slab (24 x 20 x 3) -------
//        c (12)            nothing
volume::SemanticVolume threeRooms() {
    volume::SemanticVolume volume = volume::test::emptyVolume({24, 20, 43}, {0.5, 0.5, 0.5});
    volume::test::addObject(volume, "a", "BuildingRoom");
    volume::test::addObject(volume, "b", "BuildingRoom");
    volume::test::addObject(volume, "b-sheet", "InteriorWallSurface", 1);
    volume::test::addObject(volume, "c", "BuildingRoom");
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement");
    volume::test::addObject(volume, "slab", "BuildingConstructiveElement");
    volume::test::addGroup(volume, "flat", "BuildingUnit");
    volume.labels.labels[0].groups = {6};
    volume::test::paint(volume, [](int i, int, int k) {
        return k < 10 ? (i < 12 ? 4 : 0) : k < 13 ? 6 : i < 10 ? 1 : i < 14 ? 5 : i < 15 ? 3 : 2;
    });
    for (volume::Label& label : volume.labels.labels) {
        label.filling = volume::Filling::Solid;
        label.volume = double(label.voxels) * 0.125;
    }
    volume.labels.labels[2].filling = volume::Filling::Surface;
    volume.labels.labels[2].volume = 0;
    return volume;
}

Ownership divide(const volume::SemanticVolume& volume, const char* text) {
    const auto table = parseOwners(text, "t.csv", volume.labels);
    EXPECT_TRUE(table) << table.error().toString();
    if (!table) return {};
    return divideByOwners(volume, findContacts(volume.columns, volume.grid, volume.labels, 1), *table);
}

TEST(Owners, TheWallBetweenTwoIsHalfEachOnes) {
    const auto volume = threeRooms();
    const Ownership result = divide(volume, "feature,owner\na,Ada\nb,Bob\nc,Cid\n");
    ASSERT_EQ(result.components.size(), 2u);
    const DividedComponent& wall = result.components[0];
    EXPECT_EQ(wall.label, 4u);
    // 20 x 30 faces of 0.25 m2 on each side; 4 x 20 x 30 voxels of 0.125 m3. Bob's sheet is Bob's.
    EXPECT_EQ(wall.shares, (std::vector<OwnerShare>{{0, 150, 150}, {1, 150, 150}}));
    EXPECT_DOUBLE_EQ(result.owners[0].own, 10 * 20 * 30 * 0.125);
    EXPECT_DOUBLE_EQ(result.owners[1].own, 9 * 20 * 30 * 0.125);
}

TEST(Owners, TheSlabIsDividedByContact) {
    const auto volume = threeRooms();
    const Ownership result = divide(volume, "a,Ada\nb,Bob\nc,Cid\n");
    const DividedComponent& slab = result.components[1];
    EXPECT_EQ(slab.label, 5u);
    // 200 and 200 faces from above, 240 from below; 1440 voxels, 180 m3.
    ASSERT_EQ(slab.shares.size(), 3u);
    EXPECT_DOUBLE_EQ(slab.shares[0].area, 50);
    EXPECT_DOUBLE_EQ(slab.shares[2].area, 60);
    EXPECT_DOUBLE_EQ(slab.shares[0].volume, 180 * 50.0 / 160);
    EXPECT_DOUBLE_EQ(slab.shares[2].volume, 180 * 60.0 / 160);
    const OwnerTotal& ada = result.owners[0];
    EXPECT_DOUBLE_EQ(ada.shared, 150 + 56.25);
    EXPECT_DOUBLE_EQ(ada.alone, 0);
    // With Bob the wall and the slab, with Cid only the slab.
    EXPECT_EQ(ada.with, (std::vector<OwnerShare>{{1, 200, 206.25}, {2, 50, 56.25}}));
    double sum = 0;
    for (const OwnerTotal& total : result.owners) sum += total.own + total.alone + total.shared;
    EXPECT_NEAR(sum + result.unowned + result.untouched, (24 * 20 * 33 + 12 * 20 * 10 - 20 * 30) * 0.125, 1e-9);
}

TEST(Owners, SpacesThatAreNotNamedAreUnowned) {
    const auto volume = threeRooms();
    const Ownership result = divide(volume, "a,Ada\n");
    EXPECT_EQ(result.components[0].shares, (std::vector<OwnerShare>{{0, 150, 150}, {kNoOwner, 150, 150}}));
    EXPECT_NEAR(result.unowned, 150 + 180 * 110.0 / 160, 1e-9);
    EXPECT_EQ(result.untouched, 0);
    // All rooms of one owner: nothing is shared.
    const Ownership one = divide(volume, "class=BuildingRoom,Ada\n");
    EXPECT_DOUBLE_EQ(one.owners[0].alone, 300 + 180);
    EXPECT_DOUBLE_EQ(one.owners[0].shared, 0);
}

TEST(Owners, AComponentMayBeNamed) {
    const auto volume = threeRooms();
    const Ownership result = divide(volume, "a,Ada\nb,Bob\nwall,Ada");
    EXPECT_DOUBLE_EQ(result.owners[0].own, 750 + 300);
    ASSERT_EQ(result.components.size(), 1u);
}

TEST(Owners, AFlatStandsForItsRoomsAndQueriesForWhatTheySelect) {
    const auto volume = threeRooms();
    const auto table = parseOwners(
        "\xEF\xBB\xBF"
        "Feature;Owner\r\n flat ; \"Ada; \"\"Augusta\"\"\" \r\n\r\n\"id=\"\"b\"\"\";Bob",
        "t.csv", volume.labels);
    ASSERT_TRUE(table) << table.error().toString();
    EXPECT_EQ(table->names, (std::vector<std::string>{"Ada; \"Augusta\"", "Bob"}));
    using Fractions = std::vector<OwnerFraction>;
    EXPECT_EQ(table->ofLabel, (std::vector<Fractions>{{{0, 1}}, {{1, 1}}, {{1, 1}}, {}, {}, {}, {{0, 1}}}));
    ASSERT_EQ(table->features.size(), 2u);
    EXPECT_EQ(table->features[0].label, 1u);
    EXPECT_EQ(table->features[1].parts, (std::vector<std::uint32_t>{0, 6}));
    EXPECT_TRUE(table->shared.empty());
}

TEST(Owners, SharesDivideAFeatureAndTheWallsAroundIt) {
    const auto volume = threeRooms();
    const Ownership result = divide(volume, "feature,owner,share\na,Ada,1/4\na,Bob,75 %\nb,Bob\nc,Cid,0.5\n");
    // Rooms of 750 and 675 m3; the third one has 300 m3, of which half has no owner.
    EXPECT_DOUBLE_EQ(result.owners[0].own, 750 / 4.0);
    EXPECT_DOUBLE_EQ(result.owners[1].own, 750 * 0.75 + 675);
    EXPECT_DOUBLE_EQ(result.owners[2].own, 150);
    EXPECT_DOUBLE_EQ(result.unownedSpaces, 150);
    // 150 m2 of the wall on each side.
    EXPECT_EQ(result.components[0].shares, (std::vector<OwnerShare>{{0, 37.5, 37.5}, {1, 262.5, 262.5}}));
    ASSERT_EQ(result.ofFeature.size(), 3u);
    EXPECT_DOUBLE_EQ(result.ofFeature[0], 750);
    double sum = result.unowned + result.untouched + result.unownedSpaces;
    for (const OwnerTotal& total : result.owners) sum += total.own + total.alone + total.shared;
    EXPECT_NEAR(sum, result.all, 1e-9);
}

TEST(Owners, AWallOfOneFlatIsNotSharedByItsOwners) {
    const auto volume = threeRooms();
    // Both rooms beside the wall have the same two owners.
    const Ownership result = divide(volume, "a,Ada,1/2\na,Bob,1/2\nb,Ada,1/2\nb,Bob,1/2\n");
    EXPECT_DOUBLE_EQ(result.owners[0].alone, 150);
    EXPECT_DOUBLE_EQ(result.owners[0].shared, 180 * 50.0 / 160) << "the slab touches a third room";
}

TEST(Owners, SpaceOfSeveralFeaturesCountsOnceAndTheFinerFeatureDecides) {
    volume::SemanticVolume volume = threeRooms();
    volume::test::addGroup(volume, "other", "BuildingUnit");
    volume::test::addGroup(volume, "house", "CityObjectGroup");
    auto& labels = volume.labels.labels;
    labels[0].groups = {6, 7};  // a cellar of both flats
    labels[1].groups = {7};
    labels[6].groups = {8};
    labels[7].groups = {8};
    labels[4].groups = {8};
    const char* const table = "flat,Ada\nother,Bob\nhouse,all\nb,Cid\n";
    const auto parsed = parseOwners(table, "t.csv", volume.labels);
    ASSERT_TRUE(parsed);
    EXPECT_EQ(parsed->shared, (std::vector<std::uint32_t>{0}));
    const Ownership result = divide(volume, table);
    EXPECT_DOUBLE_EQ(result.owners[0].own, 375) << "half of the cellar";
    EXPECT_DOUBLE_EQ(result.owners[1].own, 375) << "the other half; the finer row gives room b to Cid";
    EXPECT_DOUBLE_EQ(result.owners[2].own, 300) << "the wall is a member of the house only";
    EXPECT_DOUBLE_EQ(result.owners[3].own, 675);
    EXPECT_DOUBLE_EQ(result.shared, 750);
    double sum = result.unowned + result.untouched + result.unownedSpaces;
    for (const OwnerTotal& total : result.owners) sum += total.own + total.alone + total.shared;
    EXPECT_NEAR(sum, result.all, 1e-9);
}

TEST(Owners, CommonPropertyIsByStoreyAndBuilding) {
    volume::SemanticVolume volume = volume::test::emptyVolume({8, 8, 8}, {1, 1, 1});
    volume::test::addGroup(volume, "house", "Building");
    volume::test::addGroup(volume, "low", "Storey", 0);
    volume::test::addObject(volume, "flat", "BuildingUnit", 1);
    volume::test::addObject(volume, "hall", "BuildingRoom", 1);
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement", 1);
    volume::test::addGroup(volume, "high", "Storey", 0);
    volume::test::addObject(volume, "slab", "BuildingConstructiveElement", 5);
    volume::test::addObject(volume, "roof", "RoofSurface", 0);
    volume.labels.labels[7].filling = volume::Filling::Body;
    volume.labels.labels[6].groups = {1};
    volume::test::paint(volume, [](int i, int, int k) { return k < 4 ? (i < 4 ? 1 : i < 6 ? 2 : 3) : k < 6 ? 4 : 5; });
    const Ownership result = divide(volume, "flat,Ada");
    ASSERT_EQ(result.common.size(), 2u);
    EXPECT_EQ(result.common[0].building, 0u);
    EXPECT_EQ(result.common[0].storey, 1u);
    EXPECT_DOUBLE_EQ(result.common[0].spaces, 2 * 8 * 4);
    EXPECT_DOUBLE_EQ(result.common[0].components, 2 * 8 * 4);
    EXPECT_EQ(result.common[1].building, 0u);
    EXPECT_EQ(result.common[1].storey, kNoLabel) << "the slab is in both storeys, the roof in none";
    EXPECT_DOUBLE_EQ(result.common[1].components, 8 * 8 * 4);
    double common = 0;
    for (const CommonProperty& property : result.common) common += property.spaces + property.components;
    EXPECT_NEAR(common + result.ofFeature[0], result.all, 1e-9);
}

TEST(Owners, RightsOtherThanOwnershipAreKeptApart) {
    const auto volume = threeRooms();
    const auto table = parseOwners(
        "source,owner,right,feature,share\n"
        "deed 7,Ada,,a,1/3\ndeed 8,Ada,ownership,a,1/6\n,Bob,Ownership,a,1/2\n"
        "deed 9,Bank,mortgage,a\n,Bank,mortgage,b\n,Cid,lease,a,1/4\n,Dora,lease,a,1\n,City,Monument Maintenance,b,\n",
        "t.csv", volume.labels);
    ASSERT_TRUE(table) << table.error().toString();
    EXPECT_EQ(table->names, (std::vector<std::string>{"Ada", "Bob"})) << "owners only";
    EXPECT_EQ(table->parties, (std::vector<std::string>{"Ada", "Bob", "Bank", "Cid", "Dora", "City"}));
    EXPECT_EQ(table->sources, (std::vector<std::string>{"", "deed 7", "deed 8", "deed 9"}));
    ASSERT_EQ(table->features.size(), 1u) << "nobody owns room b";
    ASSERT_EQ(table->features[0].owners.size(), 2u);
    EXPECT_DOUBLE_EQ(table->features[0].owners[0].fraction, 0.5);
    ASSERT_EQ(table->rights.size(), 8u);
    const auto typeOf = [&](std::size_t n) { return rightTypes()[table->rights[n].type].name; };
    EXPECT_EQ(typeOf(2), "ownership");
    EXPECT_EQ(typeOf(3), "lease");
    EXPECT_EQ(table->rights[3].fraction, 0.25) << "leases add up to more than 1";
    EXPECT_EQ(typeOf(5), "mortgage");
    EXPECT_EQ(table->rights[5].fraction, std::nullopt);
    EXPECT_EQ(table->sources[table->rights[5].source], "deed 9");
    EXPECT_EQ(typeOf(7), "monument maintenance");
    EXPECT_EQ(rightTypes()[table->rights[7].type].of, RightClass::Responsibility);
    const auto errorOf = [&](std::string_view text) {
        const auto wrong = parseOwners(text, "t.csv", volume.labels);
        return wrong ? Error() : wrong.error();
    };
    const Error unknown = errorOf("feature,owner,right\na,Ada,\na,Bob,rent\n");
    EXPECT_EQ(unknown.code(), Code::BadValue);
    EXPECT_EQ(unknown.where().line, 3u);
    for (const char* name : {"'rent'", "lease", "usufruct", "easement", "mortgage", "maintenance"})
        EXPECT_NE(unknown.message().find(name), std::string::npos) << name << unknown.message();
    const Error latin = errorOf("feature,owner\na,M\xfcller\n");
    EXPECT_EQ(latin.where().line, 2u);
    EXPECT_NE(latin.message().find("UTF-8"), std::string::npos) << latin.message();
    EXPECT_NE(errorOf("feature,owner,note\na,Ada,x\n").message().find("'note' is unknown"), std::string::npos);
    EXPECT_NE(errorOf("feature,owner,owner\na,Ada,x\n").message().find("there twice"), std::string::npos);
    EXPECT_EQ(errorOf("feature,owner,right\na,,lease\n").where().line, 2u);
    EXPECT_EQ(errorOf("feature,owner,source\na,Ada,d1\na,Ada,d2\n").where().line, 3u) << "two deeds need shares";
    EXPECT_EQ(errorOf("feature,owner,right\na,Ada,lease,x\n").where().line, 2u);
    EXPECT_EQ(errorOf("feature,owner,share,right\na,Ada,3/2,lease\n").where().line, 2u) << "a share is 1 at most";
}

TEST(Owners, SayWhatIsWrongAndWhere) {
    const auto volume = threeRooms();
    const auto errorOf = [&](std::string_view text) {
        const auto table = parseOwners(text, "t.csv", volume.labels);
        return table ? Error() : table.error();
    };
    struct Case {
        const char* text;
        Code code;
        std::uint64_t line;
    };
    for (const Case& wrong :
         {Case{"", Code::BadValue, 0}, Case{"feature,owner\n", Code::BadValue, 0},
          Case{"a,Ada\nb\n", Code::BadValue, 2}, Case{"a,Ada,1,2\n", Code::BadValue, 1},
          Case{"a,Ada,two\n", Code::BadValue, 1}, Case{"a,Ada,0\n", Code::BadValue, 1},
          Case{"a,Ada,3/2\n", Code::BadValue, 1}, Case{"a,Ada,1/0\n", Code::BadValue, 1},
          Case{"a,Ada,1/2\na,Bob,2/3\n", Code::BadValue, 2}, Case{"a,Ada\na,Bob,1/2\n", Code::BadValue, 2},
          Case{"a,Ada,nan\n", Code::BadValue, 1}, Case{"a,\n", Code::BadValue, 1},
          Case{"\n\na,\"Ada\n\n", Code::BadValue, 3}, Case{"a,\"Ada\"x\n", Code::BadValue, 1},
          Case{"a,Ada\nclass=room,Bob\n", Code::BadValue, 2}, Case{"a,Ada\nflatt,Bob\n", Code::NothingSelected, 2},
          Case{"class=Romm,Bob\n", Code::NothingSelected, 1}}) {
        const Error error = errorOf(wrong.text);
        EXPECT_EQ(error.code(), wrong.code) << wrong.text << ": " << error.toString();
        EXPECT_EQ(error.where().line, wrong.line) << wrong.text;
    }
    EXPECT_NE(errorOf("flatt,Bob").message().find("did you mean 'flat'?"), std::string::npos);
    EXPECT_NE(errorOf("a,").message().find("found an empty one;"), std::string::npos);
    EXPECT_NE(errorOf("a,Ada,").message().find("found an empty one;"), std::string::npos);
    EXPECT_NE(errorOf("a").message().find("found 1;"), std::string::npos);
    EXPECT_NE(errorOf("a,Ada,1,2").message().find("found 4;"), std::string::npos);
    EXPECT_NE(errorOf("a,Ada\na,Bob").message().find("in line 1"), std::string::npos);
    EXPECT_NE(errorOf("a,Ada\na,Bob").message().find("a share, such as 1/2"), std::string::npos);
}

TEST(Owners, AnyTextIsATableOrAnErrorInOneOfItsLines) {
    const auto volume = threeRooms();
    const char* const words[] = {"a",   "flat", "b", "c",   ",",          ",",   ";",    "\"",   "\n", "\n",
                                 "Ada", "Bob",  " ", "1/2", "class=room", "all", "\r\n", "\xFF", "(",  "id=\"\"a\"\""};
    std::mt19937 random(7);
    int tables = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text;
        for (std::uint32_t word = random() % 12; word > 0; --word) text += words[random() % std::size(words)];
        const auto table = parseOwners(text, "t.csv", volume.labels);
        if (!table) {
            const auto lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')) + 1;
            EXPECT_LE(table.error().where().line, lines) << text;
            EXPECT_FALSE(table.error().message().empty());
            continue;
        }
        ++tables;
        EXPECT_FALSE(table->names.empty());
        for (const auto& owners : table->ofLabel) {
            double sum = 0;
            for (const auto& [owner, fraction] : owners) {
                EXPECT_LT(owner, table->names.size());
                sum += fraction;
            }
            EXPECT_LE(sum, 1 + 1e-9) << text;
        }
    }
    EXPECT_GT(tables, 100);
}

}  // namespace
}  // namespace svt::analyze
