/// Drawings, sheets, registers and tables of the generated models against approved ones in tests/golden/writers.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/land_administration.hpp>
#include <svt/analyze/owners.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/footprints.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/pipeline/sample_models_test.hpp>
#include <svt/record/options_text_test.hpp>
#include <svt/samples/approved_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/approved/file_record_test.hpp>
#include <svt/writers/draw_sheets.hpp>
#include <svt/writers/drawing_formats.hpp>
#include <svt/writers/feature_layer.hpp>
#include <svt/writers/ladm_writer.hpp>
#include <svt/writers/office_sheets.hpp>
#include <svt/writers/sheet_geopackage.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/unit_report.hpp>
#include <svt/writers/view_drawing.hpp>
#include <svt/writers/volume_formats.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using samples::SampleFormat, samples::SampleKind;
using volume::SemanticVolume;

std::string ofResult(const std::string& name, const Result<std::string>& made) {
    return made ? approved::ofBytes(name, *made) : name + ": " + std::string(made.error().message()) + '\n';
}
std::string ofResult(const std::string& name, const Result<PdfFile>& made) {
    return made ? ofResult(name, Result<std::string>(made->bytes)) : ofResult(name, Result<std::string>(made.error()));
}

const SemanticVolume& drawnHouse() {
    static const SemanticVolume house = test::volumeOfSample(SampleKind::House, SampleFormat::Ifc4, 0.2);
    return house;
}

const SemanticVolume& registeredTower() {
    static const SemanticVolume tower = [] {
        samples::SampleOptions options;
        options.storeys = 2;
        options.turnDegrees = 10;
        return test::volumeOfSample(SampleKind::Tower, SampleFormat::CityGml3, 0.3, options);
    }();
    return tower;
}

drawing::SectionOptions allOfIt() {
    drawing::SectionOptions options;
    options.beyond = {.visible = true, .hidden = true, .above = true};
    options.dimensions = true;
    return options;
}

TEST(ApprovedDocuments, DrawingsInAllFormats) {
    const SemanticVolume& house = drawnHouse();
    std::string text;
    for (const char* const plane : {"z=1.4", "z=4.2", "y=4", "2,1,0,-14"}) {
        const auto drawn = drawing::drawSection(house, *drawing::parseSectionPlane(plane, house), allOfIt());
        ASSERT_TRUE(drawn) << drawn.error().toString();
        text += std::string("== ") + plane + '\n';
        for (const char* const format : {"svg", "dxf", "geojson", "csv", "json"})
            text += ofResult(format, makeDrawing(*drawn, house, format));
        for (const bool isWorld : {false, true})
            text += ofResult("iso dxf", makeDrawing(*drawn, house, "dxf", {50, {.isoLayers = true, .world = isWorld}}));
        text += ofResult("svg 1:20", makeDrawing(*drawn, house, "svg", {20, {}}));
        text += ofResult("svg 1:500", makeDrawing(*drawn, house, "svg", {500, {}}));
        text += ofResult("pdf", makeSectionPdf(*drawn, house, 100));
    }
    test::expectApproved("writers/drawings", text);
}

TEST(ApprovedDocuments, Options) {
    test::expectApproved("writers/options",
                         record::optionsText<VolumeWriteOptions>() + record::optionsText<CityGmlWriteOptions>() +
                             record::optionsText<ZarrWriteOptions>() + record::optionsText<PrecomputedWriteOptions>() +
                             record::optionsText<TilesetWriteOptions>() + record::optionsText<VdbWriteOptions>() +
                             record::optionsText<BoxWriteOptions>() + record::optionsText<DxfOptions>());
}

TEST(ApprovedDocuments, DimensionsInAllUnits) {
    const SemanticVolume& house = drawnHouse();
    std::string text;
    for (const auto& [unit, name] : drawing::namesOf(drawing::DimensionUnit{})) {
        drawing::SectionOptions options = allOfIt();
        options.dimensionUnit = unit;
        const auto drawn = drawing::drawSection(house, *drawing::parseSectionPlane("z=1.4", house), options);
        ASSERT_TRUE(drawn);
        text += ofResult(std::string(name), makeDrawing(*drawn, house, "svg"));
    }
    test::expectApproved("writers/dimensions", text);
}

