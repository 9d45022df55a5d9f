/// Sheets of boxes whose places on paper are known.

#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/canvas/pdf_canvas.hpp>
#include <svt/writers/canvas/pdf_layers.hpp>
#include <svt/writers/canvas/tile_path.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_files_test.hpp>
#include <svt/writers/sheet_geopackage.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/sheets/sheet_layout.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

namespace svt::writers {
namespace {

using drawing::ViewKind;

/// A volume of one wall label; drawings refer to it.
volume::SemanticVolume wallVolume() {
    volume::SemanticVolume volume = volume::test::emptyVolume({11, 11, 11}, {1, 1, 1}, {500000, 5400000, 100});
    volume.modelName = "Haus <1>";
    volume.source = "house.gml";
    volume.crsName = "urn:ogc:def:crs:EPSG::25832";
    volume::test::addObject(volume, "wall", "WallSurface");
    return volume;
}

/// A wall of `width` x `height` metres, cut.
DrawnView wallView(ViewKind kind, const std::string& name, double width, double height) {
    DrawnView view;
    view.view = {kind, name, {{0, 0, 1}, {500000, 5400000, 101}}, 0, {}};
    drawing::SectionDrawing& drawing = view.drawing;
    drawing.plane = view.view.plane;
    drawing.axes.origin = {500000, 5400000, 101};
    const drawing::Ring ring{{0, 0}, {width, 0}, {width, height}, {0, height}};
    drawing.components.push_back({0, {{ring, {}, width * height}}, width * height, 0, true, 0});
    std::vector<drawing::PlanePoint> border = ring;
    border.push_back(ring.front());
    drawing.borders.push_back({border, 0, volume::kNoLabel});
    drawing.classes.push_back({"WallSurface", 1, width * height});
    return view;
}

TEST(SheetGeoPackage, IsADatabaseOfTheSameBytesEachTime) {
    const auto volume = wallVolume();
    SheetContent content;
    content.views.push_back(wallView(ViewKind::Plan, "EG", 4, 3));
    content.views.push_back(wallView(ViewKind::Section, "A", 4, 3));
    const auto package = makeSheetGeoPackage(content, volume);
    ASSERT_TRUE(package) << package.error().message();
    EXPECT_TRUE(package->starts_with(std::string("SQLite format 3\0", 16)));
    EXPECT_EQ(package->substr(68, 4), "GPKG");  // the application id of a GeoPackage
    EXPECT_EQ(*makeSheetGeoPackage(content, volume), *package);
    // The polygons: a header with code of the CRS and extent, and the extent of the drawing itself.
    const auto header = [](std::int32_t reference, std::array<double, 4> extent) {
        std::string bytes("GP\0\3", 4);
        bytes.append(reinterpret_cast<const char*>(&reference), 4);
        bytes.append(reinterpret_cast<const char*>(extent.data()), 32);
        return bytes;
    };
    EXPECT_NE(package->find(header(25832, {500000, 500004, 5400000, 5400003})), std::string::npos);
    EXPECT_NE(package->find(header(-1, {0, 4, 0, 3})), std::string::npos);
}

TEST(TilePath, CommandsBecomeSteps) {
    const auto steps = readTilePath("M1-.5l.5.25H3v2C1 2 3 4 5 6S7 8 9 10z");
    ASSERT_EQ(steps.size(), 7u);
    EXPECT_EQ(steps[0].x, 1);
    EXPECT_EQ(steps[0].y, -0.5);
    EXPECT_EQ(steps[1].x, 1.5);
    EXPECT_EQ(steps[1].y, -0.25);
    EXPECT_EQ(steps[2].x, 3);
    EXPECT_EQ(steps[3].y, 1.75);
    EXPECT_EQ(steps[4].x2, 3);
    EXPECT_EQ(steps[5].x1, 7);  // mirrored: 2 * 5 - 3
    EXPECT_EQ(steps[5].y1, 8);
    EXPECT_EQ(steps[6].kind, TileStep::Kind::Close);
}

// Each tile of the table can be drawn, and stays on itself.
TEST(TilePath, TilesOfTheTableAreRead) {
    for (const HatchTile& tile : hatchTiles()) {
        const auto steps = readTilePath(tile.lines);
        EXPECT_GE(steps.size(), 2u);
        for (const TileStep& step : steps) {
            EXPECT_GE(step.x, -0.01);
            EXPECT_LE(step.x, tile.width + 0.01);
            EXPECT_GE(step.y, -0.01);
            EXPECT_LE(step.y, tile.height + 0.01);
        }
    }
}

TEST(SheetText, LongNamesAreShortened) {
    EXPECT_EQ(shortened("Flur", 2.5, 40), "Flur");
    const std::string longer = shortened("Größeres Besprechungszimmer im Obergeschoss", 2.5, 40);
    EXPECT_LE(widthOnPaper(longer, 2.5), 40);
    EXPECT_GT(widthOnPaper(longer, 2.5), 33);
    EXPECT_TRUE(longer.ends_with("\u2026"));
    // A character is never cut.
    EXPECT_EQ(shortened("ÄÖÜ", 2.5, widthOnPaper("Ä\u2026", 2.5) + 0.01), "Ä\u2026");
}

TEST(SheetLayout, ViewsStandInsideTheFrameAndApart) {
    SheetContent content;
    for (int n = 0; n < 4; ++n) content.views.push_back(wallView(ViewKind::Elevation, "north", 8, 3 + n));
    const auto layout = layOutSheets(content, {});
    ASSERT_TRUE(layout);
    EXPECT_EQ(layout->scale, 100);
    ASSERT_EQ(layout->sheets.size(), 1u);
    std::vector<std::array<double, 4>> boxes;
    for (const PlacedView& placed : layout->sheets[0].views) {
        const double left = placed.place.corner.x, bottom = placed.place.corner.y;
        EXPECT_NEAR(placed.width, 80, 1e-9);
        EXPECT_GT(left, layout->paper.left);
        EXPECT_LT(left + placed.width, layout->paper.right);
        EXPECT_GT(bottom - placed.height, layout->paper.top);
        EXPECT_LT(bottom, layout->paper.bottom - SheetPaper::kTitleHeight);
        for (const auto& other : boxes)
            EXPECT_TRUE(left > other[2] || left + placed.width < other[0] || bottom < other[1] ||
                        bottom - placed.height > other[3]);
        boxes.push_back({left, bottom - placed.height, left + placed.width, bottom});
    }
}

TEST(SheetLayout, RowsHaveAboutAsManyViews) {
    SheetContent content;
    // Three would fit into a row of 390 mm, and no second row under 180 mm.
    for (int n = 0; n < 4; ++n) content.views.push_back(wallView(ViewKind::Elevation, "north", 9, 15));
    content.views.push_back(wallView(ViewKind::Plan, "EG", 9, 9));
    const auto layout = layOutSheets(content, {});
    ASSERT_TRUE(layout);
    ASSERT_EQ(layout->sheets.size(), 3u);
    EXPECT_EQ(layout->sheets[0].views.size(), 2u);
    EXPECT_EQ(layout->sheets[1].views.size(), 2u);
    EXPECT_EQ(layout->sheets[2].kind, ViewKind::Plan);
}

TEST(SheetLayout, TheScaleFollowsTheLargestView) {
    SheetContent content;
    content.views.push_back(wallView(ViewKind::Plan, "EG", 60, 30));
    EXPECT_EQ(layOutSheets(content, {})->scale, 200);
    EXPECT_EQ(layOutSheets(content, {.scale = 0, .paper = "A1"})->scale, 100);
    const auto tooLarge = layOutSheets(content, {.scale = 100, .paper = "A3"});
    ASSERT_FALSE(tooLarge);
    EXPECT_EQ(tooLarge.error().code(), Code::BadArgument);
    EXPECT_NE(tooLarge.error().message().find("A1 is large enough"), std::string::npos) << tooLarge.error().message();
    const auto never = layOutSheets(content, {.scale = 10, .paper = "A3"});
    ASSERT_FALSE(never);
    EXPECT_NE(never.error().message().find("1:200 would do"), std::string::npos) << never.error().message();
    EXPECT_EQ(layOutSheets(content, {.scale = 0, .paper = "A5"}).error().code(), Code::BadArgument);
    EXPECT_EQ(layOutSheets(content, {.scale = -1, .paper = "A3"}).error().code(), Code::BadArgument);
}

TEST(SvgSheets, AreToScaleWithFrameAndTitle) {
    const volume::SemanticVolume volume = wallVolume();
    SheetContent content;
    content.levels.push_back({"EG", 0.5});
    content.views.push_back(wallView(ViewKind::Plan, "EG", 4, 3));
    content.views.back().view.floor = 0.5;
    const auto sheets = makeSvgSheets(content, volume, {.scale = 50, .paper = "A4"});
    ASSERT_TRUE(sheets);
    ASSERT_EQ(sheets->size(), 1u);
    const SvgFile svg(sheets->front());
    EXPECT_EQ(svg.text("/svg/@width"), "297mm");
    EXPECT_EQ(svg.text("/svg/@height"), "210mm");
    EXPECT_EQ(svg.text("/svg/@viewBox"), "0 0 297 210");
    // 4 x 3 m at 1:50 in the middle of the area of 267 x 154 mm: 80 x 60 mm.
    const auto layout = layOutSheets(content, {.scale = 50, .paper = "A4"});
    const PaperPoint low = layout->sheets[0].views[0].place.corner;
    EXPECT_NEAR(low.x, 20 + 0.5 * (267 - 80), 1e-9);
    const std::string outline =
        fmt::format("M{:g} {:g}L{:g} {:g} {:g} {:g}", low.x, low.y, low.x + 80, low.y, low.x + 80, low.y - 60);
    EXPECT_GT(svg.count("//path[starts-with(@d, '" + outline + "')]"), 0u) << sheets->front();
    for (const char* text : {"Haus <1>", "1:50", "Plan EG, level \u00B10.00", "1 of 1", "A4", "house.gml, EPSG:25832"})
        EXPECT_GT(svg.count(fmt::format("//text[.='{}']", text)), 0u) << text;
    EXPECT_EQ(svg.count("//path[@fill='url(#masonry)']"), 2u) << "the wall, and its hatch in the legend";
    EXPECT_EQ(svg.count("//g[@inkscape:label='Outlines']"), 1u);
    EXPECT_EQ(*sheets, *makeSvgSheets(content, volume, {.scale = 50, .paper = "A4"}));
}

TEST(DimensionText, IsThatOfArchitects) {
    EXPECT_EQ(dimensionText(3.26), "3.26");
    EXPECT_EQ(dimensionText(3.2649), "3.26\u2075");
    EXPECT_EQ(dimensionText(0.365), "36\u2075");
    EXPECT_EQ(dimensionText(0.24), "24");
    EXPECT_EQ(dimensionText(0.9996), "1.00");
    EXPECT_EQ(dimensionText(12.005), "12.00\u2075");
}

TEST(DimensionMarks, NumbersOfOtherUnits) {
    using drawing::DimensionUnit;
    EXPECT_EQ(dimensionText(3.265, DimensionUnit::Millimetres), "3265");
    EXPECT_EQ(dimensionText(3.265, DimensionUnit::Centimetres), "326.5");
    EXPECT_EQ(dimensionText(0.24, DimensionUnit::Centimetres), "24");
    EXPECT_EQ(dimensionText(0.24, DimensionUnit::Metres), "0.24");
    EXPECT_EQ(dimensionText(3.265, DimensionUnit::Metres), "3.26\u2075");
    EXPECT_EQ(dimensionText(3.048, DimensionUnit::FeetInches), "10'-0\"");
    EXPECT_EQ(dimensionText(3.2639, DimensionUnit::FeetInches), "10'-8 1/2\"");
    EXPECT_EQ(dimensionText(0.2397, DimensionUnit::FeetInches), "9 7/16\"");
    EXPECT_EQ(dimensionText(0.0127, DimensionUnit::FeetInches), "1/2\"");
    EXPECT_EQ(dimensionText(0, DimensionUnit::FeetInches), "0'-0\"");
    EXPECT_EQ(dimensionText(0.3047, DimensionUnit::FeetInches), "1'-0\"") << "11 31/32 inches are rounded up";
}

// A part of 12 cm is 1.2 mm long at 1:100, its number 3 mm wide.
TEST(DimensionMarks, ANumberWiderThanItsPartHasALeader) {
    drawing::SectionDrawing drawing;
    drawing.dimensions.push_back({drawing::DimensionSide::Below, 0, {0, 3, 3.12, 6}});
    const DimensionMarks placed = placeDimensions(drawing, {{0, 0}, {6, 6}}, 10);
    ASSERT_EQ(placed.marks.size(), 3u);
    EXPECT_EQ(placed.marks[0].feet.size(), 2u);
    ASSERT_EQ(placed.marks[1].feet.size(), 3u);
    EXPECT_EQ(placed.marks[1].text.text, "12");
    const MarkLine& leader = placed.marks[1].feet.back();
    EXPECT_NEAR(leader.from.u, 30.6, 1e-9) << "the middle of the part";
    EXPECT_EQ(leader.from.v, placed.marks[1].line.from.v);
    EXPECT_NEAR(leader.to.u, placed.marks[1].text.at.u, 1e-9);
    EXPECT_GT(placed.marks[1].text.at.v, placed.marks[0].text.at.v);
}

TEST(DimensionMarks, RoomsAndOpeningsHaveNumbersThatDoNotMeet) {
    drawing::SectionDrawing drawing;
    drawing.roomDimensions = {{0, {0, 1}, {4, 1}}, {0, {1, 0}, {1, 5}}, {1, {5, 1}, {5.3, 1}}};
    drawing.openings = {{2, {2, 0}, {0, -1}, 0.9, 2.135, true}, {3, {0, 2}, {-1, 0}, 0, 2.01, true}};
    const DimensionMarks placed = placeDimensions(drawing, {{0, 0}, {6, 6}}, 10, {"BRH", "STH"});
    ASSERT_EQ(placed.marks.size(), 2u);
    EXPECT_EQ(placed.marks[0].text.text, "4.00");
    EXPECT_EQ(placed.marks[1].text.text, "5.00");
    EXPECT_EQ(placed.withoutPlace, 1u) << "0.3 m are 3 mm, too narrow";
    ASSERT_EQ(placed.heights.size(), 3u);
    EXPECT_EQ(placed.heights[0].text, "BRH 90");
    EXPECT_EQ(placed.heights[1].text, "STH 2.13\u2075");
    EXPECT_EQ(placed.heights[2].text, "STH 2.01");
    EXPECT_TRUE(placed.heights[2].isUpright);
    EXPECT_LT(placed.heights[0].at.v, 0) << "outside of the wall";
}

// The edge of a roof runs along the wall, 2 mm before it on paper. Before, it struck the heights of the window out.
TEST(DimensionMarks, HeightsOfOpeningsAvoidLines) {
    drawing::SectionDrawing drawing;
    drawing.openings = {{2, {2, 0}, {0, -1}, 0.9, 2.135, true}};
    drawing.beyond = {{{-1, -0.2}, {6, -0.2}, 0, drawing::BeyondKind::Above}};
    const DimensionMarks placed = placeDimensions(drawing, {{0, 0}, {6, 6}}, 10);
    ASSERT_EQ(placed.heights.size(), 2u);
    for (const MarkText& text : placed.heights) EXPECT_LT(text.at.v + 0.73 * text.size, -2) << text.text;
}

// Numbers of any chain stand apart from each other, and inside of the room that the chains take.
TEST(DimensionMarks, NoNumberStandsOnAnother) {
    drawing::SectionDrawing drawing;
    unsigned state = 7;
    const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 16; };
    for (const auto side : {drawing::DimensionSide::Below, drawing::DimensionSide::Left})
        for (int row = 0; row < 3; ++row) {
            drawing::DimensionChain chain{side, row, {0}};
            while (chain.stops.back() < 20) chain.stops.push_back(chain.stops.back() + 0.02 + 0.001 * (next() % 1500));
            drawing.dimensions.push_back(chain);
        }
    for (const double millimetres : {2.0, 5.0, 10.0, 20.0}) {
        const DimensionMarks placed = placeDimensions(drawing, {{0, 0}, {20, 20}}, millimetres);
        std::vector<std::array<double, 5>> boxes;
        for (const DimensionMark& mark : placed.marks) {
            ASSERT_FALSE(mark.text.text.empty());
            const double half = 0.5 * widthOnPaper(mark.text.text, mark.text.size), high = 0.73 * mark.text.size;
            const auto at = mark.text.at;
            const std::array<double, 5> box = mark.text.isUpright
                                                  ? std::array{1.0, at.u - high, at.v - half, at.u, at.v + half}
                                                  : std::array{0.0, at.u - half, at.v, at.u + half, at.v + high};
            for (const auto& other : boxes)
                EXPECT_TRUE(box[0] != other[0] || box[1] >= other[3] || box[3] <= other[1] || box[2] >= other[4] ||
                            box[4] <= other[2])
                    << millimetres << " " << mark.text.text;
            boxes.push_back(box);
            const double reach = dimensionReach(drawing, drawing::DimensionSide::Below);
            EXPECT_GT(mark.text.isUpright ? box[1] : box[2], -reach - 1.5);
        }
        EXPECT_GT(boxes.size(), 20u);
        EXPECT_EQ(boxes.size(), placed.marks.size());
        EXPECT_EQ(placed.withoutPlace, 0u);
    }
}

// A table longer than a sheet goes on beside it; the last row is a sum.
TEST(SheetTables, GoOnBesideThemselvesAndOnTheNextSheet) {
    SheetContent content;
    content.views.push_back(wallView(ViewKind::Plan, "EG", 4, 3));
    SheetTable table{"Rooms", {{"No.", false}, {"Area", true}}, {}, 1};
    for (int n = 0; n < 400; ++n) table.rows.push_back({fmt::format("{}", n), fmt::format("{}.00", 3 * n)});
    content.tables.push_back(table);
    const auto layout = layOutSheets(content, {});
    ASSERT_TRUE(layout);
    std::size_t next = 0;
    for (const Sheet& sheet : layout->sheets)
        for (const PlacedTable& placed : sheet.tables) {
            EXPECT_EQ(placed.firstRow, next);
            next = placed.endRow;
            EXPECT_LE(placed.left + placed.width(), layout->paper.right);
            const double rows = static_cast<double>(placed.endRow - placed.firstRow + 1);
            EXPECT_LE(placed.top + PlacedTable::kTitle + rows * PlacedTable::kRow,
                      layout->paper.bottom - SheetPaper::kTitleHeight);
        }
    EXPECT_EQ(next, 400u);
    EXPECT_GT(layout->sheets[1].tables.size(), 1u);
    const auto german = makeSvgSheets(content, wallVolume(), {0, "A3", SheetLanguage::German, "Haus am See"});
    ASSERT_TRUE(german);
    EXPECT_EQ(SvgFile(german->front()).count("//text[.='Haus am See']"), 1u);
    EXPECT_EQ(SvgFile(german->front()).count("//text[.='Ma\u00DFstab']"), 1u);
    EXPECT_EQ(SvgFile(german->back()).count("//text[.='1197.00']"), 1u);
}

TEST(SheetGroups, HaveAScaleAndTitleOfTheirOwn) {
    SheetContent content;
    content.groups = {{"Details", 20}, {"", 0}};
    content.views.push_back(wallView(ViewKind::Plan, "EG", 4, 3));
    content.views.push_back(wallView(ViewKind::Section, "A", 4, 3));
    content.views.push_back(wallView(ViewKind::Plan, "OG", 4, 3));
    for (std::size_t n = 0; n < 3; ++n) content.views[n].group = n < 2 ? 0 : 1;
    const auto layout = layOutSheets(content, {});
    ASSERT_TRUE(layout);
    ASSERT_EQ(layout->sheets.size(), 3u);  // two drawings of 200 mm do not fit beside each other
    EXPECT_EQ(layout->sheets[0].scale, 20);
    EXPECT_NEAR(layout->sheets[0].views[0].width, 200, 1e-9);
    EXPECT_EQ(layout->sheets[2].scale, 100);
    const auto sheets = makeSvgSheets(content, wallVolume(), {});
    EXPECT_EQ(SvgFile(sheets->front()).count("//text[.='Details']"), 1u);
    EXPECT_GT(SvgFile(sheets->front()).count("//text[.='1:20']"), 0u);
    content.groups[0].scale = 5;
    const auto tooLarge = layOutSheets(content, {});
    ASSERT_FALSE(tooLarge);
    EXPECT_NE(tooLarge.error().message().find("its scale of 1:5"), std::string::npos) << tooLarge.error().message();
}

TEST(PdfSheets, HaveAPageEachAndTheSameBytes) {
    if (!makePdfCanvas("")) GTEST_SKIP() << "no cairo";
    const volume::SemanticVolume volume = wallVolume();
    SheetContent content;
    content.views.push_back(wallView(ViewKind::Plan, "EG", 4, 3));
    content.views.push_back(wallView(ViewKind::Section, "A", 4, 3));
    const auto pdf = makePdfSheets(content, volume, {.scale = 50, .paper = "A4"});
    ASSERT_TRUE(pdf);
    EXPECT_TRUE(pdf->bytes.starts_with("%PDF-"));
    EXPECT_EQ(pdf->bytes, makePdfSheets(content, volume, {.scale = 50, .paper = "A4"})->bytes);
}

// More sheets than a batch of one thread, each painted once for both formats.
TEST(SheetFiles, AreThoseOfEachFormat) {
    if (!makePdfCanvas("")) GTEST_SKIP() << "no cairo";
    const volume::SemanticVolume volume = wallVolume();
    SheetContent content;
    for (int n = 0; n < 11; ++n) {
        content.views.push_back(wallView(n % 2 == 0 ? ViewKind::Plan : ViewKind::Section, "A", 4, 3));
        content.views.back().group = n;
        content.groups.push_back({});
    }
    const SheetOptions options{.scale = 50, .paper = "A4"};
    const auto svg = makeSvgSheets(content, volume, options);
    const auto pdf = makePdfSheets(content, volume, options);
    ASSERT_TRUE(svg && pdf);
    ASSERT_EQ(svg->size(), 11u);
    for (const int threads : {1, 2, 5}) {
        const auto files = makeSheetFiles(content, volume, options, true, threads);
        ASSERT_TRUE(files);
        EXPECT_EQ(files->svg, *svg) << threads;
        EXPECT_EQ(files->pdf.bytes, pdf->bytes) << threads;
    }
    EXPECT_EQ(makeSheetFiles(content, volume, options, false)->pdf.bytes, "");
    EXPECT_FALSE(makeSheetFiles(content, volume, {.scale = 1, .paper = "A4"}, true));
}

TEST(PdfSheets, JoinPagesOfPartsAndRefuseWhatIsNoPdf) {
    if (!missingPdfLayers().empty()) GTEST_SKIP() << missingPdfLayers();
    const PdfPart part{true, "Cut"};
    const auto joined = joinPdfLayers("no PDF at all", std::span(&part, 1));
    ASSERT_FALSE(joined);
    EXPECT_EQ(joined.error().code(), Code::CannotWrite);
    EXPECT_NE(joined.error().message().find("qpdf"), std::string::npos);
}

TEST(SectionPdf, RefusesScalesThatPdfCannotHold) {
    const DrawnView view = wallView(ViewKind::Plan, "EG", 4, 3);
    for (const double scale : {0.0, 0.2}) {
        const auto pdf = makeSectionPdf(view.drawing, wallVolume(), scale);
        ASSERT_FALSE(pdf);
        EXPECT_EQ(pdf.error().code(), Code::BadArgument) << pdf.error().message();
    }
}

}  // namespace
}  // namespace svt::writers
