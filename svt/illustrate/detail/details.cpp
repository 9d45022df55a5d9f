#include <svt/illustrate/details.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/volume_part.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace svt::illustrate {
namespace {

using volume::Label;
using volume::Scalar;

class LabelJoiner {
public:
    explicit LabelJoiner(volume::LabelTable& table) : table_(table) {
        for (std::uint32_t l = 0; l < table.labels.size(); ++l)
            if (!table.labels[l].id.empty()) known_.emplace(table.labels[l].id, l);
    }

    // The scalars of the table for those of `detail`; labels that the table has not are added.
    Result<std::vector<Scalar>> join(const volume::LabelTable& detail) {
        const Scalar before = table_.scalarCount();
        if (std::uint64_t{before} + detail.scalarCount() > volume::kMaxScalarCount)
            return Error(Code::BadArgument,
                         fmt::format("the volumes have more than {} scalars together", volume::kMaxScalarCount));
        std::vector<std::uint32_t> newOf(detail.labels.size());
        std::vector<Scalar> scalars(detail.scalarCount(), 0);
        Scalar next = before;
        for (std::size_t l = 0; l < newOf.size(); ++l) {
            const Label& label = detail.labels[l];
            const auto known = label.id.empty() ? known_.end() : known_.find(label.id);
            newOf[l] = known != known_.end() ? known->second : add(label, next, detail);
            const Label& own = table_.labels[newOf[l]];
            // Without a voxel in the volume around, a label has no scalar there yet.
            if (own.count == 0 && label.count > 0) giveScalars(newOf[l], label, next, detail);
            for (Scalar s = 0; s < label.count; ++s) scalars[label.first + s] = own.first + std::min(s, own.count - 1);
        }
        setParents(detail, newOf);
        return scalars;
    }

private:
    std::uint32_t add(const Label& label, Scalar& next, const volume::LabelTable& detail) {
        const auto number = static_cast<std::uint32_t>(table_.labels.size());
        Label& added = table_.labels.emplace_back(label);
        added.subtreeEnd = number + 1;
        added.parent = volume::kNoLabel;
        added.groups.clear();
        added.first = added.count = 0;
        if (label.count > 0) giveScalars(number, label, next, detail);
        return number;
    }
    void giveScalars(std::uint32_t number, const Label& from, Scalar& next, const volume::LabelTable& detail) {
        Label& label = table_.labels[number];
        label.first = next;
        label.count = from.count;
        next += from.count;
        if (table_.phaseColors.empty() && detail.phaseColors.empty()) return;
        if (table_.phaseColors.size() < label.first) fillPhases(label.first);
        for (Scalar s = 0; s < from.count; ++s)
            table_.phaseColors.push_back(detail.phaseColors.empty() ? from.color : detail.phaseColors[from.first + s]);
    }
    // Colours of labels that had no pattern.
    void fillPhases(Scalar end) {
        const auto first = static_cast<Scalar>(table_.phaseColors.size());
        table_.phaseColors.resize(end);
        for (const Label& label : table_.labels)
            for (Scalar s = std::max(label.first, first); s < std::min(label.first + label.count, end); ++s)
                table_.phaseColors[s] = label.color;
    }
    void setParents(const volume::LabelTable& detail, const std::vector<std::uint32_t>& newOf) {
        for (std::size_t l = 0; l < newOf.size(); ++l) {
            Label& label = table_.labels[newOf[l]];
            if (label.parent != volume::kNoLabel || known_.contains(label.id)) continue;
            const Label& from = detail.labels[l];
            if (from.parent != volume::kNoLabel) label.parent = newOf[from.parent];
            for (const std::uint32_t group : from.groups) label.groups.push_back(newOf[group]);
        }
        for (std::size_t l = 0; l < newOf.size(); ++l)
            if (!detail.labels[l].id.empty()) known_.emplace(detail.labels[l].id, newOf[l]);
    }

    volume::LabelTable& table_;
    std::map<std::string, std::uint32_t, std::less<>> known_;
};

Box3d worldBox(const volume::Grid& grid, Vec3d low, Vec3d high) {
    Box3d box;
    for (int c = 0; c < 8; ++c)
        box.add(grid.worldFromIndex(
            {(c & 1) != 0 ? high.x : low.x, (c & 2) != 0 ? high.y : low.y, (c & 4) != 0 ? high.z : low.z}));
    return box;
}

bool isWithin(const Box3d& inner, const Box3d& outer, double slack) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.min[axis] < outer.min[axis] - slack || inner.max[axis] > outer.max[axis] + slack) return false;
    return true;
}

