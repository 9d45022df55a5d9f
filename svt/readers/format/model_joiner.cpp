#include <svt/readers/model_joiner.hpp>

#include <svt/model/surface_uses.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::readers {

void ModelJoiner::add(model::BuildingModel from) {
    if (++count_ == 1) {
        all_ = std::move(from);
        return;
    }
    if (count_ == 2)
        for (const model::Feature& feature : all_.features) {
            known_.insert(feature.id);
            ++lookups_;
        }
    const bool isSameCrs =
        all_.crs.epsg != 0 && from.crs.epsg != 0 ? all_.crs.epsg == from.crs.epsg : all_.crs.name == from.crs.name;
    if (!isSameCrs && log_ != nullptr)
        log_->add(Severity::Warning, Code::MixedCrs,
                  fmt::format(
                      "'{}' has the CRS '{}', the files before it '{}'; coordinates are used as they are; --crs brings "
                      "all files to one",
                      from.source, from.crs.name, all_.crs.name),
                  {from.source, 0, 0, {}});
    append(std::move(from));
}

void ModelJoiner::keepIdUnique(model::Feature& feature, const std::string& source) {
    ++lookups_;
    if (known_.insert(feature.id).second) return;
    feature.id = fmt::format("{}@{}", feature.id, count_);
    known_.insert(feature.id);
    if (log_ != nullptr)
        log_->add(Severity::Warning, Code::DuplicateId,
                  fmt::format("an id of an earlier file is used again; renamed to '{}'", feature.id),
                  {source, feature.line, 0, feature.id});
}

void ModelJoiner::append(model::BuildingModel from) {
    const auto firstFeature = static_cast<model::FeatureIndex>(all_.features.size());
    const auto firstPolygon = static_cast<model::PolygonIndex>(all_.polygons.size());
    all_.joinedFiles.push_back({from.source, firstFeature, firstPolygon});
    const auto firstMaterial = static_cast<std::int32_t>(all_.materials.size());
    for (model::Polygon& polygon : from.polygons) {
        if (polygon.material >= 0) polygon.material += firstMaterial;
        all_.polygons.push_back(std::move(polygon));
    }
    for (model::Feature& feature : from.features) {
        keepIdUnique(feature, from.source);
        if (feature.parent != model::kNoFeature) feature.parent += firstFeature;
        for (model::FeatureIndex& child : feature.children) child += firstFeature;
        for (model::Geometry& geometry : feature.geometries)
            model::forEachUse(geometry, [&](model::SurfaceUse& use) { use.polygon += firstPolygon; });
        all_.features.push_back(std::move(feature));
    }
    for (model::Polyline& line : from.lines) {
        line.feature += firstFeature;
        all_.lines.push_back(std::move(line));
    }
    for (const model::FeatureIndex root : from.roots) all_.roots.push_back(root + firstFeature);
    for (model::Membership& membership : from.memberships)
        all_.memberships.push_back(
            {membership.group + firstFeature, membership.member + firstFeature, std::move(membership.role)});
    all_.materials.insert(all_.materials.end(), from.materials.begin(), from.materials.end());
}

namespace {

Result<model::BuildingModel> readOne(const std::filesystem::path& file, const ReadOptions& options, Diagnostics* log) {
    return readModel(file, options, log);
}
Result<model::BuildingModel> readOne(const NamedBytes& file, const ReadOptions& options, Diagnostics* log) {
    return readModel(file.bytes, file.name, options, log);
}

template <class File>
Result<model::BuildingModel> readAll(std::span<const File> files, ReadOptions options, Diagnostics* log) {
    if (files.empty()) return Error(Code::BadArgument, "no input file");
    ModelJoiner joiner(log);
    for (const File& file : files) {
        SVT_TRY(model, readOne(file, options, log));
        joiner.add(std::move(*model));
        options.likelyCrs = joiner.joined().crs.epsg;
    }
    return std::move(joiner.joined());
}

}  // namespace

Result<model::BuildingModel> readModels(std::span<const std::filesystem::path> files, ReadOptions options,
                                        Diagnostics* log) {
    return readAll(files, std::move(options), log);
}
Result<model::BuildingModel> readModels(std::span<const NamedBytes> files, ReadOptions options, Diagnostics* log) {
    return readAll(files, std::move(options), log);
}

}  // namespace svt::readers
