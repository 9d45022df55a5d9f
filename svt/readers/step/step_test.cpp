#include <svt/readers/step/step_file.hpp>
#include <svt/readers/step/step_value.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt::readers::step {
namespace {

std::string file(const std::string& data) {
    return "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n";
}

struct Scanned {
    std::string text;  // the file refers to it
    Diagnostics log;
    Result<StepFile> file;
    explicit Scanned(std::string content) : text(std::move(content)), file(StepFile::scan(text, "a.ifc", log)) {}
    [[nodiscard]] std::string values(std::uint32_t id) const {
        const RecordIndex record = file->find(id);
        return record == kNoRecord ? "none" : std::string(file->valuesOf(file->records()[record]));
    }
};

TEST(StepFile, FindsRecordsByTheirIds) {
    const Scanned s(file("#1=IFCWALL('a',#2);\n#2 = IFCDOOR ( 'b;)' , ( 1. , 2. ) ) ; #7=IFCWALL($);\n"));
    ASSERT_TRUE(s.file);
    EXPECT_EQ(s.file->schema(), "IFC4");
    EXPECT_EQ(s.file->records().size(), 3U);
    EXPECT_EQ(s.values(1), "'a',#2");
    EXPECT_EQ(s.values(2), " 'b;)' , ( 1. , 2. ) ");
    EXPECT_EQ(s.values(7), "$");
    EXPECT_EQ(s.values(3), "none");
    EXPECT_EQ(s.file->typeNames(), (std::vector<std::string_view>{"IFCWALL", "IFCDOOR"}));
    EXPECT_EQ(s.file->lineOf(s.file->records()[0]), 6U);
    EXPECT_EQ(s.file->lineOf(s.file->records()[2]), 7U);
}

TEST(StepFile, PassesOverCommentsAndQuotes) {
    const Scanned s(
        file("/* #9=IFCWALL('no'); ' */\n#1=/* x */IFCWALL('it''s /* no comment',/* ) ; ' */#2);\n#2=IFCDOOR('');\n"));
    ASSERT_TRUE(s.file);
    EXPECT_EQ(s.file->records().size(), 2U);
    const std::vector<Value> values = splitValues(s.values(1));
    EXPECT_EQ(values.size(), 2U);
    const std::string text = s.values(1);
    EXPECT_EQ(splitValues(text)[0].string(), "it's /* no comment");
    EXPECT_EQ(splitValues(text)[1].reference(), 2U);
    EXPECT_EQ(s.log.items().size(), 0U);
}

TEST(StepFile, AnOpenQuoteLosesOneRecord) {
    const Scanned s(
        file("#1=IFCWALL('open);\n#2=IFCDOOR('b');\n#3=IFCWALL(('x');\n#4=IFCDOOR('d');\n#x=1;\n#5=IFCDOOR('e');\n"));
    ASSERT_TRUE(s.file);
    EXPECT_EQ(s.values(1), "none");
    EXPECT_EQ(s.values(2), "'b'");
    EXPECT_EQ(s.values(3), "none");
    EXPECT_EQ(s.values(4), "'d'");
    EXPECT_EQ(s.values(5), "'e'");
    ASSERT_EQ(s.log.count(Code::BadRecord), 3U);
    EXPECT_EQ(s.log.items()[0].where.line, 6U);
    EXPECT_EQ(s.log.items()[1].where.line, 8U);
}

TEST(StepFile, SparseAndRepeatedIds) {
    const Scanned s(
        file("#4000000000=IFCWALL('a');\n#5=IFCWALL('b');\n#5=IFCWALL('c');\n#99999999999=IFCWALL('d');\n"));
    ASSERT_TRUE(s.file);
    EXPECT_EQ(s.values(4000000000U), "'a'");
    EXPECT_EQ(s.values(5), "'b'");
    EXPECT_EQ(s.log.count(Code::DuplicateId), 1U);
    EXPECT_EQ(s.log.count(Code::BadRecord), 1U);
}

TEST(StepFile, OtherTextIsRefused) {
    EXPECT_EQ(Scanned("hello").file.error().code(), Code::BadStep);
    EXPECT_EQ(Scanned("ISO-10303-21;\nHEADER;\n").file.error().code(), Code::BadStep);
    EXPECT_EQ(Scanned(file("")).file.error().code(), Code::BadStep);
}

TEST(StepFile, AnyCutEndsWithoutACrash) {
    const std::string whole = file("#1=IFCWALL('a''b',(1.,(2.)),/* c */#2);\n#2=IFCDOOR('\\X2\\00FC\\X0\\');\n");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Scanned s(whole.substr(0, size));
        if (s.file)
            for (const Record& record : s.file->records()) (void)splitValues(s.file->valuesOf(record));
    }
}

TEST(StepValue, KindsOfValues) {
    const std::vector<Value> v =
        splitValues("#12,'text',1.5E3,.T.,.ELEMENT.,$,*,(1,(2,3)),IFCLABEL('x'),IFCREAL(2.),-7,'a,b'");
    ASSERT_EQ(v.size(), 12U);
    EXPECT_EQ(v[0].reference(), 12U);
    EXPECT_EQ(v[1].string(), "text");
    EXPECT_EQ(v[2].number(), 1500.0);
    EXPECT_EQ(v[3].enumeration(), "T");
    EXPECT_EQ(v[4].enumeration(), "ELEMENT");
    EXPECT_TRUE(v[5].isNothing());
    EXPECT_TRUE(v[6].isNothing());
    EXPECT_EQ(itemsOf(v[7]).size(), 2U);
    EXPECT_EQ(v[8].typeName(), "IFCLABEL");
    EXPECT_EQ(v[8].string(), "x");
    EXPECT_EQ(v[9].number(), 2.0);
    EXPECT_EQ(v[10].integer(), -7);
    EXPECT_EQ(v[11].string(), "a,b");
    EXPECT_FALSE(v[1].number());
    EXPECT_FALSE(v[0].number());
}

TEST(StepValue, NumbersAreReadExactly) {
    for (const char* text :
         {"0.1", "123456.789", "-0.000001", "1.", "0.30000000000000004", "1.E-005", "6.02E23", "+2.5", "-.5"})
        EXPECT_EQ(Value(text).number(), std::stod(text)) << text;
    for (const char* text : {"", "x", "1.2.3", "nan", "inf", "1e999", "--1", "-"})
        EXPECT_FALSE(Value(text).number()) << text;
}

TEST(StepValue, EscapesOfStrings) {
    EXPECT_EQ(decodeString("it''s"), "it's");
    EXPECT_EQ(decodeString("a\\\\b"), "a\\b");
    EXPECT_EQ(decodeString("K\\X\\FCche"), "K\u00fcche");
    EXPECT_EQ(decodeString("K\\S\\|che"), "K\u00fcche");
    EXPECT_EQ(decodeString("\\X2\\00FC00DF\\X0\\!"), "\u00fc\u00df!");
    EXPECT_EQ(decodeString("\\X2\\D83DDE00\\X0\\"), "\U0001F600");
    EXPECT_EQ(decodeString("\\X4\\0001F600\\X0\\"), "\U0001F600");
    EXPECT_EQ(decodeString("\\PA\\x"), "x");
    EXPECT_EQ(decodeString("\\X2\\00F"), "\\X2\\00F");
    EXPECT_EQ(decodeString("\\X2\\D83D\\X0\\"), "\uFFFD");
    EXPECT_EQ(decodeString("K\xFC"
                           "che"),
              "K\u00fcche");
    EXPECT_EQ(decodeString("K\u00fcche"), "K\u00fcche");
}

}  // namespace
}  // namespace svt::readers::step
