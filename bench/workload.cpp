#include <bench/workload.hpp>

#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <sstream>
#include <tuple>
#include <utility>

namespace svt::bench {
namespace {

Result<void> writeText(const std::string& text, const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    out << text << std::flush;
    if (!out.good()) return Error(Code::CannotWrite, "the benchmark cannot write its input", {file.string(), 0, 0, {}});
    return {};
}

Result<std::string> readText(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    if (!in.good() || text.empty())
        return Error(Code::CannotOpen, "the benchmark cannot read its input", {file.string(), 0, 0, {}});
    return text;
}

// Rotates the points of one coordinate list and appends them.
class PlanTurner {
public:
    explicit PlanTurner(double degrees)
        : cosine_(std::cos(degrees * std::numbers::pi / 180)), sine_(std::sin(degrees * std::numbers::pi / 180)) {}

    void append(const std::string& list, std::string& result) {
        std::istringstream numbers(list);
        const char* separator = "";
        for (double x = 0, y = 0, z = 0; numbers >> x >> y >> z; separator = " ") {
            if (!hasPivot_) pivotX_ = x, pivotY_ = y, hasPivot_ = true;
            const double east = x - pivotX_, north = y - pivotY_;
            result += fmt::format("{}{:.6f} {:.6f} {:.6f}", separator, pivotX_ + cosine_ * east - sine_ * north,
                                  pivotY_ + sine_ * east + cosine_ * north, z);
        }
    }

private:
    double cosine_, sine_;
    bool hasPivot_ = false;
    double pivotX_ = 0, pivotY_ = 0;
};

// Removes all city object group members of the city model.
std::string withoutGroups(const std::string& text) {
    const std::string open = "<core:cityObjectMember>\n<grp:CityObjectGroup", close = "</core:cityObjectMember>\n";
    std::string result;
    std::size_t at = 0;
    for (std::size_t group = text.find(open); group != std::string::npos; group = text.find(open, at)) {
        result.append(text, at, group - at);
        const std::size_t end = text.find(close, group);
        if (end == std::string::npos) return result;
        at = end + close.size();
    }
    return result.append(text, at);
}

}  // namespace

std::filesystem::path dataDir() {
    const char* dir = std::getenv("SVT_DATA_DIR");
    return dir != nullptr ? std::filesystem::path(dir) : SVT_BENCH_DATA_DIR;
}

Result<std::vector<Input>> findInputs(const std::filesystem::path& scratch, std::vector<std::string>& skipped) {
    std::vector<Input> inputs;
    const std::filesystem::path house = dataDir() / "fzk_haus_citygml3.gml";
    if (std::filesystem::exists(house)) {
        inputs.push_back({kHouse, house});
        SVT_TRY(text, readText(house));
        inputs.push_back({kTurnedHouse, scratch / "turned.gml"});
        SVT_DO(writeText(turnedCityGml(*text, kTurnDegrees), inputs.back().file));
    } else {
        skipped.push_back(
            "FZK-Haus: no fzk_haus_citygml3.gml in the data directory; set SVT_DATA_DIR to the folder that has it");
    }
    SVT_TRY(tower, samples::writeSample(samples::SampleKind::Tower, samples::SampleFormat::CityGml3, {}));
    inputs.push_back({"tower", scratch / "tower.gml"});
    SVT_DO(writeText(*tower, inputs.back().file));
    return inputs;
}

std::string turnedCityGml(const std::string& text, double degrees) {
    PlanTurner turner(degrees);
    std::string result;
    result.reserve(text.size() + text.size() / 4);
    std::size_t at = 0;
    for (std::size_t tag = text.find("<gml:"); tag != std::string::npos; tag = text.find("<gml:", at)) {
        const std::size_t nameEnd = text.find_first_of(" \t\r\n/>", tag), begin = text.find('>', tag) + 1;
        if (begin == 0) break;
        result.append(text, at, begin - at);
        at = begin;
        const std::string name = text.substr(tag + 5, nameEnd - tag - 5);
        if (name != "posList" && name != "pos" && name != "lowerCorner" && name != "upperCorner") continue;
        const std::size_t end = std::min(text.find('<', begin), text.size());
        turner.append(text.substr(begin, end - begin), result);
        at = end;
    }
    return result.append(text, at);
}

Result<Input> writeDistrict(const std::filesystem::path& scratch) {
    samples::SampleOptions options;
    options.columns = options.rows = 20;
    Input input{"district, 20 x 20 houses", scratch / "district.gml"};
    std::ofstream out(input.file, std::ios::binary);
    const auto written = samples::writeSample(samples::SampleKind::District, samples::SampleFormat::CityGml3, options,
                                              [&](std::string_view part) {
                                                  out << part;
                                                  return out.good();
                                              });
    if (!written) return written.error();
    return input;
}

Result<Input> writeTowerCityGml2(const std::filesystem::path& scratch) {
    samples::SampleOptions options;
    options.thematic = true;
    SVT_TRY(tower, samples::writeSample(samples::SampleKind::Tower, samples::SampleFormat::CityGml2, options));
    Input input{"tower, CityGML 2.0", scratch / "tower_citygml2.gml"};
    SVT_DO(writeText(withoutGroups(*tower), input.file));
    return input;
}

Result<Workload> loadWorkload(const Input& input) {
    Workload workload;
    workload.name = input.name;
    SVT_TRY(model, readers::readModel(input.file));
    workload.model = std::move(*model);
    SVT_TRY(meshes, mesh::buildMeshes(workload.model));
    workload.meshes = std::move(*meshes);
    const std::array sheets{&pipeline::defaultStyle(false)};
    SVT_TRY(labels, pipeline::makeLabels(workload.model, workload.meshes, sheets));
    workload.labels = std::move(*labels);
    return workload;
}

Vec3i gridSize(bool isQuick) { return isQuick ? kSmallGrid : kGrid; }

std::string sizeText(Vec3i dimension) { return fmt::format("{} x {} x {}", dimension.x, dimension.y, dimension.z); }

Result<volume::Grid> gridOver(const Workload& workload, Vec3i dimension) {
    pipeline::BuildOptions options;
    options.dimension = dimension;
    return pipeline::chooseGrid(workload.meshes, options);
}

std::vector<std::uint32_t> paintOrder(const mesh::MeshSet& meshes, const std::vector<voxelize::ObjectClaim>& claims) {
    std::vector<std::uint32_t> order(meshes.objects.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t o) {
        return std::tuple<std::uint8_t, double, std::string_view, std::uint32_t>(
            claims[o].rank, meshes.objects[o].volume, claims[o].id, o);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return key(p) > key(q); });
    return order;
}

}  // namespace svt::bench
