// For any bytes the reader returns a model whose indices are in range, or an error.
#include <svt/readers/ifc/ifc_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

using svt::model::BuildingModel;

void require(bool condition) {
    if (!condition) std::abort();
}

void checkUses(const BuildingModel& model, const std::vector<svt::model::SurfaceUse>& uses) {
    for (const auto& use : uses) require(use.polygon < model.polygons.size());
}

void checkModel(const BuildingModel& model) {
    for (std::size_t i = 0; i < model.features.size(); ++i) {
        const auto& feature = model.features[i];
        require(feature.parent == svt::model::kNoFeature || feature.parent < i);
        for (const auto child : feature.children) require(child < model.features.size());
        for (const auto& geometry : feature.geometries) {
            checkUses(model, geometry.surfaces);
            for (const auto& solid : geometry.solids) checkUses(model, solid.exterior);
        }
    }
    for (const auto& polygon : model.polygons) {
        require(!polygon.ringEnds.empty() && polygon.ringEnds.back() == polygon.points.size());
        require(polygon.material < static_cast<std::int64_t>(model.materials.size()));
    }
    require(model.treeOrder().size() == model.features.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    (void)svt::readers::looksLikeIfc(bytes);
    svt::readers::ReadOptions options;
    options.threads = 1;
    options.splitLayers = true;
    svt::Diagnostics diagnostics;
    const auto model = svt::readers::readIfc(bytes, "fuzz", options, &diagnostics);
    if (model) checkModel(*model);
    return 0;
}
