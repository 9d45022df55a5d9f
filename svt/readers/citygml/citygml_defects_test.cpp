#include <svt/model/surface_uses.hpp>
#include <svt/readers/citygml/citygml_documents_test.hpp>

#include <ctime>
#include <random>

namespace svt::readers {
namespace {

using namespace gmltest;

std::string goodModel() {
    return cityModel(
        2, "<gml:name>n</gml:name><gml:boundedBy><gml:Envelope srsName=\"EPSG:25832\"/></gml:boundedBy>\n" +
               building("b",
                        "<gml:name>house</gml:name><gen:genericAttributeSet name=\"s\"><gen:intAttribute "
                        "name=\"i\"><gen:value>1</gen:value></gen:intAttribute></gen:genericAttributeSet>"
                        "<bldg:lod2Solid>" +
                            solid("so", surfaceReference("#p") +
                                            surfaceMember("<gml:OrientableSurface orientation=\"-\"><gml:baseSurface "
                                                          "xlink:href=\"#q\"/></gml:OrientableSurface>")) +
                            "</bldg:lod2Solid>\n<bldg:boundedBy><bldg:WallSurface gml:id=\"w\">" +
                            lod2Surfaces(2, multiSurface(surfaceMember(square("p")) + surfaceMember(square("q", 1)))) +
                            "</bldg:WallSurface></bldg:boundedBy>\n") +
               member("<frn:CityFurniture "
                      "gml:id=\"f\"><frn:lod3ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>"
                      "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</core:transformationMatrix>"
                      "<core:relativeGMLGeometry xlink:href=\"#so\"/><core:referencePoint><gml:Point><gml:pos>1 2 "
                      "3</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
                      "</frn:lod3ImplicitRepresentation></frn:CityFurniture>") +
               "\n<app:appearanceMember><app:Appearance><app:theme>t</"
               "app:theme><app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>1 0 "
               "0</app:diffuseColor><app:target>#so</app:target>"
               "</app:X3DMaterial></app:surfaceDataMember></app:Appearance></app:appearanceMember>" +
               member("<grp:CityObjectGroup gml:id=\"g\"><grp:groupMember role=\"r\" "
                      "xlink:href=\"#b\"/></grp:CityObjectGroup>"));
}

TEST(CityGmlDefects, TheGoodModelIsGood) {
    const Reading reading = read(goodModel());
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.diagnostics.items().size(), 1u) << reading.findings();
    EXPECT_EQ(reading.diagnostics.count(Code::OutsideArea), 1u) << "its coordinates are local";
    EXPECT_EQ(reading.model().polygons.size(), 4u);
    EXPECT_EQ(reading.model().polygons[3].material, 0);
}

TEST(CityGmlDefects, ACutOffFileIsAnErrorWhereverItIsCut) {
    const std::string text = goodModel();
    const std::size_t end = text.find("</core:CityModel>") + std::string_view("</core:CityModel>").size();
    for (std::size_t size = 0; size < end; ++size) {
        const Reading reading = read(std::string_view(text).substr(0, size));
        ASSERT_FALSE(reading.result) << size;
        ASSERT_EQ(reading.code(), Code::BadXml) << size << reading.result.error().toString();
        EXPECT_GT(reading.result.error().where().line, 0u);
        EXPECT_GT(reading.result.error().where().column, 0u);
    }
}

TEST(CityGmlDefects, BadXmlIsRefusedWithItsPlace) {
    struct Case {
        std::string_view from, to;
    };
    const Case cases[] = {
        {"</bldg:WallSurface>", "</bldg:RoofSurface>"},
        {"</gml:Polygon>", "</gml:Poly>"},
        {"</bldg:Building>", "</bldg:Room>"},
        {"</core:CityModel>", "</core:City>"},
        {"<gml:pos>", "<gml:pos a=1>"},
        {"<gml:pos>", "<gml:pos a=\"1>"},
        {"<gml:pos>", "<gml:pos a=\"<\" < >"},
        {"<gml:pos>1", "<gml:pos>< 1"},
        {"<gml:pos>", "<gml:pos <gml:pos>"},
        {"<gml:pos>", "<!-- <gml:pos>"},
        {"<gml:pos>", "<![CDATA[<gml:pos>"},
        {"</core:CityModel>", "</core:CityModel><a/>"},
        {"</core:CityModel>", "</core:CityModel>text"},
        {"<gml:pos>", "<!gml:pos>"},
        {"</bldg:boundedBy>", ""},
    };
    for (const Case& bad : cases) {
        std::string text = goodModel();
        const std::size_t at = text.find(bad.from);
        ASSERT_NE(at, std::string::npos) << bad.from;
        text.replace(at, bad.from.size(), bad.to);
        const Reading reading = read(text);
        EXPECT_EQ(reading.code(), Code::BadXml) << bad.to;
        EXPECT_GE(reading.result ? 0 : reading.result.error().where().line, 2u) << bad.to;
    }
}

TEST(CityGmlDefects, DtdAndEntitiesAreRefused) {
    const std::string bomb =
        "<?xml version=\"1.0\"?><!DOCTYPE core:CityModel [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]>" +
        goodModel().substr(goodModel().find("<core"));
    EXPECT_TRUE(looksLikeCityGml(bytesOf(bomb)));
    EXPECT_EQ(read(bomb).code(), Code::DtdRefused);
    std::string inside = goodModel();
    inside.insert(inside.find("<bldg:"), "<!ENTITY x SYSTEM \"file:///etc/passwd\">");
    EXPECT_EQ(read(inside).code(), Code::DtdRefused);
}

TEST(CityGmlDefects, DeepNestingIsRefusedBeforeItIsParsed) {
    std::string open, close;
    for (int i = 0; i < 10000; ++i) {
        open += "<bldg:consistsOfBuildingPart><bldg:BuildingPart>";
        close += "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
    }
    const Reading deep = readMembers(2, building("b", open + close));
    EXPECT_EQ(deep.code(), Code::InputTooBig);
    EXPECT_EQ(readMembers(2, building("b", open)).code(), Code::InputTooBig) << "cut off as well";
    ReadOptions generous;
    generous.maxDepth = 1u << 30;
    EXPECT_EQ(read(cityModel(2, building("b", open + close)), generous).code(), Code::InputTooBig)
        << "the stack sets a limit too";
}

TEST(CityGmlDefects, NestingUpToTheLimitIsRead) {
    std::string open, close;
    for (int i = 0; i < 480; ++i) {
        open += "<bldg:consistsOfBuildingPart><bldg:BuildingPart>";
        close += "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
    }
    ReadOptions options;
    options.maxDepth = 1000;
    const Reading reading = read(cityModel(2, building("b", open + close)), options);
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.model().features.size(), 481u);
}

