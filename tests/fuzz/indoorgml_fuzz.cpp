/// \file
/// libFuzzer target: for any bytes the IndoorGML reader returns a model or an error.
/// Build with clang and SVT_FUZZ=ON.

#include <svt/readers/indoorgml/indoorgml_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    svt::readers::ReadOptions options;
    options.maxBytes = 1 << 20;
    options.threads = 1;
    svt::Diagnostics diagnostics;
    const auto model =
        svt::readers::readIndoorGml(std::as_bytes(std::span(data, size)), "fuzz.gml", options, &diagnostics);
    if (!model) return 0;
    // The model must be valid: indices in range, parents before children.
    for (std::size_t i = 0; i < model->features.size(); ++i) {
        const auto& feature = model->features[i];
        if (feature.id.empty() || (feature.parent != svt::model::kNoFeature && feature.parent >= i)) std::abort();
        for (const auto& geometry : feature.geometries) {
            for (const auto& use : geometry.surfaces)
                if (use.polygon >= model->polygons.size()) std::abort();
            for (const auto& solid : geometry.solids)
                for (const auto& use : solid.exterior)
                    if (use.polygon >= model->polygons.size()) std::abort();
        }
    }
    for (const auto& line : model->lines)
        if (line.feature >= model->features.size() || line.points.empty()) std::abort();
    for (const auto& membership : model->memberships)
        if (membership.group >= model->features.size() || membership.member >= model->features.size()) std::abort();
    return 0;
}
