/// Damaged models against the undamaged ones, through meshes and voxels: how far closing and filling undo the damage.
/// With SVT_CLOSING_TABLE=FILE the last test writes the table of docs/dev/closing.md, with SVT_CLOSING_VOLUMES=FOLDER the
/// volumes of its pictures beside it.

#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/damage_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <span>

namespace svt::pipeline {
namespace {

using model::BuildingModel;

struct DamageCase {
    std::string name;
    std::function<void(BuildingModel&)> apply;
};

constexpr std::uint64_t kDamageSeed = 7;

DamageCase randomDamage(const std::string& name, double part,
                        std::function<void(BuildingModel&, const std::set<model::PolygonIndex>&)> apply) {
    return {fmt::format("{:g} % {}", part * 100, name),
            [=](BuildingModel& model) { apply(model, test::someOf(model, part, kDamageSeed)); }};
}

DamageCase movedDamage(double millimetres) {
    return {fmt::format("all moved by {:g} mm", millimetres), [=](BuildingModel& model) {
                test::movePolygons(model, test::someOf(model, 1.1, kDamageSeed), millimetres / 1000, kDamageSeed);
            }};
}

// All kinds of damage. Cases of a class do nothing where the model has no surface of it.
std::vector<DamageCase> damageCases(const std::vector<std::string>& classes) {
    std::vector<DamageCase> cases;
    for (const double part : {0.01, 0.1}) cases.push_back(randomDamage("turned", part, test::turnPolygons));
    for (const std::string& name : classes)
        cases.push_back({"all " + name + " turned",
                         [=](BuildingModel& model) { test::turnPolygons(model, test::polygonsOfClass(model, name)); }});
    for (const double part : {0.01, 0.05, 0.1}) cases.push_back(randomDamage("removed", part, test::removePolygons));
    for (const std::string& name : classes)
        cases.push_back({"all " + name + " removed", [=](BuildingModel& model) {
                             test::removePolygons(model, test::polygonsOfClass(model, name));
                         }});
    cases.push_back({"all party walls removed",
                     [](BuildingModel& model) { test::removePolygons(model, test::partyWalls(model)); }});
    cases.push_back({"5 % removed, 10 % turned", [](BuildingModel& model) {
                         test::turnPolygons(model, test::someOf(model, 0.1, kDamageSeed + 1));
                         test::removePolygons(model, test::someOf(model, 0.05, kDamageSeed));
                     }});
    cases.push_back(randomDamage("doubled", 0.1, test::doublePolygons));
    for (const double millimetres : {1.0, 10.0, 100.0}) cases.push_back(movedDamage(millimetres));
    cases.push_back(randomDamage("with a point in an edge", 0.5,
                                 [](BuildingModel& model, const auto& chosen) { test::splitEdges(model, chosen, 0); }));
    cases.push_back(randomDamage("with a point 5 mm beside an edge", 0.5, [](BuildingModel& model, const auto& chosen) {
        test::splitEdges(model, chosen, 0.005);
    }));
    cases.push_back(randomDamage("without their last point", 0.05, test::openRings));
    return cases;
}

BuildingModel sampleModel(samples::SampleKind kind, const samples::SampleOptions& options = {}) {
    const auto text = samples::writeSample(kind, samples::SampleFormat::CityGml3, options);
    EXPECT_TRUE(text);
    auto model = readers::readModel(std::as_bytes(std::span(*text)), "sample.gml", {}, nullptr);
    EXPECT_TRUE(model);
    return model ? *model : BuildingModel{};
}

BuildingModel fileModel(const std::filesystem::path& file) {
    auto model = readers::readModel(file, {}, nullptr);
    EXPECT_TRUE(model);
    return model ? *model : BuildingModel{};
}

// A model, filled as it is, and damaged as often as wanted.
class DamageBench {
public:
    DamageBench(BuildingModel model, double spacing) : model_(std::move(model)), spacing_(spacing) {
        auto filled = test::fillSolids(model_, spacing_, grid_, nullptr);
        EXPECT_TRUE(filled);
        if (filled) truth_ = std::move(*filled);
    }
    test::DamageFigures run(const DamageCase& damage, double* seconds = nullptr) {
        BuildingModel model = model_;
        damage.apply(model);
        const auto filled = test::fillSolids(model, spacing_, grid_, &truth_.ids);
        EXPECT_TRUE(filled);
        if (!filled) return {};
        if (seconds != nullptr) *seconds = filled->seconds;
        return test::compareSolids(truth_, *filled);
    }