TEST(CityGmlDefects, WrongRootOrVersionIsNamed) {
    EXPECT_EQ(read("<a/>").code(), Code::UnknownFormat);
    EXPECT_EQ(read("<CityModel/>").code(), Code::UnknownVersion);
    EXPECT_EQ(read("<CityModel xmlns=\"http://www.opengis.net/citygml/9.0\"/>").code(), Code::UnknownVersion);
    const Reading old = read("<CityModel xmlns=\"http://www.citygml.org/citygml/1/0/0\"/>");
    EXPECT_EQ(old.code(), Code::UnknownVersion);
    EXPECT_NE(old.result.error().message().find("0.4"), std::string::npos);
    EXPECT_EQ(read("<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\"/>").count(Code::EmptyModel), 1u);
}

TEST(CityGmlDefects, EncodingsAreConvertedOrRefused) {
    const std::string utf8 = cityModel(2, building("b",
                                                   "<gml:name>Stra\xC3\x9F"
                                                   "e \xE2\x82\xAC \xF0\x9F\x8F\xA0</gml:name>"));
    std::string latin = cityModel(2, building("b",
                                              "<gml:name>Stra\xDF"
                                              "e</gml:name>"));
    EXPECT_EQ(read(latin).code(), Code::BadEncoding);
    EXPECT_EQ(read(latin).result.error().where().line, 3u);
    latin.replace(latin.find("UTF-8"), 5, "ISO-8859-1");
    EXPECT_EQ(read(latin).feature("b").name,
              "Stra\xC3\x9F"
              "e");
    latin.replace(latin.find("ISO-8859-1"), 10, "windows-1252");
    latin.replace(latin.find("\xDF"), 1, "\x80");
    EXPECT_EQ(read(latin).feature("b").name,
              "Stra\xE2\x82\xAC"
              "e");
    latin.replace(latin.find("windows-1252"), 12, "ISO-8859-15");
    EXPECT_EQ(read(latin).code(), Code::Internal) << "whatever its bytes, each is a character";
    latin.replace(latin.find("ISO-8859-15"), 11, "EBCDIC");
    EXPECT_EQ(read(latin).code(), Code::BadEncoding);

    for (const bool isBigEndian : {false, true}) {
        std::string wide = isBigEndian ? "\xFE\xFF" : "\xFF\xFE";
        const auto put = [&](unsigned unit) {
            const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
            wide += isBigEndian ? high : low;
            wide += isBigEndian ? low : high;
        };
        const std::string ascii = cityModel(2, building("b", "<gml:name>@</gml:name>"));
        for (const char c : ascii) {
            if (c != '@') {
                put(static_cast<unsigned char>(c));
                continue;
            }
            put(0xDF), put(0x20AC), put(0xD83C), put(0xDFE0);
        }
        EXPECT_TRUE(looksLikeCityGml(bytesOf(wide)));
        EXPECT_EQ(read(wide).feature("b").name, "\xC3\x9F\xE2\x82\xAC\xF0\x9F\x8F\xA0");
        EXPECT_EQ(read(std::string_view(wide).substr(0, wide.size() - 1)).code(), Code::BadEncoding);
    }
    EXPECT_EQ(read(utf8).feature("b").name,
              "Stra\xC3\x9F"
              "e \xE2\x82\xAC \xF0\x9F\x8F\xA0");
    std::string nul = utf8;
    nul[nul.find("Stra")] = '\0';
    EXPECT_EQ(read(nul).code(), Code::BadEncoding);
}