std::string sheetsOf(const SemanticVolume& volume, drawing::SheetSet set) {
    auto content = drawSheets(set, volume, 1);
    EXPECT_TRUE(content) << content.error().toString();
    if (!content) return {};
    const SheetOptions options = sheetOptionsOf(set);
    std::string text;
    const auto sheets = makeSvgSheets(*content, volume, options);
    if (!sheets) return std::string(sheets.error().message()) + '\n';
    for (const std::string& sheet : *sheets) text += approved::ofBytes("sheet", sheet);
    const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(volume);
    for (std::size_t view = 0; view < content->views.size(); ++view)
        text += ofResult("dxf", makeSheetDxf(*content, view, volume, options, {}, isAround));
    const auto paper = smallestPaper(*content, volume, options);
    text += paper ? *paper + '\n' : std::string(paper.error().message()) + '\n';
    if (content->openings) text += makeCsv(openingTable(*content->openings, content->levels, volume.labels));
    text += ofResult("pdf", makePdfSheets(*content, volume, options));
    return text + ofResult("gpkg", makeSheetGeoPackage(*content, volume));
}

TEST(ApprovedDocuments, SheetsOfAHouse) {
    drawing::SheetSet set;
    std::string text = sheetsOf(drawnHouse(), set);
    set.language = "de";
    set.scale = 50;
    set.paper = "A1";
    set.title = "Haus \"A\" & <B>";
    set.titleBlock = {
        "4711-3",      "Office of architecture", "A. Prover", "An owner with a long name", "2026-03-01", "C",
        "Construction"};
    text += "== de\n" + sheetsOf(drawnHouse(), set);
    test::expectApproved("writers/sheets_of_house", text);
}

TEST(ApprovedDocuments, SheetsOfATower) {
    test::expectApproved("writers/sheets_of_tower", sheetsOf(registeredTower(), {}));
}

drawing::LineView parallelView(const SemanticVolume& volume) {
    render::FrameSpec frame;
    frame.width = 640;
    frame.height = 480;
    frame.camera.eye = volume.grid.origin() + Vec3d{-30, -40, 35};
    frame.camera.target = volume.grid.origin() + Vec3d{8, 8, 3};
    frame.camera.projection = render::Camera::Projection::Orthographic;
    render::Pass pass;
    pass.styles.resize(volume.labels.scalarCount());
    frame.passes.push_back(pass);
    auto view = drawing::drawLineView(volume, frame, {.hidden = true});
    EXPECT_TRUE(view) << view.error().toString();
    return view ? std::move(*view) : drawing::LineView{};
}

TEST(ApprovedDocuments, RegistersOfATower) {
    const SemanticVolume& tower = registeredTower();
    const auto administration = analyze::makeLandAdministration(tower, nullptr, "");
    ASSERT_TRUE(administration) << administration.error().toString();
    const drawing::LineView view = parallelView(tower);
    std::vector<std::uint32_t> spaces;
    for (const auto& unit : administration->units) spaces.push_back(unit.space);
    std::string text = ofResult("citygml", makeLadmCityGml(*administration, tower)) +
                       ofResult("cityjson", makeLadmCityJson(*administration, tower)) +
                       ofResult("ifc", makeLadmIfc(*administration, tower)) +
                       ofResult("gpkg", makeLadmGeoPackage(*administration, tower)) +
                       ofResult("reports", makeUnitReports(*administration, spaces, tower, &view, 1)) +
                       ofResult("reports", makeUnitReports(*administration, spaces, tower, nullptr, 1));
    text += ofResult("view svg", makeViewSvg(view, tower, 180)) + ofResult("view pdf", makeViewPdf(view, tower, 180));
    test::expectApproved("writers/registers_of_tower", text);
}

// Two flats that touch, and a third above a gap; rights of each class, with documents.
TEST(ApprovedDocuments, RegistersOfATableOfOwners) {
    SemanticVolume volume = volume::test::emptyVolume({24, 20, 16}, {0.5, 0.5, 0.5}, {1000, 2000, 100});
    volume.modelName = "Flats <1>";
    volume.source = "flats.gml";
    volume.crsName = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783";
    volume::test::addGroup(volume, "house", "Building").name = "House & yard";
    volume::test::addObject(volume, "a", "BuildingUnit", 0).name = "Flat A";
    volume::test::addObject(volume, "b", "BuildingUnit", 0);
    volume::test::addObject(volume, "c", "BuildingUnit", 0).name = "Common hall";
    volume::test::addObject(volume, "slab", "BuildingConstructiveElement", 0);
    volume::test::addBoxMesh(volume, 1, {0.5, 0.5, 0.5}, {4.5, 6.5, 3.5});
    volume::test::addBoxMesh(volume, 2, {4.5, 0.5, 0.5}, {8.5, 6.5, 3.5});
    volume::test::addBoxMesh(volume, 3, {0.5, 0.5, 3.8}, {8.5, 5.5, 6.8});
    volume::test::addBoxMesh(volume, 4, {0.5, 0.5, 3.5}, {8.5, 6.5, 3.8});
    for (std::uint32_t l = 1; l < 5; ++l) volume.labels.labels[l].filling = volume::Filling::Solid;
    volume.labels.labels[1].volume = 72;
    volume.labels.labels[2].volume = 72;
    volume.labels.labels[3].volume = 120;
    volume.labels.labels[4].volume = 14.4;
    volume::test::paintBoxes(volume,
                             {{1, {1, 1, 1}, {9, 13, 7}}, {2, {9, 1, 1}, {17, 13, 7}}, {3, {1, 1, 8}, {17, 11, 14}}});
    const auto table = analyze::parseOwners(
        "feature,owner,share,right,source\na,Ann & Co,1/3,,deed 1\na,Bob,2/3,,deed 1\n"
        "b,Bob,,,\nb,Bank,,mortgage,deed <2>\nc,Ann & Co,0.123456789,,\n",
        "owners.csv", volume.labels);
    ASSERT_TRUE(table) << table.error().toString();
    const auto administration = analyze::makeLandAdministration(volume, &*table, "owners.csv");
    ASSERT_TRUE(administration) << administration.error().toString();
    const std::vector<std::uint32_t> spaces{0, 1, 2};
    test::expectApproved("writers/registers_of_flats",
                         ofResult("citygml", makeLadmCityGml(*administration, volume)) +
                             ofResult("cityjson", makeLadmCityJson(*administration, volume)) +
                             ofResult("ifc", makeLadmIfc(*administration, volume)) +
                             ofResult("gpkg", makeLadmGeoPackage(*administration, volume)) +
                             ofResult("reports", makeUnitReports(*administration, spaces, volume, nullptr, 1)));
}

