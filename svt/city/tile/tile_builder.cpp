#include <svt/city/tile/tile_builder.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/readers/model_joiner.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::city {

Result<PackFeatures> PackFeatures::read(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack) {
    const auto [first, last] = plan.tilesOf(pack);
    if (first == last) return Error(Code::BadArgument, fmt::format("the plan has no pack {}", pack));
    PackFeatures result(plan);
    SVT_TRY(features, readPlanFeatures(folder, plan, first, last));
    result.first_ = plan.tiles[first].firstFeature;
    result.features_ = std::move(*features);
    result.texts_.resize(result.features_.size());
    std::vector<std::uint32_t> order(result.features_.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) order[n] = n;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const PlanFeature &f = result.features_[a], &g = result.features_[b];
        return std::tie(f.file, f.span.begin) < std::tie(g.file, g.span.begin);
    });
    for (std::size_t begin = 0; begin < order.size();) {
        const std::uint32_t file = result.features_[order[begin]].file;
        std::size_t end = begin;
        while (end < order.size() && result.features_[order[end]].file == file) ++end;
        SVT_DO(result.readFile(file, std::span(order).subspan(begin, end - begin)));
        begin = end;
    }
    return result;
}

Result<void> PackFeatures::readFile(std::uint32_t file, std::span<const std::uint32_t> features) {
    const PlanFile& entry = plan_->files[file];
    const auto changed = [&](std::string_view what) {
        return Error(Code::InputChanged, fmt::format("{}; make the plan again (svt city plan)", what),
                     {entry.path, 0, 0, {}});
    };
    std::error_code failed;
    if (std::filesystem::file_size(entry.path, failed) != entry.size || failed)
        return changed("the file is missing or has another size than when the city was planned");
    SVT_TRY(opened, readers::FeatureFile::open(entry.path));
    std::vector<readers::FeatureSpan> spans;
    for (const std::uint32_t n : features) spans.push_back(features_[n].span);
    auto picked = opened->pick(spans, [&](std::size_t s, std::string_view text) -> Result<void> {
        const std::uint32_t n = features[s];
        if (contentHash(text) != features_[n].contentHash)
            return changed(fmt::format("the feature at byte {} is not the one that was planned", spans[s].begin));
        texts_[n] = text;
        return {};
    });
    if (!picked) return picked;
    files_.emplace(file, std::move(*opened));
    return {};
}

std::array<std::uint32_t, 2> PackFeatures::ofTile(std::size_t tile) const {
    const PlanTile& planned = plan_->tiles[tile];
    const auto begin = static_cast<std::uint32_t>(planned.firstFeature - first_);
    return {begin, begin + planned.featureCount};
}

SkippedFeature PackFeatures::skipped(std::uint32_t feature, std::string reason) const {
    return {plan_->files[features_[feature].file].path, features_[feature].span.begin, std::move(reason)};
}

Result<model::BuildingModel> PackFeatures::model(std::span<const std::uint32_t> features, int threads) const {
    readers::ModelJoiner joiner(nullptr);
    for (std::size_t begin = 0; begin < features.size();) {
        const std::uint32_t file = features_[features[begin]].file;
        std::vector<std::string_view> views;
        for (; begin < features.size() && features_[features[begin]].file == file; ++begin)
            views.emplace_back(texts_[features[begin]]);
        readers::ReadOptions options;
        options.threads = threads;
        options.crs = plan_->files[file].crs;
        options.axisOrder = plan_->files[file].axisOrder;
        options.unit = plan_->options.unit;
        options.date = plan_->options.date;
        options.keepFarFeatures = true;
        options.allowTruncated = true;  // the plan determines the parts of the file that are read
        SVT_TRY(model, files_.at(file).read(views, options, nullptr));
        joiner.add(std::move(*model));
    }
    if (joiner.count() == 0) return Error(Code::EmptyModel, "no features");
    return std::move(joiner.joined());
}

Result<volume::Grid> latticeGrid(const Box3d& box, double spacing) {
    constexpr double kStep = 4;
    Vec3i dimension;
    Vec3d origin;
    for (int axis = 0; axis < 3; ++axis) {
        const double first = std::floor((std::floor(box.min[axis] / spacing) - 1) / kStep) * kStep;
        const double last = std::ceil((std::ceil(box.max[axis] / spacing) + 1) / kStep) * kStep;
        if (!(last - first <= volume::Grid::kMaxDimension))
            return Error(Code::GridTooLarge, fmt::format("a feature of {:.0f} m takes more than {} samples at {} m",
                                                         box.size()[axis], volume::Grid::kMaxDimension, spacing));
        dimension[axis] = static_cast<std::int32_t>(last - first);
        origin[axis] = (first + 0.5) * spacing;
    }
    return volume::Grid::fromParts(dimension, {spacing, spacing, spacing}, origin,
                                   {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

Result<std::optional<BuiltTile>> buildTile(const PackFeatures& features, std::span<const std::uint32_t> chosen,
                                           const CityOptions& options, int threads) {
    SVT_TRY(model, features.model(chosen, threads));
    Box3d box;
    for (const model::Feature& feature : model->features)
        for (const model::Geometry& geometry : feature.geometries) box.add(model->bounds(geometry));
    if (box.isEmpty()) return std::optional<BuiltTile>();
    SVT_TRY(grid, latticeGrid(box, options.spacing));
    pipeline::BuildOptions building;
    building.grid = *grid;
    building.lod.lod = options.lod;
    building.threads = threads;
    building.vectors = {.meshes = true, .isRequired = false};
    SVT_TRY(built, pipeline::buildVolume(*model, building));
    BuiltTile tile;
    tile.full = std::move(built->volume);
    // File names of the machine that built the tile do not belong into a city.
    tile.full.source.clear();
    SVT_TRY(buildings, buildingsOf(tile.full, threads));
    tile.buildings = std::move(*buildings);
    const std::vector<volume::Label>& labels = tile.full.labels.labels;
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (labels[l].parent == volume::kNoLabel) tile.labels.push_back({idHash(labels[l].id), l});
    return std::optional(std::move(tile));
}

}  // namespace svt::city
