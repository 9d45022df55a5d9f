#include <svt/validate/validate.hpp>

#include <svt/core/parallel.hpp>
#include <svt/validate/run/indoor_checks.hpp>

#include <fmt/format.h>

namespace svt::validate {
namespace {

using model::FeatureIndex;

constexpr std::uint32_t kNoGroup = 0xFFFFFFFFu;

Result<void> checkOptions(const ValidateOptions& options) {
    const auto isAtLeast = [](double value, double least) { return std::isfinite(value) && value >= least; };
    constexpr double kLargest = 1000;
    if (!isAtLeast(options.snap, 0) || options.snap > kLargest)
        return Error(Code::BadArgument, fmt::format("snap is {}; 0 to {} metres are possible", options.snap, kLargest));
    if (!isAtLeast(options.planarity, 0) || options.planarity == 0)
        return Error(Code::BadArgument,
                     fmt::format("planarity is {}; it must be more than 0 metres", options.planarity));
    if (!isAtLeast(options.normalsDegrees, 0) || options.normalsDegrees == 0 || options.normalsDegrees > 180)
        return Error(Code::BadArgument,
                     fmt::format("the angle between normals is {}; more than 0 to 180 degrees are possible",
                                 options.normalsDegrees));
    if (!std::isfinite(options.overlap) || options.overlap > kLargest)
        return Error(Code::BadArgument, fmt::format("overlap is {}; it must be negative (off) or up to {} metres",
                                                    options.overlap, kLargest));
    return {};
}

// Roots with all features below them, in tree order.
std::vector<std::vector<FeatureIndex>> groupsOf(const model::BuildingModel& model) {
    std::vector<std::vector<FeatureIndex>> groups;
    for (const FeatureIndex feature : model.treeOrder()) {
        if (groups.empty() || model.features[feature].parent == model::kNoFeature) groups.emplace_back();
        groups.back().push_back(feature);
    }
    return groups;
}

template <class Visit>
void forEachUse(const model::Feature& feature, const Visit& visit) {
    for (const model::Geometry& geometry : feature.geometries) {
        for (const model::SurfaceUse& use : geometry.surfaces) visit(use.polygon);
        for (const model::Solid& solid : geometry.solids) {
            for (const model::SurfaceUse& use : solid.exterior) visit(use.polygon);
            for (const auto& shell : solid.interiors)
                for (const model::SurfaceUse& use : shell) visit(use.polygon);
        }
    }
}

// The first group that uses each polygon.
std::vector<std::uint32_t> firstUsers(const model::BuildingModel& model,
                                      const std::vector<std::vector<FeatureIndex>>& groups) {
    std::vector<std::uint32_t> users(model.polygons.size(), kNoGroup);
    for (std::uint32_t g = 0; g < groups.size(); ++g)
        for (const FeatureIndex feature : groups[g])
            forEachUse(model.features[feature], [&](model::PolygonIndex polygon) {
                if (users[polygon] == kNoGroup) users[polygon] = g;
            });
    return users;
}

Lattice latticeOf(const model::BuildingModel& model) {
    Box3d bounds;
    for (const model::Polygon& polygon : model.polygons)
        for (const Vec3d& point : polygon.points) bounds.add(point);
    return Lattice(bounds);
}

void append(ValidationReport& report, const model::BuildingModel& model, GroupReport&& group) {
    // Keeps the first findings of each code, over all groups.
    std::map<Code, std::size_t> kept;
    for (Finding& finding : group.findings)
        if (report.counts[finding.code] + kept[finding.code]++ < Finding::kKeptPerCode)
            report.findings.push_back(std::move(finding));
    for (const auto& [code, count] : group.counts) report.counts[code] += count;
    for (const GroupReport::Volume& volume : group.volumes)
        report.volumes.emplace(std::pair(volume.feature, volume.geometry), volume.volume);
    for (const GroupReport::Primitive& primitive : group.primitives) {
        ValidCount& count = report.primitives[std::string(primitive.type)];
        ++count.total;
        count.valid += primitive.isValid;
    }
    for (const auto& [feature, isValid] : group.features) {
        ValidCount& count = report.features[model.features[feature].className];
        ++count.total;
        count.valid += isValid;
    }
    report.polygonCount += group.polygonCount;
}

// Cell spaces have been counted as valid by their own geometry.
void appendCells(ValidationReport& report, const model::BuildingModel& model, GroupReport&& group) {
    for (const auto& entry : group.features) --report.features[model.features[entry.first].className].valid;
    group.features.clear();
    append(report, model, std::move(group));
}

// Number of polygons that the features of a group use: an estimate of the cost of its tests.
std::uint64_t polygonsOf(const model::BuildingModel& model, const std::vector<FeatureIndex>& group) {
    std::uint64_t count = 1;
    for (const FeatureIndex feature : group)
        for (const model::Geometry& geometry : model.features[feature].geometries) {
            count += geometry.surfaces.size();
            for (const model::Solid& solid : geometry.solids) {
                count += solid.exterior.size();
                for (const auto& shell : solid.interiors) count += shell.size();
            }
        }
    return count;
}

std::uint64_t polygonsOf(const model::BuildingModel& model, const std::vector<std::vector<FeatureIndex>>& groups) {
    std::uint64_t count = 0;
    for (const auto& group : groups) count += polygonsOf(model, group);
    return count;
}

}  // namespace

Result<ValidationReport> validateModel(const model::BuildingModel& model, const ValidateOptions& options) {
    SVT_DO(checkOptions(options));
    const Lattice lattice = latticeOf(model);
    const std::vector<std::vector<FeatureIndex>> groups = groupsOf(model);
    const std::vector<std::uint32_t> users = firstUsers(model, groups);
    ValidationReport report;
    std::vector<SolidBodies> cells;
    ProgressCounter counter(options.progress, "check", polygonsOf(model, groups));
    // In batches, so that no more than one of them waits to be joined in order.
    constexpr std::size_t kBatch = 1024;
    for (std::size_t begin = 0; begin < groups.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, groups.size() - begin);
        std::vector<GroupReport> batch(count);
        parallelFor(count, 1, options.threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to && !Progress::isCancelled(options.progress); ++i) {
                batch[i] = checkGroup(model, lattice, options, groups[begin + i], users,
                                      static_cast<std::uint32_t>(begin + i));
                counter.add(polygonsOf(model, groups[begin + i]));
            }
        });
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "the test was cancelled");
        for (GroupReport& group : batch) {
            for (SolidBodies& cell : group.cells) cells.push_back(std::move(cell));
            append(report, model, std::move(group));
        }
    }
    if (!cells.empty()) appendCells(report, model, checkCells(model, lattice, options, cells));
    return report;
}

}  // namespace svt::validate
