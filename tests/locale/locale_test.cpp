/// The library in a host whose locale has a decimal comma, as German ones do: every text, picture and file is that of the
/// "C" locale.

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/illustrate/motion.hpp>
#include <svt/illustrate/pick_ray.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/svg_drawing.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <span>
#include <sstream>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using drawing::SheetView;

/// Numbers of C++ streams, which have a locale of their own.
struct CommaNumbers : std::numpunct<char> {
protected:
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

/// The locale with a comma for C and C++, as long as the object is there.
class CommaLocale {
public:
    explicit CommaLocale(const fs::path& folder) {
        const fs::path source = fs::path(kSourceRoot) / "tests/locale/comma.locale";
        const std::string command = fmt::format("localedef -c --no-archive -i '{}' '{}' >'{}' 2>&1", source.string(),
                                                (folder / "comma").string(), (folder / "log").string());
        // It warns of the categories that are missing.
        [[maybe_unused]] const int status = std::system(command.c_str());
        ::setenv("LOCPATH", folder.c_str(), 1);
        std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
        EXPECT_NE(std::setlocale(LC_NUMERIC, "comma"), nullptr) << command;
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;
    ~CommaLocale() {
        std::locale::global(std::locale::classic());
        std::setlocale(LC_NUMERIC, "C");
        ::unsetenv("LOCPATH");
    }
};

std::string bytesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What the library says and writes, by name.
class Answers {
public:
    explicit Answers(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

    std::map<std::string, std::string> all() {
        for (const auto& [format, file] : {std::pair(samples::SampleFormat::CityGml3, "house.gml"),
                                           std::pair(samples::SampleFormat::CityJson2, "house.city.json"),
                                           std::pair(samples::SampleFormat::Ifc4, "house.ifc")})
            addModel(format, file);
        const auto volume = houseVolume();
        if (!volume) return answers_;
        addPlanes(*volume);
        addScenes(*volume);
        addDrawings(*volume);
        addSheets(*volume);
        addFiles(*volume);
        addIndoorGraph();
        return answers_;
    }

private:
    void add(const std::string& name, std::string text) { answers_.emplace(name, std::move(text)); }
    template <class T>
    bool isGood(const std::string& name, const Result<T>& result) {
        if (!result) add(name, result.error().toString());
        EXPECT_TRUE(result) << name << ": " << result.error().toString();
        return result.hasValue();
    }

    void addModel(samples::SampleFormat format, const std::string& file) {
        const auto text = samples::writeSample(samples::SampleKind::House, format, {});
        if (!isGood(file, text)) return;
        add(file, *text);
        std::ofstream(folder_ / file, std::ios::binary) << *text;
        Diagnostics log;
        const auto model = readers::readModel(folder_ / file, {}, &log);
        if (!isGood("model of " + file, model)) return;
        std::string summary;
        for (const auto& feature : model->features) {
            summary += fmt::format("{} {}\n", feature.className, feature.id);
            for (const Attribute& a : feature.attributes) summary += fmt::format("{}={}\n", a.name, toText(a.value));
        }
        for (const Diagnostic& finding : log.items()) summary += finding.message + "\n";
        add("model of " + file, summary);
    }

    // Weights of the graph that addFiles() has written.
    void addIndoorGraph() {
        const auto model = readers::readModel(folder_ / "volume.indoor.gml");
        if (!isGood("graph", model)) return;
        std::string weights;
        for (const auto& feature : model->features)
            for (const Attribute& a : feature.attributes)
                if (a.name == "weight") weights += toText(a.value) + " ";
        EXPECT_NE(weights.find('.'), std::string::npos) << weights;
        add("graph", weights);
    }

    Result<volume::SemanticVolume> houseVolume() {
        pipeline::BuildOptions options;
        options.spacing = Vec3d{0.25, 0.25, 0.25};
        options.vectors.meshes = true;
        options.vectors.edges = true;
        const fs::path file = folder_ / "house.gml";
        auto built = pipeline::buildVolume(std::span(&file, 1), options);
        if (!isGood("volume", built)) return built.error();
        return std::move(built->volume);
    }

    void addPlanes(const volume::SemanticVolume& volume) {
        for (const std::string text : {"z=1.25", "x<2.5", "z=abs(101.5)", "0.5,0.25,1.5,-3.25", "0.5, 0.25, 1.5, -3.25",
                                       "storey='Ground floor'+1.1"}) {
            const auto plane = drawing::parseSectionPlane(text, volume);
            const auto show = [](Vec3d v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
            add("plane " + text, plane ? show(plane->normal) + " at " + show(plane->point) : plane.error().toString());
        }
        const auto ray = illustrate::parsePickRay("-0.5,2.5,1.25:1.5,0.25,0.125", volume.grid);
        if (isGood("ray", ray)) add("ray", fmt::format("{} {}", ray->direction.y, ray->direction.z));
    }

    void addScenes(const volume::SemanticVolume& volume) {
        const std::pair<const char*, const char*> scenes[] = {
            {"region", R"json("passes": [{"cut": "z>2.25 or box(0.5, 0.5, 0.5, 2.5,2.5,2.5) or ball(4.5,4.5,1.5,0.75)",
                           "styles": [{"select": "class=BuildingRoom", "opacity": 0.22}]}])json"},
            {"colours", R"json("colorBy": "volume", "title": "1.5", "passes": [{"cut": "z>1.35"}])json"},
            {"lines", R"json("lines": {"strength": 0.35, "width": 1.5}, "hatches": {"spacing": 0.15},
                         "passes": [{"meshes": ["size<1.5"], "lines": [{"width": 1.25}], "cut": "x>3.75"}])json"},
            {"key", R"json("passes": [{"cut": "z>4.5"}],
                "motion": {"seconds": 4, "keys": [{"at": 3.5, "scene": {"passes": [{"cut": "z>1.25"}]}}]})json"}};
        illustrate::ScenePainter painter(volume, 1);
        for (const auto& [name, members] : scenes) {
            const std::string text =
                fmt::format(R"({{"format": "svt-scene", "version": 1, "size": [160, 120], {}}})", members);
            const auto scene = illustrate::parseScene(text);
            if (!isGood(name, scene)) continue;
            const std::string written = illustrate::writeScene(*scene);
            add(std::string("scene ") + name, written);
            const auto again = illustrate::parseScene(written);
            EXPECT_TRUE(again && *again == *scene) << written;
            const auto moved = illustrate::sceneAt(*scene, 1.5, volume);
            if (!isGood(std::string("moved ") + name, moved)) continue;
            const auto painting = painter.paint(*moved);
            if (!isGood(std::string("picture ") + name, painting)) continue;
            const auto pixels = std::as_bytes(std::span(painting->frame.color.pixels()));
            add(std::string("picture ") + name,
                std::string(reinterpret_cast<const char*>(pixels.data()), pixels.size()));
        }
    }

    void addDrawings(const volume::SemanticVolume& volume) {
        const auto plane = drawing::parseSectionPlane("z=1.2", volume);
        if (!isGood("plane of the drawing", plane)) return;
        const auto drawing = drawing::drawSection(volume, *plane);
        if (!isGood("drawing", drawing)) return;
        add("dxf", writers::makeDxf(*drawing, volume));
        add("geojson", writers::makeGeojson(*drawing, volume));
        add("section json", writers::makeSectionJson(*drawing, volume));
        add("section csv", writers::makeSectionCsv(*drawing, volume));
        const auto svg = writers::makeSvg(*drawing, volume);
        if (isGood("svg", svg)) add("svg", *svg);
    }

    void addSheets(const volume::SemanticVolume& volume) {
        const auto set = drawing::parseSheetSet(
            R"({"format": "svt-sheets", "version": 1, "scale": 112.5, "sheets": [{"views": [{"plan": "z=1.25"},
                {"section": "x=3.125"}, {"elevation": "north"}]}]})");
        if (!isGood("sheets", set)) return;
        add("sheet set", drawing::writeSheetSet(*set));
        const auto views = drawing::viewsOfSet(*set, volume);
        if (!isGood("views", views)) return;
        writers::SheetContent content;
        content.levels = views->levels;
        for (const SheetView& view : views->views) {
            drawing::SectionOptions options;
            options.beyond = view.beyond;
            const auto drawing = drawing::drawSection(volume, view.plane, options);
            if (isGood("view " + view.name, drawing)) content.views.push_back({view, *drawing});
        }
        const auto sheets = writers::makeSvgSheets(content, volume, {.scale = set->scale});
        if (isGood("sheets of SVG", sheets)) add("sheets of SVG", fmt::format("{}", fmt::join(*sheets, "\n")));
    }

    void addFiles(const volume::SemanticVolume& volume) {
        writers::VolumeWriteOptions options;
        options.tileset.place = Vec3d{48.5, 11.25, 500.5};
        options.cityGml.model = folder_ / "house.gml";
        options.foam = {.air = "name=Kitchen", .temperatures = {"class~Window:12.5"}};
        for (const writers::VolumeFormat& format : writers::volumeFormats()) {
            const fs::path path =
                folder_ / ("volume" + std::string(format.endings.substr(0, format.endings.find('|'))));
            isGood(std::string(format.name), writers::writeVolume(volume, path, options));
        }
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            if (entry.is_regular_file()) add(fs::relative(entry.path(), folder_).string(), bytesOf(entry.path()));
    }

    fs::path folder_;
    std::map<std::string, std::string> answers_;
};

TEST(Locale, WithACommaChangesNoAnswer) {
    const TemporaryFolder folder;
    const auto expected = Answers(folder / "files").all();
    fs::remove_all(folder / "files");
    std::map<std::string, std::string> found;
    {
        const CommaLocale locale(folder.path());
        ASSERT_EQ(std::strtod("1,5", nullptr), 1.5) << "the locale has a comma";
        std::ostringstream stream;
        stream << 1234.5;
        ASSERT_EQ(stream.str(), "1.234,5");
        found = Answers(folder / "files").all();
    }
    EXPECT_GT(expected.size(), 60u);
    ASSERT_EQ(expected.size(), found.size());
    for (const auto& [name, text] : expected) {
        if (found[name] == text) continue;
        const auto at = std::ranges::mismatch(text, found[name]).in1 - text.begin();
        const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(at - 60, 0));
        ADD_FAILURE() << name << " differs at byte " << at << ":\n"
                      << text.substr(from, 120) << "\nis now\n"
                      << found[name].substr(std::min(from, found[name].size()), 120);
    }
}

}  // namespace
}  // namespace svt::test
