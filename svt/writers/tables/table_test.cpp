#include <svt/writers/table.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

// Two rows with a cell of each type that text has; the column without a title stands in JSON and CSV only.
Table sampleTable() {
    Table table;
    table.columns = {{"id", "id"}, {"class", ""}, {"volume", "m3", 1}, {"voxels", "n"}, {"around", "around"}};
    table.rows = {{"a;1", "Wall", 2.0, 7, std::vector<std::string>{"x", "y"}}, {"Tür \"b\"", nullptr, {}, true, ""}};
    return table;
}

TEST(Table, TextHasAlignedColumnsAndDashesForEmptyCells) {
    EXPECT_EQ(makeText(sampleTable()),
              "id        m3  n     around\n"
              "a;1      2.0  7     x y\n"
              "Tür \"b\"    -  true\n");
}

TEST(Table, TextAlignsSmallNumbersAsNumbers) {
    const Table table{{{"a", "a", 1}}, {{0.5f}, {12.0}}};
    EXPECT_EQ(makeText(table), "   a\n 0.5\n12.0\n");
}

TEST(Table, JsonKeepsTypesAndListsColumnsWithoutTitles) {
    Table table = sampleTable();
    table.rows.pop_back();
    EXPECT_EQ(makeJson(table),
              "[\n  {\n    \"id\": \"a;1\",\n    \"class\": \"Wall\",\n    \"volume\": 2.0,\n    \"voxels\": 7,\n"
              "    \"around\": [\n      \"x\",\n      \"y\"\n    ]\n  }\n]\n");
    table.rows.clear();
    EXPECT_EQ(makeJson(table), "[]\n");
}

TEST(Table, CsvQuotesWhatItsFormSeparates) {
    const Table table = sampleTable();
    EXPECT_EQ(makeCsv(table), "id,class,volume,voxels,around\r\na;1,Wall,2,7,x y\r\n\"Tür \"\"b\"\"\",,,true,\r\n");
    EXPECT_EQ(csvLine(table.rows[0], CsvForm::Stream), "\"a;1\",Wall,2.0,7,x y\n");
}

TEST(Table, CornersOfAnEmptyBoxAreEmptyCells) {
    Row row;
    appendCorners(row, Box3d());
    appendCorners(row, Box3d{{1, 2, 3}, {4, 5, 6}});
    EXPECT_EQ(csvLine(row), ",,,,,,1,2,3,4,5,6\r\n");
}

}  // namespace
}  // namespace svt::writers
