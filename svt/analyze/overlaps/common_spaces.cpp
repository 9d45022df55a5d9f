#include <svt/analyze/common_spaces.hpp>

#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/core/vec.hpp>
#include <svt/plane/common_volume.hpp>

#include <algorithm>
#include <tuple>

namespace svt::analyze {

/// The solids of one volume, ascending by label.
struct CommonSpaces::Solids {
    const volume::VectorParts& parts;
    std::vector<MeshSolid> solids;

    [[nodiscard]] const MeshSolid* find(std::uint32_t label) const {
        const auto at = std::lower_bound(solids.begin(), solids.end(), label,
                                         [](const MeshSolid& solid, std::uint32_t l) { return solid.label < l; });
        return at != solids.end() && at->label == label ? &*at : nullptr;
    }

    /// Those of the labels that have a closed mesh, in the order of their boxes along x.
    [[nodiscard]] std::vector<const MeshSolid*> inOrder(std::span<const std::uint32_t> labels) const {
        std::vector<const MeshSolid*> found;
        for (const std::uint32_t label : labels)
            if (const MeshSolid* solid = find(label)) found.push_back(solid);
        std::sort(found.begin(), found.end(), [](const MeshSolid* s, const MeshSolid* t) {
            return std::tie(s->box.min.x, s->label) < std::tie(t->box.min.x, t->label);
        });
        return found;
    }
};

CommonSpaces::CommonSpaces(const volume::SemanticVolume& a, const volume::SemanticVolume& b, std::uint64_t work)
    : a_(new Solids{a.vectors, meshSolids(a)}),
      b_(new Solids{b.vectors, meshSolids(b, b.grid.origin() - a.grid.origin())}),
      unit_(std::max(a.vectors.unit, b.vectors.unit)),
      work_(work) {}

CommonSpaces::~CommonSpaces() = default;

bool CommonSpaces::take(std::uint64_t steps) noexcept {
    if (steps > work_) {
        isComplete_ = false;
        return false;
    }
    work_ -= steps;
    return true;
}

std::optional<CommonSpace> CommonSpaces::of(std::uint32_t a, std::uint32_t b) {
    const MeshSolid *s = a_->find(a), *t = b_->find(b);
    if (s == nullptr || t == nullptr || !take(s->triangles.size() + t->triangles.size())) return std::nullopt;
    CommonSpace common{a, b};
    const Box3d box = commonBox(s->box, t->box);
    if (box.isEmpty()) return common;
    const SolidClip ofS = clipSolid(*s, a_->parts, box), ofT = clipSolid(*t, b_->parts, box);
    if (!take(plane::comparisons(ofS.roofs, ofT.roofs))) return std::nullopt;
    const double lowest = std::min(ofS.lowest, ofT.lowest);
    common.volume = std::max(0.0, plane::commonVolume(ofS.roofs, ofT.roofs, lowest));
    common.bound = boundOfCommonVolume(ofS.area + ofT.area, unit_, box, lowest);
    return common;
}

std::vector<CommonSpace> CommonSpaces::among(std::span<const std::uint32_t> ofA, std::span<const std::uint32_t> ofB) {
    const std::vector<const MeshSolid*> first = a_->inOrder(ofA), second = b_->inOrder(ofB);
    std::vector<CommonSpace> found;
    std::vector<const MeshSolid*> openOfA, openOfB;
    // A sweep along x. A solid that begins is compared with the open ones of the other volume.
    const auto meet = [&](const MeshSolid& solid, std::vector<const MeshSolid*>& others, bool isOfA) -> bool {
        std::erase_if(others, [&](const MeshSolid* other) { return other->box.max.x <= solid.box.min.x; });
        if (!take(others.size())) return false;
        for (const MeshSolid* other : others) {
            if (commonBox(solid.box, other->box).isEmpty()) continue;
            const auto common = isOfA ? of(solid.label, other->label) : of(other->label, solid.label);
            if (common && common->volume > common->bound) found.push_back(*common);
        }
        return true;
    };
    std::size_t i = 0, j = 0;
    while (i < first.size() || j < second.size()) {
        const bool takesFirst = j == second.size() || (i < first.size() && first[i]->box.min.x <= second[j]->box.min.x);
        const MeshSolid* solid = takesFirst ? first[i++] : second[j++];
        if (!meet(*solid, takesFirst ? openOfB : openOfA, takesFirst)) break;
        (takesFirst ? openOfA : openOfB).push_back(solid);
    }
    std::sort(found.begin(), found.end(),
              [](const CommonSpace& s, const CommonSpace& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
    return found;
}

}  // namespace svt::analyze
