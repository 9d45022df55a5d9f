// Letters in PDF that the embedded font lacks: a font of the machine draws them, or a note names them.
#include <tests/cli/drawings/small_ifc.hpp>
#include <tests/cli/run_command.hpp>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

// A TrueType font, "Sheet Test", with bars for U+5BDD and U+5BA4, made for this test.
constexpr const char* kFont =
    "AAEAAAAKAIAAAwAgT1MvMqB+qbQAAAEoAAAAYGNtYXBcKVvHAAABlAAAADxnbHlmugNZkwAAAdgAAABoaGVhZGLMRDIAAACsAAAANmhoZWEHCg"
    "OHAAAA5AAAACRobXR4BkAAlgAAAYgAAAAKbG9jYQAgAEEAAAHQAAAACG1heHAABgAKAAABCAAAACBuYW1lbpxVkAAAAkAAAADncG9zdAADAAAA"
    "AAMoAAAAIAABAAAAAQAAeoqgOF8PPPUAAwPoAAAAAAAAAAAAAAAAAAAAAAAyAAADhANSAAAAAwACAAAAAAAAAAEAAANS/2oAAAPoADIAMgOEAA"
    "EAAAAAAAAAAAAAAAAAAAACAAEAAAADAAgAAgAAAAAAAgAAAAAAAAAAAAAAAAAAAAAAAwNBAZAABQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAACAAAAAAAAAAAAAAAPz8/PwAAW6Rb3QNSAAAAAANSAJYAAAAAAAAAAAAAAAAAAAAgAAAB9AAyA+gAZABkAAAAAAACAAAAAw"
    "AAABQAAwABAAAAFAAEACgAAAAGAAQAAQACW6Rb3f//AABbpFvd//+kXqQkAAEAAAAAAAAAAAANACAANAABADIAAAHCArwAAwAAMxEhETIBkAK8"
    "/UQAAAIAZAAAA4QDUgADAAcAADM1IRUlETMRZAMg/iWWlpaWArz9RAAAAgBkAAADhANSAAMABwAAEzUhFQERMxFkAyD84JYCvJaW/UQCvP1EAA"
    "AADACWAAEAAAAAAAEACgAAAAEAAAAAAAIABwAKAAEAAAAAAAMACQARAAEAAAAAAAQACgAAAAEAAAAAAAUAAQAaAAEAAAAAAAYACQARAAMAAQQJ"
    "AAEAFAAbAAMAAQQJAAIADgAvAAMAAQQJAAMAEgA9AAMAAQQJAAQAFAAbAAMAAQQJAAUAAgBPAAMAAQQJAAYAEgA9U2hlZXQgVGVzdFJlZ3VsYX"
    "JTaGVldFRlc3QxAFMAaABlAGUAdAAgAFQAZQBzAHQAUgBlAGcAdQBsAGEAcgBTAGgAZQBlAHQAVABlAHMAdAAxAAADAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAA";

// A house with a room of two Chinese characters.
std::string roomIfc() {
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {8, 6, 3});
    ifc.box("SPACE", "\\X2\\5BDD5BA4\\X0\\", storey, {0.3, 0.3, 0}, {7.7, 5.7, 2.8});
    return ifc.text();
}

// A configuration of fontconfig that has only the fonts of `folder / "fonts"`.
void writeFonts(const fs::path& folder, bool hasFont) {
    fs::create_directories(folder / "fonts");
    if (hasFont) {
        writeText(folder / "font.txt", kFont);
        runShellWell(folder, "base64 -d font.txt > fonts/test.ttf");
    }
    const std::string dir = (folder / "fonts").string(), cache = (folder / "cache").string();
    writeText(folder / "fonts.conf", "<?xml version=\"1.0\"?><fontconfig><dir>" + dir + "</dir><cachedir>" + cache +
                                         "</cachedir></fontconfig>");
}

ShellResult fontSheets(const fs::path& folder, const std::string& output) {
    return runShell(folder, "FONTCONFIG_FILE=" + (folder / "fonts.conf").string() + " '" + commandPath() +
                                "' sheets room.ifc --spacing 0.2 --svg s -o " + output);
}

TEST(SheetFonts, LettersThatTheEmbeddedFontLacksTakeAFontOfTheMachine) {
    if (!hasProgram("pdffonts -v")) GTEST_SKIP() << "no poppler";
    const TemporaryFolder folder;
    writeText(folder / "room.ifc", roomIfc());
    writeFonts(folder.path(), true);
    const ShellResult drawn = fontSheets(folder.path(), "room.pdf");
    ASSERT_EQ(drawn.exitCode, 0) << drawn.text;
    EXPECT_EQ(drawn.text.find("no font"), std::string::npos) << drawn.text;
    EXPECT_NE(runShellWell(folder.path(), "pdffonts room.pdf").find("SheetTest"), std::string::npos);
    EXPECT_NE(runShellWell(folder.path(), "pdftotext room.pdf -").find("\u5BDD\u5BA4"), std::string::npos);
    ASSERT_EQ(fontSheets(folder.path(), "again.pdf").exitCode, 0);
    EXPECT_EQ(readText(folder / "room.pdf"), readText(folder / "again.pdf"));
    EXPECT_NE(readText(folder / "s" / "sheet-1.svg").find("'Noto Sans CJK SC'"), std::string::npos);
}

TEST(SheetFonts, LettersOfNoFontAreNamedWithARemedy) {
    const TemporaryFolder folder;
    writeText(folder / "room.ifc", roomIfc());
    writeFonts(folder.path(), false);
    const ShellResult drawn = fontSheets(folder.path(), "room.pdf");
    ASSERT_EQ(drawn.exitCode, 0) << drawn.text;
    EXPECT_NE(drawn.text.find("no font on this machine has the letters '\u5BDD\u5BA4'"), std::string::npos)
        << drawn.text;
    EXPECT_NE(drawn.text.find("fonts-noto-cjk"), std::string::npos) << drawn.text;
    const std::string section =
        runShellWell(folder.path(), "FONTCONFIG_FILE=" + (folder / "fonts.conf").string() + " '" + commandPath() +
                                        "' section room.ifc --spacing 0.2 -o plan.pdf 2>&1");
    EXPECT_NE(section.find("no font on this machine has the letters '\u5BDD\u5BA4'"), std::string::npos) << section;
}

// The name of an owner is in no name of the model.
TEST(SheetFonts, LettersOfOwnersWithoutFontAreNamed) {
    const TemporaryFolder folder;
    runShellWell(folder.path(), "'" + commandPath() + "' sample tower --storeys 1 -o tower.gml");
    writeText(folder / "owners.csv", "class=BuildingUnit,\u5BDD\u5BA4\n");
    writeFonts(folder.path(), false);
    const ShellResult reported =
        runShell(folder.path(), "FONTCONFIG_FILE=" + (folder / "fonts.conf").string() + " '" + commandPath() +
                                    "' cadastre tower.gml --spacing 0.25 --owners owners.csv -o units.pdf");
    ASSERT_EQ(reported.exitCode, 0) << reported.text;
    EXPECT_NE(reported.text.find("no font on this machine has the letters '\u5BDD\u5BA4'"), std::string::npos)
        << reported.text;
}

}  // namespace
}  // namespace svt::test