    // Writes the volume that `svt build` makes of the damaged model; of the model as it is without damage.
    void writeVolume(const DamageCase* damage, const std::filesystem::path& file) const {
        BuildingModel model = model_;
        if (damage != nullptr) damage->apply(model);
        BuildOptions options;
        options.spacing = Vec3d{spacing_, spacing_, spacing_} / 2.0;
        options.vectors.meshes = true;
        const auto built = buildVolume(model, options);
        ASSERT_TRUE(built);
        EXPECT_TRUE(volume::writeSvt(built->volume, file));
    }

private:
    BuildingModel model_;
    double spacing_;
    std::optional<volume::Grid> grid_;
    test::FilledSolids truth_;
};

samples::SampleOptions smallSample() {
    samples::SampleOptions small;
    small.storeys = 2;
    small.columns = small.rows = 2;
    return small;
}

TEST(DamagedSolids, TurnedAndDoubledFacesCostNothing) {
    for (const auto kind : {samples::SampleKind::House, samples::SampleKind::District}) {
        DamageBench bench(sampleModel(kind, smallSample()), 0.1873);
        for (const DamageCase& damage :
             {randomDamage("turned", 0.1, test::turnPolygons), randomDamage("doubled", 0.1, test::doublePolygons)}) {
            const test::DamageFigures figures = bench.run(damage);
            EXPECT_GT(figures.objects, 20u);
            EXPECT_EQ(figures.median, 0) << damage.name;
            // Planes of slopes come from other triangles: samples on them, to rounding, may change sides.
            EXPECT_LT(figures.worst, 0.01) << damage.name << ": " << figures.worstId;
        }
    }
}

TEST(DamagedSolids, FewMissingFacesCostFewVoxels) {
    for (const auto kind : {samples::SampleKind::House, samples::SampleKind::Tower, samples::SampleKind::District}) {
        DamageBench bench(sampleModel(kind, smallSample()), 0.1873);
        const test::DamageFigures figures = bench.run(randomDamage("removed", 0.05, test::removePolygons));
        EXPECT_LE(figures.median, 0.005);
        EXPECT_LE(figures.percentile95, 0.02) << figures.worstId;
    }
}

TEST(DamagedSolids, RealBuildingsGetTheirGroundsAndPartyWallsBack) {
    SVT_NEEDS_DATA(file, "berlin_lod2_citygml1.gml");
    DamageBench bench(fileModel(file), 0.86);
    for (const DamageCase& damage :
         {DamageCase{
              "grounds",
              [](BuildingModel& model) { test::removePolygons(model, test::polygonsOfClass(model, "GroundSurface")); }},
          DamageCase{"party walls", [](BuildingModel& model) { test::removePolygons(model, test::partyWalls(model)); }},
          randomDamage("removed", 0.05, test::removePolygons)}) {
        const test::DamageFigures figures = bench.run(damage);
        EXPECT_GT(figures.objects, 40u);
        EXPECT_LE(figures.median, 0.005) << damage.name;
        EXPECT_LE(figures.percentile95, 0.01) << damage.name << ": " << figures.worstId;
    }
}

TEST(ClosingTable, IsWrittenWhereItIsWanted) {
    const char* const file = std::getenv("SVT_CLOSING_TABLE");
    if (file == nullptr) GTEST_SKIP() << "set SVT_CLOSING_TABLE to the file for the table";
    const char* const only = std::getenv("SVT_CLOSING_ONLY");  // part of the name of a case
    const char* const volumes = std::getenv("SVT_CLOSING_VOLUMES");
    const bool isVerbose = std::getenv("SVT_CLOSING_VERBOSE") != nullptr;
    struct Data {
        std::string name;
        std::function<BuildingModel()> make;
        double spacing;
        std::vector<std::string> classes;
    };
    const std::vector<std::string> lod2{"GroundSurface", "RoofSurface", "WallSurface"}, rooms{"FloorSurface"};
    std::vector<Data> sets;
    for (const char* const name : {"100_buildings_lod2_citygml3.gml", "berlin_lod2_citygml1.gml"})
        if (const auto path = test::dataDir() / name; std::filesystem::exists(path))
            sets.push_back({path.stem().string(), [=] { return fileModel(path); }, 0.43, lod2});
    sets.push_back({"house", [] { return sampleModel(samples::SampleKind::House); }, 0.0967, rooms});
    const samples::SampleOptions small = smallSample();
    sets.push_back({"tower", [=] { return sampleModel(samples::SampleKind::Tower, small); }, 0.1873, rooms});
    sets.push_back({"district", [=] { return sampleModel(samples::SampleKind::District, small); }, 0.1873, rooms});
    std::ofstream table(file);
    table
        << "| model | damage | objects | closed | closed by us | open | sheets | wrong, median | wrong, 95 % | wrong, "
           "worst | volume off | seconds |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Data& data : sets) {
        if (const char* const set = std::getenv("SVT_CLOSING_SET"); set != nullptr && data.name.find(set) != 0)
            continue;
        DamageBench bench(data.make(), data.spacing);
        if (volumes != nullptr) bench.writeVolume(nullptr, std::filesystem::path(volumes) / (data.name + ".svt"));
        for (const DamageCase& damage : damageCases(data.classes)) {
            if (only != nullptr && damage.name.find(only) == std::string::npos) continue;
            if (volumes != nullptr)
                bench.writeVolume(&damage,
                                  std::filesystem::path(volumes) / fmt::format("{}, {}.svt", data.name, damage.name));
            double seconds = 0;
            const test::DamageFigures f = bench.run(damage, &seconds);
            table << fmt::format(
                         "| {} | {} | {} | {} | {} | {} | {} | {:.2f} % | {:.2f} % | {:.1f} % | {:.2f} % | {:.2f} |\n",
                         data.name, damage.name, f.objects, f.closed, f.capped, f.open, f.surfaces, f.median * 100,
                         f.percentile95 * 100, f.worst * 100, f.volume * 100, seconds)
                  << std::flush;
            if (isVerbose)
                for (std::size_t w = f.all.size() - std::min<std::size_t>(f.all.size(), 8); w < f.all.size(); ++w)
                    fmt::print("{} | {} | {:.2f} % | {}\n", data.name, damage.name, f.all[w].first * 100,
                               f.all[w].second);
        }
    }
}

}  // namespace
}  // namespace svt::pipeline