TEST(CityGmlDefects, PrefixesWithoutDeclarationAreNamedOnce) {
    const std::string surfaces = lod2Surfaces(2, multiSurface(surfaceMember(square("p"))));
    const Reading reading =
        readMembers(2, member("<bla:Building gml:id=\"a\">" + surfaces + "</bla:Building>") +
                           member("<bla:Building gml:id=\"b\" xml:lang=\"de\"><oh:x/></bla:Building>") +
                           member("<bldg:Building glm:id=\"c\">" + surfaces + "</bldg:Building>"));
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.count(Code::BadXml), 3u) << reading.findings();
    for (const char* part : {"'bla' at <bla:Building>", "'oh' at <oh:x>", "'glm' at <bldg:Building>"})
        EXPECT_NE(reading.findings().find(part), std::string::npos) << reading.findings();
    EXPECT_EQ(reading.first(Code::BadXml)->where.line, 3u);
    EXPECT_EQ(reading.first(Code::BadXml)->severity, Severity::Warning);
}

TEST(CityGmlDefects, ReferencesToNoCharacterAreNamed) {
    for (const char* bad :
         {"&#0;", "&#000;", "&#x0;", "&#x1F;", "&#xD800;", "&#xFFFF;", "&#1114112;", "&#99999999999;"}) {
        const Reading reading = readMembers(2, building(std::string("room-") + bad, "<gml:name>n</gml:name>"));
        ASSERT_TRUE(reading.result) << bad << reading.result.error().toString();
        ASSERT_EQ(reading.count(Code::BadXml), 1u) << bad << reading.findings();
        EXPECT_NE(reading.findings().find(std::string("'") + bad + "'"), std::string::npos) << reading.findings();
    }
    const Reading good =
        readMembers(2, building("b", "<gml:name>&#65;&#x9;&#10;&#xD;&#x10FFFF;&#128;&amp;#0;</gml:name>"));
    EXPECT_EQ(good.count(Code::BadXml), 0u) << good.findings();
}

TEST(CityGmlDefects, HopelessFilesDoNotFillTheMemory) {
    std::string members;
    for (int i = 0; i < 5000; ++i)
        members += surfaceMember("<gml:Polygon><gml:exterior>" + ring("0 0 0 1 1") + "</gml:exterior></gml:Polygon>") +
                   surfaceReference("#x");
    const Reading reading = readMembers(2, building("b", lod2Surfaces(2, multiSurface(members))));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.count(Code::BadValue), 5000u);
    EXPECT_EQ(reading.count(Code::DanglingReference), 5000u);
    EXPECT_LE(reading.diagnostics.items().size(), 2u * Diagnostics::kKeptPerCode + 2);
}

TEST(CityGmlDefects, LimitsAreStatedWithBothNumbers) {
    ReadOptions options;
    options.maxBytes = 100;
    const Reading reading = read(goodModel(), options);
    EXPECT_EQ(reading.code(), Code::InputTooBig);
    EXPECT_NE(reading.result.error().message().find("100"), std::string::npos);
}

