#include <svt/writers/xlsx_file.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

XlsxSheet smallSheet() {
    XlsxSheet sheet{"Sheet", {}, {"Text", "Number", "Truth"}};
    sheet.table.columns = {{"a"}, {"b"}, {"c"}};
    sheet.table.rows = {{"bell \a, \xff and <&>", 1.25, true}, {Cell(), 7, Cell()}};
    return sheet;
}

TEST(Xlsx, EqualSheetsGiveEqualBytes) {
    const XlsxSheet sheet = smallSheet();
    const auto first = makeXlsx({&sheet, 1}, "title \x01"), second = makeXlsx({&sheet, 1}, "title \x01");
    ASSERT_TRUE(first.hasValue()) << first.error().message();
    EXPECT_TRUE(first->starts_with("PK"));
    EXPECT_EQ(*first, *second);
}

TEST(Xlsx, RefusesTextsAndSheetsThatItCannotHave) {
    XlsxSheet sheet = smallSheet();
    sheet.table.rows[0][0] = std::string(40000, 'x');
    const auto longText = makeXlsx({&sheet, 1}, "");
    ASSERT_FALSE(longText.hasValue());
    EXPECT_NE(longText.error().message().find("32767"), std::string::npos) << longText.error().message();
    sheet = smallSheet();
    sheet.table.rows.assign(1048576, Row(3));
    const auto longSheet = makeXlsx({&sheet, 1}, "");
    ASSERT_FALSE(longSheet.hasValue());
    EXPECT_NE(longSheet.error().message().find("1048576 rows"), std::string::npos) << longSheet.error().message();
    sheet = smallSheet();
    sheet.name = "not/valid";
    EXPECT_FALSE(makeXlsx({&sheet, 1}, "").hasValue());
}

}  // namespace
}  // namespace svt::writers