Table tableOfAllTypes() {
    Table table;
    table.columns = {{"id", "id"},
                     {"whole", "n", 3, CellType::Whole},
                     {"number", "m", 2, CellType::Number},
                     {"small", "m2", 1, CellType::SmallNumber},
                     {"truth", "", 3, CellType::Truth},
                     {"blob", "", 3, CellType::Blob}};
    for (int n = 0; n < 20; ++n)
        table.rows.push_back({"row " + std::to_string(n), n * n - 7, n % 3 == 0 ? Cell() : Cell(n / 7.0),
                              static_cast<float>(n) / 3, n % 2 == 0, Blob{std::string(std::size_t(n), 'x')}});
    table.rows.push_back({Cell(), Cell(), Cell(), Cell(), Cell(), Cell()});
    table.notes = {{"crs", "EPSG:25832"}, {"source", "a \"b\""}};
    return table;
}

TEST(ApprovedDocuments, TablesInAllFormats) {
    const Table table = tableOfAllTypes();
    std::string text = makeText(table) + makeJson(table) + makeCsv(table) + csvHeader(table.columns, CsvForm::Stream);
    for (const Row& row : table.rows) text += csvLine(row, CsvForm::Stream);
    test::expectApproved("writers/tables", text + ofResult("parquet", makeParquet(table)));
}

TEST(ApprovedDocuments, LayersOfFeaturesInAllFormats) {
    const std::vector<Attribute> attributes{
        {"use", std::string("home"), "", 0},    {"use", std::string("shop"), "", 1},
        {"flood/depth", 0.5, "m", 0},           {"flood/depth", 1.5, "m", 1},
        {"flood/rank", std::int64_t{2}, "", 1}, {"year", std::int64_t{1985}, "", 0}};
    const auto lists = attributeLists(attributes);
    const drawing::PlanPolygon court{{{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, {{2, 2}, {2, 4}, {6, 4}, {6, 2}}}};
    const drawing::PlanPolygon shed{{{{9, 0}, {10, 0}, {10, 1}}}};
    const std::vector<drawing::PlanPolygon> both{court, shed};
    std::string text;
    for (const char* const crs : {"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", "unknown"})
        for (const char* const ending : {"csv", "geojson", "gpkg", "parquet"}) {
            const test::TemporaryFolder folder;
            Table table = tableOfAllTypes();
            const FeatureLayer::Options options{.hasLists = true, .hasRoofs = true};
            auto layer = FeatureLayer::create(folder / (std::string("a.") + ending), table.columns, crs, options);
            ASSERT_TRUE(layer) << layer.error().toString();
            for (std::size_t n = 0; n < 5; ++n) {
                FeatureLayer::Feature feature{table.rows[n], {}, {}, {}};
                if (n == 1) feature.footprint = both;
                if (n == 2) feature.footprint = std::span(&shed, 1), feature.roof = std::span(&court, 1);
                if (n == 3) feature.lists = lists;
                ASSERT_TRUE((*layer)->add(feature));
            }
            ASSERT_TRUE((*layer)->finish());
            text += std::string("== ") + ending + '\n' + approved::ofFile(folder.path(), "");
        }
    test::expectApproved("writers/features", text);
}

}  // namespace
}  // namespace svt::writers