TEST(CityGmlDefects, SelfReferencesEverywhereAreHarmless) {
    const Reading reading = readMembers(
        3,
        building("b",
                 "<core:lod2Solid xlink:href=\"#b\"/><core:lod3MultiSurface><gml:MultiSurface "
                 "gml:id=\"m\"><gml:surfaceMember xlink:href=\"#m\"/></gml:MultiSurface></core:lod3MultiSurface>"
                 "<bldg:buildingRoom xlink:href=\"#b\"/><core:lod1ImplicitRepresentation><core:ImplicitGeometry "
                 "gml:id=\"i\"><core:transformationMatrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</core:transformationMatrix>"
                 "<core:referencePoint><gml:Point><gml:pos>1 2 "
                 "3</gml:pos></gml:Point></core:referencePoint><core:relativeGeometry "
                 "xlink:href=\"#i\"/></core:ImplicitGeometry></core:lod1ImplicitRepresentation>"));
    ASSERT_TRUE(reading.result);
    EXPECT_GE(reading.count(Code::ReferenceCycle), 4u) << reading.findings();
    EXPECT_TRUE(reading.feature("b").geometries.empty());
}

// References of every kind that is followed: to surfaces, shells, solids, prototypes, materials' targets and features.
std::string linkedModel() {
    const std::string matrix =
        "<core:transformationMatrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</core:transformationMatrix>"
        "<core:referencePoint><gml:Point><gml:pos>1 2 3</gml:pos></gml:Point></core:referencePoint>";
    return cityModel(
        3, building("b", "<core:lod1Solid xlink:href=\"#so\"/>" +
                             lod2Surfaces(3, "<gml:MultiSurface gml:id=\"m\">" + surfaceReference("#c") +
                                                 "</gml:MultiSurface>") +
                             "<core:lod3Solid><gml:CompositeSolid gml:id=\"k\"><gml:solidMember "
                             "xlink:href=\"#so\"/></gml:CompositeSolid></core:lod3Solid>"
                             "<bldg:buildingRoom xlink:href=\"#r\"/>") +
               member("<bldg:BuildingRoom gml:id=\"r\"><core:lod2Solid><gml:Solid gml:id=\"so\"><gml:exterior>"
                      "<gml:Shell gml:id=\"sh\">" +
                      surfaceReference("#o") + surfaceReference("#q") +
                      "</gml:Shell></gml:exterior><gml:interior xlink:href=\"#in\"/></gml:Solid></core:lod2Solid>" +
                      "<bldg:roomHeight xlink:href=\"#b\"/></bldg:BuildingRoom>") +
               building("d", lod2Surfaces(3, multiSurface(surfaceMember(square("p")) + surfaceMember(square("q", 1)))) +
                                 "<core:lod3MultiSurface><gml:MultiSurface>" +
                                 surfaceMember("<gml:OrientableSurface gml:id=\"o\" orientation=\"-\"><gml:baseSurface "
                                               "xlink:href=\"#p\"/></gml:OrientableSurface>") +
                                 surfaceMember("<gml:CompositeSurface gml:id=\"c\">" + surfaceReference("#o") +
                                               "</gml:CompositeSurface>") +
                                 surfaceMember("<gml:Shell gml:id=\"in\">" + surfaceReference("#c") + "</gml:Shell>") +
                                 "</gml:MultiSurface></core:lod3MultiSurface>") +
               member("<frn:CityFurniture gml:id=\"f\"><core:lod3ImplicitRepresentation><core:ImplicitGeometry "
                      "gml:id=\"i\">" +
                      matrix +
                      "<core:relativeGeometry xlink:href=\"#m\"/></core:ImplicitGeometry>"
                      "</core:lod3ImplicitRepresentation></frn:CityFurniture>") +
               "<core:appearanceMember><app:Appearance><app:theme>t</app:theme><app:surfaceData><app:X3DMaterial>"
               "<app:diffuseColor>1 0 0</app:diffuseColor><app:target>#m</app:target></app:X3DMaterial>"
               "</app:surfaceData></app:Appearance></core:appearanceMember>" +
               member("<grp:CityObjectGroup gml:id=\"g\"><grp:groupMember><grp:Role><grp:groupMember "
                      "xlink:href=\"#b\"/></grp:Role></grp:groupMember><grp:groupMember xlink:href=\"#f\"/>"
                      "</grp:CityObjectGroup>"));
}