// The box of all samples of a grid, each half a spacing wide to both sides.
render::ConvexPart boxOf(const volume::Grid& grid) {
    const Vec3d half{0.5, 0.5, 0.5};
    const Vec3d low = grid.worldFromIndex(-half), size = scaled(toDouble(grid.dimension()), grid.spacing());
    return render::boxPart(low, grid.axes(), {0, 0, 0}, size);
}

}  // namespace

Result<void> joinLabels(volume::SemanticVolume& volume, std::span<volume::SemanticVolume> details) {
    LabelJoiner joiner(volume.labels);
    for (volume::SemanticVolume& detail : details) {
        if (!detail.crsName.empty() && !volume.crsName.empty() && detail.crsName != volume.crsName)
            return Error(Code::BadArgument,
                         fmt::format("{} has coordinates of {}, but {} of {}; build both with the same --crs",
                                     volume.source, volume.crsName, detail.source, detail.crsName));
        SVT_TRY(scalars, joiner.join(detail.labels));
        detail.columns = volume::replaceScalars(detail.columns, *scalars);
    }
    for (volume::SemanticVolume& detail : details) detail.labels = volume.labels;
    return {};
}

DetailPlace placeOfDetail(const volume::SemanticVolume& volume, const volume::SemanticVolume& detail) {
    const auto around = analyze::labelBoxes(volume.columns, volume.labels);
    const auto own = analyze::labelBoxes(detail.columns, detail.labels);
    const Vec3d half{0.5, 0.5, 0.5};
    const Box3d box = worldBox(detail.grid, -half, toDouble(detail.grid.dimension()) - half);
    const Vec3d spacing = volume.grid.spacing();
    DetailPlace place;
    for (std::size_t l = 0; l < own.size(); ++l) {
        if (own[l].isEmpty() || around[l].isEmpty()) continue;
        const Box3d whole = worldBox(volume.grid, toDouble(around[l].min) - half, toDouble(around[l].max) + half);
        if (!isWithin(whole, box, 1.01 * std::max({spacing.x, spacing.y, spacing.z}))) return {boxOf(detail.grid), {}};
        const Label& label = volume.labels.labels[l];
        for (Scalar s = 0; s < label.count; ++s) place.replaced.push_back(label.first + s);
    }
    return place;
}

Result<void> addDetailPasses(std::span<const DetailPlace> details,
                             std::span<const VolumeRepresentation> representations, render::FrameSpec& spec,
                             bool haveShells) {
    std::vector<render::ConvexPart> boxes;
    for (const DetailPlace& detail : details)
        if (detail.box) boxes.push_back(*detail.box);
    std::vector<render::Pass> passes;
    for (const render::Pass& pass : spec.passes) {
        if (representations[pass.volume].shell && !haveShells) {
            passes.push_back(pass);
            continue;
        }
        if (!pass.lines.empty() || !pass.triangles.empty())
            return Error(
                Code::BadArgument,
                "lines and meshes are drawn in one volume only; leave out --wireframe and --vectors, or --with");
        render::Pass around = pass;
        for (const DetailPlace& detail : details)
            for (const Scalar scalar : detail.replaced)
                if (scalar < around.styles.size()) around.styles[scalar].opacity = 0;
        const std::size_t gaps = boxes.size() + 1;
        for (std::size_t gap = 0; gap < gaps; ++gap) {
            render::Pass& part = passes.emplace_back(around);
            if (!boxes.empty())
                part.clips.push_back({boxes, render::ClipRegion::Mode::Gap, static_cast<std::uint32_t>(gap)});
            if (gap > 0) part.join = render::Pass::Join::Part;
        }
        for (std::size_t d = 0; d < details.size(); ++d) {
            render::Pass& part = passes.emplace_back(pass);
            part.volume = static_cast<std::uint32_t>((d + 1) * representations.size() + pass.volume);
            part.join = render::Pass::Join::Part;
        }
    }
    spec.passes = std::move(passes);
    return checkFrameSpec(spec);
}

}  // namespace svt::illustrate
