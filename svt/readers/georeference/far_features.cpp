#include <svt/readers/georeference/far_features.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace svt::readers::georeference {
namespace {

using model::FeatureIndex;

constexpr double kFarMetres = 10'000;
constexpr double kFarSpreads = 50;

struct Centre {
    FeatureIndex feature = 0;
    Vec3d at;  // metres, about
    double distance = 0;
};

std::vector<Centre> centresOf(const model::BuildingModel& model, Vec3d metresPerUnit) {
    std::vector<Centre> centres;
    for (FeatureIndex f = 0; f < model.features.size(); ++f) {
        Box3d box;
        for (const model::Geometry& geometry : model.features[f].geometries) box.add(model.bounds(geometry));
        if (!box.isEmpty() && isFinite(box.center())) centres.push_back({f, scaled(box.center(), metresPerUnit), 0});
    }
    return centres;
}

double quantile(std::vector<double> values, std::size_t rank) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Vec3d medianOf(const std::vector<Centre>& centres) {
    Vec3d median;
    std::vector<double> values(centres.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(centres.begin(), centres.end(), values.begin(),
                       [&](const Centre& centre) { return centre.at[axis]; });
        median[axis] = quantile(values, values.size() / 2);
    }
    return median;
}

// For each feature the root above it; parents precede their children.
std::vector<FeatureIndex> rootsOf(const model::BuildingModel& model) {
    std::vector<FeatureIndex> roots(model.features.size());
    for (FeatureIndex f = 0; f < roots.size(); ++f) {
        const FeatureIndex parent = model.features[f].parent;
        roots[f] = parent == model::kNoFeature ? f : roots[parent];
    }
    return roots;
}

}  // namespace

std::size_t leaveOutFarFeatures(model::BuildingModel& model, Vec3d metresPerUnit, const Place& file,
                                Diagnostics& diagnostics) {
    std::vector<Centre> centres = centresOf(model, metresPerUnit);
    if (centres.size() < 3) return 0;
    const Vec3d middle = medianOf(centres);
    std::vector<double> distances;
    for (Centre& centre : centres) {
        centre.distance = length(centre.at - middle);
        distances.push_back(centre.distance);
    }
    const double spread = quantile(distances, 3 * (distances.size() - 1) / 4);
    const double limit = std::max(kFarMetres, kFarSpreads * spread);

    const std::vector<FeatureIndex> roots = rootsOf(model);
    std::vector<std::size_t> all(model.features.size()), far(model.features.size());
    for (const Centre& centre : centres) {
        ++all[roots[centre.feature]];
        if (centre.distance > limit) ++far[roots[centre.feature]];
    }
    std::size_t count = 0;
    for (const Centre& centre : centres) {
        if (!(centre.distance > limit)) continue;
        ++count;
        const FeatureIndex root = roots[centre.feature];
        model.features[centre.feature].geometries.clear();
        const bool isWhole = far[root] == all[root];
        if (isWhole && all[root] == 0) continue;  // reported with its first part
        const model::Feature& told = model.features[isWhole ? root : centre.feature];
        diagnostics.add(
            Severity::Warning, Code::FarFeature,
            fmt::format("this {} lies {:.0f} km away from the other features and is left out; correct its coordinates, "
                        "or keep it with --keep-far-features",
                        told.className, centre.distance / 1000),
            {file.file, told.line, 0, told.id});
        if (isWhole) all[root] = far[root] = 0;
    }
    return count;
}

}  // namespace svt::readers::georeference
