#include <svt/model/query.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

namespace svt::model {
namespace {

/// A house with two storeys, one in the tree and one as a group, and unrelated objects:
///
///     0 b1 Building "Haus"            7 g CityObjectGroup "OG", function lod4Storey
///     1   s1 Storey "EG"              8 og1 BuildingRoom "Bad", member of g
///     2     r1 BuildingRoom "Küche"   9   tub BuildingFurniture
///     3       w1 Window              10 b2 Building
///     4     r2 BuildingRoom "Flur"   11 g2 CityObjectGroup "quarter", member b2
///     5   u1 BuildingUnit "Top 1"    12 att BuildingInstallation, numbers as text
///     6     (r2 is a member of u1)
class QueryTest : public testing::Test {
protected:
    QueryTest() {
        add("b1", "Building", "Haus", kNoRow,
            {{"roofType", std::string("gable"), ""}, {"year", std::int64_t{1985}, ""}});
        add("s1", "Storey", "EG", 0);
        add("r1", "BuildingRoom", "K\u00fcche", 1, {{"area", 12.5, "m2"}, {"heated", true, ""}}, 30);
        add("w1", "Window", "", 2, {{"ifcType", std::string("IfcWindow"), ""}}, 0.5);
        add("r2", "BuildingRoom", "Flur", 1, {{"area", 9.0, "m2"}, {"heated", false, ""}}, 15);
        add("u1", "BuildingUnit", "Top 1", 0);
        add("x", "Door", "", 4, {{"ifcType", std::string("IfcDoor"), ""}}, 0.25);
        add("g", "CityObjectGroup", "OG", kNoRow, {{"function", std::string("lod4Storey"), ""}});
        add("og1", "BuildingRoom", "Bad", 0, {{"set/use of room", std::string("wet"), ""}}, 20);
        add("tub", "BuildingFurniture", "", 8);
        add("b2", "Building", "Haus", kNoRow, {{"class", std::string("1000"), ""}});
        add("g2", "CityObjectGroup", "quarter", kNoRow);
        add("att", "BuildingInstallation", "", 0,
            {{"height", std::string("10"), ""}, {"big", std::int64_t{9007199254740993}, ""}});
        groups_[4] = {5};
        groups_[8] = {7};
        groups_[10] = {11};
        refresh();
    }

    void add(std::string id, std::string className, std::string name, std::uint32_t parent,
             std::vector<Attribute> attributes = {}, double volume = 0) {
        features_.push_back({std::move(id), std::move(className), std::move(name), std::move(attributes)});
        groups_.emplace_back();
        QueryRow row;
        row.parent = parent;
        row.volume = volume;
        row.voxels = static_cast<std::uint64_t>(volume * 1000);
        rows_.push_back(row);
    }

    void refresh() {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            rows_[i].id = features_[i].id;
            rows_[i].className = features_[i].className;
            rows_[i].name = features_[i].name;
            rows_[i].attributes = features_[i].attributes;
            rows_[i].groups = groups_[i];
        }
    }

    std::string select(std::string_view text) {
        const auto query = Query::parse(text);
        if (!query) return query.error().toString();
        std::string ids;
        for (const std::uint32_t i : query->select(rows_)) ids += (ids.empty() ? "" : " ") + features_[i].id;
        return ids;
    }

    std::string unknown(std::string_view text) {
        const auto query = Query::parse(text);
        return query ? query->unknownValue(rows_) : query.error().toString();
    }

