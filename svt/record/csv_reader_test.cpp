#include <svt/record/csv_reader.hpp>

#include <gtest/gtest.h>

namespace svt::record {
namespace {

using Cells = std::vector<std::string>;

TEST(CsvReader, ReadsQuotedCellsWithLineNumbers) {
    CsvReader reader("# note\n a , \"b, \"\"c\"\"\nd\" ,\n\nlast,1,2\n");
    Cells cells;
    ASSERT_TRUE(reader.next(cells));
    EXPECT_EQ(cells, (Cells{"a", "b, \"c\"\nd", ""}));
    EXPECT_EQ(reader.line(), 2u);
    EXPECT_TRUE(reader.isWhole());
    ASSERT_TRUE(reader.next(cells));
    EXPECT_EQ(cells, (Cells{"last", "1", "2"}));
    EXPECT_EQ(reader.line(), 5u);
    EXPECT_FALSE(reader.next(cells));
}

TEST(CsvReader, TakesSemicolonsWithDecimalCommas) {
    CsvReader reader(
        "\xEF\xBB\xBF"
        "a;b\n1,5;2.5\n");
    Cells cells;
    ASSERT_TRUE(reader.next(cells) && reader.next(cells));
    EXPECT_EQ(cells, (Cells{"1,5", "2.5"}));
    EXPECT_EQ(reader.number(cells[0]), 1.5);
    EXPECT_EQ(reader.number(cells[1]), 2.5);
    EXPECT_FALSE(reader.number("1,5,0"));
    const CsvReader commas("a,b\n");
    EXPECT_FALSE(commas.number("1,5")) << "the comma separates cells here";
}

TEST(CsvReader, ReportsARowWithoutEnd) {
    CsvReader cut("a,b\n1,2");
    Cells cells;
    ASSERT_TRUE(cut.next(cells) && cut.next(cells));
    EXPECT_FALSE(cut.isWhole());
    EXPECT_FALSE(cut.isQuoteOpen());
    CsvReader open("a\n\"b\n");
    ASSERT_TRUE(open.next(cells) && open.next(cells));
    EXPECT_TRUE(open.isQuoteOpen());
}

}  // namespace
}  // namespace svt::record