// The places of all texts between `before` and a quote.
std::vector<std::pair<std::size_t, std::size_t>> valuesBehind(const std::string& text, std::string_view before) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
        at += before.size();
        found.emplace_back(at, text.find('"', at) - at);
    }
    return found;
}

void expectWholeTree(const BuildingModel& model) {
    for (std::size_t i = 0; i < model.features.size(); ++i) {
        const Feature& feature = model.features[i];
        EXPECT_TRUE(feature.parent == model::kNoFeature || feature.parent < i);
        for (const Geometry& geometry : feature.geometries)
            model::forEachUse(geometry,
                              [&](const model::SurfaceUse& use) { EXPECT_LT(use.polygon, model.polygons.size()); });
    }
    EXPECT_EQ(model.treeOrder().size(), model.features.size());
    for (const model::Membership& membership : model.memberships)
        EXPECT_TRUE(membership.group < model.features.size() && membership.member < model.features.size());
}

TEST(CityGmlDefects, EveryReferenceMayCloseACircle) {
    const std::string text = linkedModel();
    const Reading whole = read(text);
    ASSERT_TRUE(whole.result) << whole.result.error().toString();
    EXPECT_TRUE(whole.diagnostics.items().empty()) << whole.findings();
    const auto references = valuesBehind(text, "xlink:href=\"#"), ids = valuesBehind(text, "gml:id=\"");
    ASSERT_EQ(references.size(), 14u);
    const std::clock_t begin = std::clock();
    std::size_t files = 0, named = 0;
    for (const auto& [at, size] : references)
        for (const auto& [idAt, idSize] : ids) {
            const std::string id = text.substr(idAt, idSize);
            std::string changed = text;
            const Reading reading = read(changed.replace(at, size, id));
            ASSERT_TRUE(reading.result) << reading.result.error().toString();
            SCOPED_TRACE(text.substr(at, size) + " at byte " + std::to_string(at) + " becomes " + id);
            EXPECT_EQ(reading.model().features.size(), whole.model().features.size());
            EXPECT_LE(reading.model().polygons.size(), 4 * whole.model().polygons.size());
            expectWholeTree(reading.model());
            ++files;
            if (reading.count(Code::ReferenceCycle) > 0) ++named;
        }
    EXPECT_GE(named, 55u);
    // Each takes a millisecond; one that doubles its work with each reference would take for ever.
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 0.1 * double(files));
}

// Any change of a few bytes gives a model or an error, never a crash; the result is the same each time.
TEST(CityGmlDefects, MutatedFilesNeverCrash) {
    const std::string good = goodModel();
    const std::string_view words[] = {"<",           ">",    "</",    "/>",   "\"",
                                      "#p",          "#so",  "<!--",  "]]>",  "NaN",
                                      "1e308",       "&#0;", "&amp;", "gml:", "xmlns:gml=\"\" ",
                                      "<gml:Solid>", "\xFF"};
    std::mt19937 random(20240611);  // NOLINT: the same changes in every run
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    for (int round = 0; round < 2000; ++round) {
        std::string text = good;
        const std::size_t changes = 1 + below(4);
        for (std::size_t change = 0; change < changes && !text.empty(); ++change) {
            const std::size_t at = below(text.size());
            switch (below(5)) {
                case 0: text[at] = static_cast<char>(random()); break;
                case 1: text.erase(at, 1 + below(30)); break;
                case 2: text.insert(at, words[below(std::size(words))]); break;
                case 3: text.insert(at, text.substr(below(text.size()), 1 + below(60))); break;
                default: text.resize(at); break;
            }
        }
        ReadOptions single;
        single.threads = 1;
        const Reading reading = read(text, single);
        const Reading again = read(text);
        ASSERT_EQ(reading.result.hasValue(), again.result.hasValue());
        ASSERT_EQ(reading.findings(), again.findings());
        if (!reading.result) {
            ASSERT_EQ(reading.result.error().toString(), again.result.error().toString());
            continue;
        }
        for (const Feature& feature : reading.model().features)
            for (const Geometry& geometry : feature.geometries)
                for (const model::SurfaceUse use : geometry.surfaces)
                    ASSERT_LT(use.polygon, reading.model().polygons.size());
    }
}

}  // namespace
}  // namespace svt::readers