    struct Owned {
        std::string id, className, name;
        std::vector<Attribute> attributes;
    };
    std::vector<Owned> features_;
    std::vector<std::vector<std::uint32_t>> groups_;
    std::vector<QueryRow> rows_;
};

TEST_F(QueryTest, ClassesOfTheSourceSelectToo) {
    EXPECT_EQ(select("class=IfcWindow"), "w1");
    EXPECT_EQ(select("class=ifcdoor"), "x");
    EXPECT_EQ(select("class=IfcDo"), "");
    EXPECT_EQ(select("class~'^Ifc'"), "w1 x");
    EXPECT_EQ(select("class=IfcWindow or class=Door"), "w1 x");
    EXPECT_EQ(select("(class=Window or class=Door) and class!=IfcDoor"), "w1");
    EXPECT_EQ(select("(class=Window or class=Door) and class!~Ifc"), "");
    EXPECT_EQ(unknown("class=IfcDor"), "no class 'IfcDor'; did you mean 'IfcDoor'?");
    EXPECT_EQ(unknown("class=IfcWindow"), "");
}

TEST_F(QueryTest, ClassComparesCanonicalNamesWithoutCase) {
    EXPECT_EQ(select("class=BuildingRoom"), "r1 r2 og1");
    EXPECT_EQ(select("CLASS = buildingroom"), "r1 r2 og1");
    EXPECT_EQ(select("class=room"), "r1 r2 og1");
    EXPECT_EQ(select("class=BuildingStorey"), "s1");
    EXPECT_EQ(select("class~^Building$"), "b1 b2");
    EXPECT_EQ(select("class!=Building and class!~Building and not class=CityObjectGroup"), "s1 w1 x");
}

TEST_F(QueryTest, IdAndNameAreText) {
    EXPECT_EQ(select("id=r1"), "r1");
    EXPECT_EQ(select("id=R1"), "");
    EXPECT_EQ(select("name=\"Top 1\""), "u1");
    EXPECT_EQ(select("name='Top 1'"), "u1");
    EXPECT_EQ(select("name~^K.che$"), "r1");
    EXPECT_EQ(select("name!=Haus and class!=CityObjectGroup"), "s1 r1 r2 u1 og1")
        << "what has no name matches no comparison";
    EXPECT_EQ(select("id!~\"[0-9]\""), "x g tub att");
}

TEST_F(QueryTest, NumbersCompareAsNumbers) {
    EXPECT_EQ(select("volume>15"), "r1 og1");
    EXPECT_EQ(select("volume>=15"), "r1 r2 og1");
    EXPECT_EQ(select("volume<5e-1 and volume>0"), "x");
    EXPECT_EQ(select("voxels=500"), "w1");
    EXPECT_EQ(select("area>9"), "r1");
    EXPECT_EQ(select("area=9"), "r2");
    EXPECT_EQ(select("year<=1985.0"), "b1");
    EXPECT_EQ(select("height>9"), "att") << "text that is a number is a number";
    EXPECT_EQ(select("big=9007199254740993"), "att");
    EXPECT_EQ(select("big=9007199254740992"), "") << "long integers keep their digits";
}

TEST_F(QueryTest, OtherValuesCompareAsText) {
    EXPECT_EQ(select("roofType=gable"), "b1");
    EXPECT_EQ(select("rooftype=gable"), "b1");
    EXPECT_EQ(select("roofType=Gable"), "");
    EXPECT_EQ(select("roofType<h"), "b1");
    EXPECT_EQ(select("heated=TRUE"), "r1");
    EXPECT_EQ(select("heated!=true"), "r2");
    EXPECT_EQ(select("\"set/use of room\"=wet"), "og1");
    EXPECT_EQ(select("ifcType~'Ifc(Door|Window)'"), "w1 x");
}

TEST_F(QueryTest, WithoutTheAttributeNothingMatches) {
    EXPECT_EQ(select("ifcType!=IfcDoor"), "w1");
    EXPECT_EQ(select("ifcType!~Door"), "w1");
    EXPECT_EQ(select("class=Window and not ifcType=IfcDoor"), "w1");
    EXPECT_EQ(select("class=Building and not roofType=gable"), "b2") << "not takes those without the attribute";
}

TEST_F(QueryTest, QuotedKeyIsAlwaysAnAttribute) {
    EXPECT_EQ(select("\"class\"=1000"), "b2");
    EXPECT_EQ(select("class=1000"), "");
}

TEST_F(QueryTest, AndBindsCloserThanOr) {
    EXPECT_EQ(select("id=b1 or id=r1 and class=Window"), "b1");
    EXPECT_EQ(select("(id=b1 or id=r1) and class=BuildingRoom"), "r1");
    EXPECT_EQ(select("NOT (class=BuildingRoom Or class=Building) AND volume>0"), "w1 x");
    EXPECT_EQ(select("not not id=x"), "x");
    EXPECT_EQ(select("none"), "");
    EXPECT_EQ(select("none or id=x"), "x");
    EXPECT_EQ(select("all and id=x"), "x");
    EXPECT_EQ(select("all").size(), select("not none").size());
}

TEST_F(QueryTest, UnderTakesTheFeatureAndAllBelow) {
    EXPECT_EQ(select("under s1"), "s1 r1 w1 r2 x");
    EXPECT_EQ(select("under EG and class=BuildingRoom"), "r1 r2");
    EXPECT_EQ(select("under \"Top 1\""), "r2 u1 x") << "members and what is below them";
    EXPECT_EQ(select("under Haus and class=Building"), "b1 b2") << "every feature of that name";
    EXPECT_EQ(select("under nowhere"), "");
}

TEST_F(QueryTest, StoreyTakesWhatIsBelowOrAMember) {
    EXPECT_EQ(select("storey=EG"), "r1 w1 r2 x");
    EXPECT_EQ(select("storey=s1"), "r1 w1 r2 x");
    EXPECT_EQ(select("storey=OG"), "og1 tub")
        << "a group with the function of a storey, with what is below its members";
    EXPECT_EQ(select("storey=quarter"), "") << "no storey";
    EXPECT_EQ(select("storey~\"^[EO]G$\" and class=BuildingRoom"), "r1 r2 og1");
    EXPECT_EQ(select("storey!=EG"), "og1 tub");
    EXPECT_EQ(select("storey=EG and not (class=Window or ifcType=IfcDoor)"), "r1 r2");
}

TEST_F(QueryTest, StoreyTakesMembersOfUnitsOfTheStorey) {
    groups_[2] = {5};     // r1 is a member of the unit u1 ...
    rows_[2].parent = 0;  // ... and below the building
    groups_[5] = {7};     // the unit is a member of the storey
    refresh();
    EXPECT_EQ(select("storey=OG"), "r1 w1 r2 u1 x og1 tub");
}

TEST_F(QueryTest, GermanGroupsAreStoreys) {
    for (const char* text : {"Obergeschoss", "OBERGESCHOSS", "Obergescho\u00df"}) {
        features_[7].attributes = {{"class", std::string(text), ""}};
        refresh();
        EXPECT_EQ(select("storey=OG"), "og1 tub") << text;
    }
}

TEST_F(QueryTest, CyclesDoNoHarm) {
    rows_[0].parent = 2;
    groups_[7] = {7};
    refresh();
    EXPECT_EQ(select("storey=OG and id=tub"), "tub");
    EXPECT_EQ(select("under s1 and class=Storey"), "s1");
    rows_[0].parent = 4000;
    EXPECT_EQ(select("under b1 and id=b1"), "b1");
}

TEST_F(QueryTest, RowsMayComeInAnyOrder) {
    add("late", "Storey", "KG", kNoRow);
    rows_[12].parent = 13;
    refresh();
    EXPECT_EQ(select("storey=KG"), "att");
}

TEST_F(QueryTest, UnknownValueNamesTheNearest) {
    EXPECT_EQ(unknown("class=BuildingRom"), "no class 'BuildingRom'; did you mean 'BuildingRoom'?");
    EXPECT_EQ(unknown("class=buildingroom"), "");
    EXPECT_EQ(unknown("storey=E"), "no storey 'E'; did you mean 'EG'?");
    EXPECT_EQ(unknown("storey=cellar"), "no storey 'cellar'; there are 'EG', 'OG', 'g', 's1'");
    EXPECT_EQ(unknown("under Huas"), "no feature with the id or name 'Huas'; did you mean 'Haus'?");
    EXPECT_EQ(unknown("id=r1 and id=tup"), "no id 'tup'; did you mean 'tub'?");
    EXPECT_EQ(unknown("roffType=gable"), "no attribute 'roffType'; did you mean 'roofType'?");
    EXPECT_EQ(unknown("volumme>3"), "no attribute 'volumme'; did you mean 'volume'?");
    EXPECT_EQ(unknown("ifcType=IfcDor"), "no ifcType 'IfcDor'; did you mean 'IfcDoor'?");
    EXPECT_EQ(unknown("name=Top"), "no name 'Top'; did you mean 'Top 1'?");
    EXPECT_EQ(unknown("storey=EG or not (class=Window and name~x)"), "");
    EXPECT_EQ(unknown("year=2000"), "") << "a number is no name";
    EXPECT_EQ(Query::parse("class=Room")->unknownValue({}), "no class 'BuildingRoom'; there are no classes");
}

std::string errorOf(std::string_view text) {
    const auto query = Query::parse(text);
    EXPECT_FALSE(query) << text;
    if (query) return {};
    EXPECT_EQ(query.error().code(), Code::BadQuery);
    EXPECT_GT(query.error().where().column, 0u) << text;
    // What is behind the query itself.
    const std::string& message = query.error().message();
    const std::string start = "the query '" + std::string(text) + "', ";
    return message.rfind(start, 0) == 0 ? message.substr(start.size()) : message;
}

TEST(QueryParser, ErrorsTellTheColumnAndWhatWasExpected) {
    EXPECT_EQ(errorOf(""), "column 1: the query is empty; write 'all' to select everything");
    EXPECT_EQ(errorOf("class="), "column 7: expected a value after 'class=', found the end of the query");
    EXPECT_EQ(errorOf("class"),
              "column 6: expected one of = != < <= > >= ~ !~ after 'class', found the end of the query");
    EXPECT_EQ(errorOf("name=Top 1"),
              "column 10: expected 'and', 'or' or the end of the query, found '1'; a value with blanks or brackets "
              "needs quotes");
    EXPECT_EQ(errorOf("(id=a"),
              "column 6: expected 'and', 'or' or the ')' for the '(' at column 1, found the end of the query");
    EXPECT_EQ(errorOf("id=a)"), "column 5: expected 'and', 'or' or the end of the query, found ')'");
    EXPECT_EQ(errorOf("id=a and"),
              "column 9: expected a term such as class=BuildingRoom, 'not' or '(', found the end of the query");
    EXPECT_NE(errorOf("name~a(b)").find("needs quotes"), std::string::npos);
    EXPECT_EQ(errorOf("under"), "column 6: expected a value after 'under', found the end of the query");
    EXPECT_EQ(errorOf("name=\"x"), "column 6: the quote \" is not closed");
    EXPECT_EQ(errorOf("class<Room"), "column 6: 'class' can be compared by = != ~ !~, found '<'");
    EXPECT_EQ(errorOf("volume>big"), "column 8: expected a number after 'volume>', found 'big'");
    EXPECT_EQ(errorOf("volume~2"), "column 7: 'volume' is a number and can be compared by = != < <= > >=, found '~'");
    EXPECT_EQ(errorOf("name~\"a(b\""), "column 10: the regular expression cannot be used: a '(' without ')'");
    EXPECT_EQ(Query::parse("id=a)").error().where().column, 5u);
    EXPECT_EQ(Query::parse("id=a)").error().toString(),
              "E901 BadQuery: the query 'id=a)', column 5: expected 'and', 'or' or the end of the query, found ')'");
}

TEST(QueryParser, ErrorsShowTheBeginOfALongQuery) {
    // 199 bytes of the query fit; the character at bytes 199 and 200 would be cut in two.
    const std::string begin = "name=" + std::string(194, 'x');
    const auto query = Query::parse(begin + "\u00e4 and");
    ASSERT_FALSE(query);
    EXPECT_EQ(query.error().message().find("the query '" + begin + "...', column 206: expected a term"), 0u)
        << query.error().message();
}

TEST(QueryParser, ErrorsShowAQueryOf200BytesWhole) {
    const std::string text = "name=" + std::string(191, 'x') + " and";
    ASSERT_EQ(text.size(), 200u);
    const auto query = Query::parse(text);
    ASSERT_FALSE(query);
    EXPECT_EQ(query.error().message().find("the query '" + text + "', column"), 0u) << query.error().message();
}

TEST(QueryParser, SpellingsOfTheSameQueryAreEqual) {
    const Attribute attribute{"a\"b", std::string("it's"), ""};
    QueryRow row;
    row.id = "x";
    row.attributes = {&attribute, 1};
    for (const char* text : {R"("a\"b"="it's")", R"('a"b'=='it\'s')", R"( ( 'a"b' = "it's" ) )", R"('a"b'~"^it's$")"})
        EXPECT_EQ(Query::parse(text)->select({&row, 1}).size(), 1u) << text;
    EXPECT_EQ(Query::parse("id=x")->text(), "id=x");
}

TEST(Query, ManyIdsAndSubtreesSelectWhatEachSelects) {
    std::vector<std::string> ids;
    for (int i = 0; i < 600; ++i) ids.push_back("f" + std::to_string(i));
    std::vector<QueryRow> rows(ids.size());
    std::vector<std::uint32_t> groupOfSeven{7};
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        rows[i].id = ids[i];
        rows[i].className = i % 2 == 0 ? "Window" : "Door";
        rows[i].name = i == 3 ? "f500" : "";
        rows[i].parent = i % 10 == 0 ? 0xFFFFFFFFu : i - i % 10;
        if (i == 100) rows[i].groups = groupOfSeven;
    }
    const std::vector<std::string> terms{
        "id=f12",   "id=f12",     "id=f599",    "id=gone",     "under f20",
        "under f7", "under gone", "under f500", "id~'^f59.$'", "class=Door and id!=f1"};
    std::string text;
    std::set<std::uint32_t> each;
    for (const std::string& term : terms) {
        text += (text.empty() ? "" : " or ") + term;
        for (const std::uint32_t row : Query::parse(term)->select(rows)) each.insert(row);
    }
    const std::vector<std::uint32_t> all = Query::parse(text)->select(rows);
    EXPECT_EQ(std::set<std::uint32_t>(all.begin(), all.end()), each);
    EXPECT_EQ(all.size(), each.size());
}

TEST(QueryParser, DepthAndLengthAreLimited) {
    const auto nested = [](int depth) { return std::string(depth, '(') + "all" + std::string(depth, ')'); };
    EXPECT_TRUE(Query::parse(nested(60)));
    EXPECT_NE(errorOf(nested(100000 / 4)).find("nested deeper"), std::string::npos);
    std::string nots;
    for (int i = 0; i < 10000; ++i) nots += "not ";
    EXPECT_NE(errorOf(nots + "all").find("nested deeper"), std::string::npos);
    const auto longQuery = Query::parse("id=" + std::string(70000, 'a'));
    EXPECT_FALSE(longQuery);
    std::string chain = "all";
    for (int i = 0; i < 5000; ++i) chain += " and all";
    EXPECT_TRUE(Query::parse(chain));
}

TEST(QueryParser, RandomTextGivesAQueryOrAnError) {
    const std::string_view pieces[] = {"class",  "=",      "!=", "~", "(", ")", "not ", " and ", " or ", "\"", "'",
                                       "under ", "storey", "[",  "*", "a", " ", "5",    "\\",    "|",    "{2}"};
    std::mt19937 random(11);
    QueryRow row;
    row.id = "a";
    row.className = "Storey";
    int good = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text;
        for (int k = 1 + static_cast<int>(random() % 8); k > 0; --k) text += pieces[random() % std::size(pieces)];
        const auto query = Query::parse(text);
        if (!query) {
            EXPECT_EQ(query.error().code(), Code::BadQuery) << text;
            continue;
        }
        ++good;
        EXPECT_LE(query->select({&row, 1}).size(), 1u);
        (void)query->unknownValue({&row, 1});
    }
    EXPECT_GT(good, 100);
}

}  // namespace
}  // namespace svt::model
