#include <bench/workload.hpp>

#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <tuple>

namespace svt::bench {
namespace {

Result<Input> writeTower(samples::SampleFormat format, const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    const auto written = samples::writeSample(samples::SampleKind::Tower, format, {}, [&](std::string_view part) {
        out.write(part.data(), static_cast<std::streamsize>(part.size()));
        return out.good();
    });
    if (!written) return written.error();
    return Input{"tower", file};
}

}  // namespace

std::filesystem::path dataDir() {
    const char* dir = std::getenv("SVT_DATA_DIR");
    return dir != nullptr ? std::filesystem::path(dir)
                          : std::filesystem::path(__FILE__).parent_path().parent_path() / SVT_BENCH_DATA_DIR;
}

Result<std::vector<Input>> findInputs(const std::filesystem::path& scratch, std::vector<std::string>& skipped) {
    std::vector<Input> inputs;
    const std::filesystem::path house = dataDir() / "fzk_haus_citygml3.gml";
    if (std::filesystem::exists(house))
        inputs.push_back({"FZK-Haus", house});
    else
        skipped.push_back("FZK-Haus: no fzk_haus_citygml3.gml in the data directory; set SVT_DATA_DIR to the folder that has it");
    auto tower = writeTower(samples::SampleFormat::CityGml3, scratch / "tower.gml");
    if (!tower) return tower.error();
    inputs.push_back(std::move(*tower));
    return inputs;
}

Result<Input> writeTowerCityGml2(const std::filesystem::path& scratch) {
    return writeTower(samples::SampleFormat::CityGml2, scratch / "tower_citygml2.gml");
}

Result<Scene> loadScene(const Input& input) {
    Scene scene;
    scene.name = input.name;
    auto model = readers::readModel(input.file);
    if (!model) return model.error();
    scene.model = std::move(*model);
    auto meshes = mesh::buildMeshes(scene.model);
    if (!meshes) return meshes.error();
    scene.meshes = std::move(*meshes);
    const std::array sheets{&pipeline::defaultStyle(false)};
    auto labels = pipeline::makeLabels(scene.model, scene.meshes, sheets);
    if (!labels) return labels.error();
    scene.labels = std::move(*labels);
    return scene;
}

std::vector<Vec3i> gridSizes(bool isQuick) {
    if (isQuick) return {{271, 230, 163}};
    return {{271, 230, 163}, {800, 700, 400}};
}

std::string sizeText(Vec3i dimension) { return fmt::format("{} x {} x {}", dimension.x, dimension.y, dimension.z); }

Result<volume::Grid> gridOver(const Scene& scene, Vec3i dimension) {
    pipeline::BuildOptions options;
    options.dimension = dimension;
    return pipeline::chooseGrid(scene.meshes, options);
}

std::vector<std::uint32_t> paintOrder(const Scene& scene) {
    std::vector<std::uint32_t> order(scene.meshes.objects.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t o) {
        const voxelize::ObjectClaim& claim = scene.labels.claims[o];
        return std::tuple<std::uint8_t, double, std::string_view, std::uint32_t>(claim.rank, scene.meshes.objects[o].volume, claim.id, o);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return key(p) > key(q); });
    return order;
}

}  // namespace svt::bench
