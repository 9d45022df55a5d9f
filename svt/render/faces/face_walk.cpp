#include <svt/render/face_model.hpp>
#include <svt/render/faces/face_data.hpp>
#include <svt/render/plain/sample_caster.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace svt::render {
namespace {

/// Crossings at most this far apart, metres, are in one place.
constexpr double kSamePlace = 1e-4;
/// A translucent sheet absorbs light over at most this many voxels, however flat the ray.
constexpr double kMostVoxelsOfSheet = 5;
constexpr double kNever = std::numeric_limits<double>::infinity();

using Data = FaceModel::Data;

// The objects that a point is inside of, by winding numbers.
class InsideObjects {
public:
    void cross(std::uint32_t object, int step) {
        for (auto& [known, winding] : windings_)
            if (known == object) {
                winding += step;
                return;
            }
        windings_.emplace_back(object, step);
    }
    // The object of the highest priority; kNobody if there is none.
    [[nodiscard]] std::uint32_t first() const noexcept {
        std::uint32_t best = Data::kNobody;
        for (const auto& [object, winding] : windings_)
            if (winding > 0) best = std::min(best, object);
        return best;
    }

private:
    std::vector<std::pair<std::uint32_t, int>> windings_;
};

// The crossings of a ray after a place, one after the other.
class CrossingCursor {
public:
    CrossingCursor(const FaceTree& tree, const VoxelRay& ray, double from, double to)
        : tree_(tree), ray_(ray), to_(to), last_{from, std::numeric_limits<std::uint32_t>::max(), false} {}
    // The next crossing up to the end; null if there is none.
    [[nodiscard]] const FaceCrossing* next() {
        if (at_ == count_ && !isLast_) {
            count_ = tree_.findNext(ray_, last_, to_, most_, batch_);
            at_ = 0;
            isLast_ = count_ < most_;
            most_ = FaceTree::kBatch;
            if (count_ > 0) last_ = batch_[count_ - 1];
        }
        return at_ == count_ ? nullptr : &batch_[at_];
    }
    void advance() noexcept { ++at_; }

private:
    const FaceTree& tree_;
    const VoxelRay& ray_;
    double to_;
    FaceCrossing last_;
    FaceTree::Batch batch_;
    std::size_t most_ = 4;  // few at first: most rays end at the first face
    std::size_t at_ = 0, count_ = 0;
    bool isLast_ = false;
};

// The owner of a point of the ray.
struct Owner {
    std::uint32_t object = Data::kNobody;
    volume::Scalar scalar = 0;
};

// The parts of a ray by the labels of objects that have only voxels, as a visitor of walkRuns().
class VoxelOwners {
public:
    struct Part {
        double from;
        Owner owner;
        RunStart start;
    };
    explicit VoxelOwners(const Data& data) : data_(data) {}
    bool enter(volume::Scalar scalar, double from, const RunStart& start) {
        const std::uint32_t object =
            scalar < data_.objectOfVoxels.size() ? data_.objectOfVoxels[scalar] : Data::kNobody;
        const Owner owner{object, object == Data::kNobody ? 0 : scalar};
        if (parts_.empty() || owner.scalar != parts_.back().owner.scalar) parts_.push_back({from, owner, start});
        return false;
    }
    bool leave(volume::Scalar /*scalar*/, double /*from*/, double /*to*/) { return false; }
    [[nodiscard]] std::span<const Part> parts() const noexcept { return parts_; }

private:
    const Data& data_;
    std::vector<Part> parts_;
};

// A walk along one interval of a ray.
class FaceWalk {
public:
    FaceWalk(const Data& data, const volume::BrickVolume& bricks, const VoxelRay& ray, double metresPerT, double from,
             double to, RunVisitor& visitor)
        : data_(data),
          bricks_(bricks),
          dimension_(bricks.dimension()),
          ray_(ray),
          samePlace_(kSamePlace / metresPerT),
          to_(to),
          visitor_(visitor),
          crossings_(data.tree, ray, from, to),
          start_(from) {}

    void walk(std::span<const VoxelOwners::Part> voxels) {
        const double from = start_;
        voxels_ = voxels;
        // The whole ray up to the start, also behind the eye: outside of the model it is inside of no object.
        data_.tree.findAll(ray_, from, here_);
        for (const FaceCrossing& crossing : here_) take(crossing);
        here_.clear();
        RunStart start{ray_.voxelAt(from, dimension_)};
        if (!voxels_.empty() && voxels_.front().from <= from) {
            voxelOwner_ = voxels_.front().owner;
            if (owner().scalar == voxelOwner_.scalar) start = voxels_.front().start;
            voxels_ = voxels_.subspan(1);
        }
        owner_ = named(owner(), from);
        if (visitor_.enter(owner_.scalar, from, start)) return;
        while (step()) {
        }
    }

private:
    void take(const FaceCrossing& crossing) {
        const std::uint32_t object = data_.tree.triangle(crossing.triangle).object;
        if (data_.objects[object].isSolid) inside_.cross(object, crossing.isEntry ? 1 : -1);
    }
    [[nodiscard]] Owner owner() const noexcept {
        const std::uint32_t object = inside_.first();
        if (voxelOwner_.object < object || object == Data::kNobody) return voxelOwner_;
        return {object, data_.objects[object].scalar};
    }

    [[nodiscard]] bool isMaterial(std::uint32_t object) const noexcept {
        return object != Data::kNobody && data_.objects[object].isMaterial;
    }
    // The owner from t on, with the label of the skin to which material belongs: one that the ray crosses there, else
    // that of the voxel.
    [[nodiscard]] Owner named(Owner owner, double t) const {
        if (!isMaterial(owner.object)) return owner;
        std::uint32_t skin = Data::kNobody;
        for (const FaceCrossing& crossing : here_)
            if (data_.objects[objectOf(crossing)].isSkin) skin = std::min(skin, objectOf(crossing));
        if (skin != Data::kNobody) return {owner.object, data_.objects[skin].scalar};
        const Vec3i voxel = ray_.voxelAt(t + samePlace_, dimension_);
        const volume::Scalar scalar = bricks_.scalarAt(voxel.x, voxel.y, voxel.z);
        return scalar < data_.isSkinScalar.size() && data_.isSkinScalar[scalar] != 0 ? Owner{owner.object, scalar}
                                                                                     : owner;
    }

    // Goes on to the next place where the label may change. Returns false at the end.
    bool step() {
        const FaceCrossing* crossing = crossings_.next();
        const double atFace = crossing != nullptr ? crossing->t : kNever;
        const double atVoxel = !voxels_.empty() ? voxels_.front().from : kNever;
        if (!(std::min(atFace, atVoxel) < to_)) {
            visitor_.leave(owner_.scalar, start_, to_);
            return false;
        }
        return atVoxel <= atFace ? stepVoxels() : stepFaces(atFace);
    }
    bool stepVoxels() {
        const VoxelOwners::Part& part = voxels_.front();
        voxels_ = voxels_.subspan(1);
        voxelOwner_ = part.owner;
        const Owner next = owner();
        here_.clear();
        return moveTo(next.object == owner_.object && isMaterial(next.object) ? owner_ : named(next, part.from),
                      part.from, part.start);
    }
    bool stepFaces(double t) {
        const Owner before = owner();
        here_.clear();
        for (const FaceCrossing* crossing = crossings_.next(); crossing != nullptr && crossing->t <= t + samePlace_;
             crossing = crossings_.next()) {
            here_.push_back(*crossing);
            take(*crossing);
            crossings_.advance();
        }
        Owner after = owner();
        if (after.object == before.object && after.object == owner_.object && isMaterial(after.object))
            after = owner_;
        else
            after = named(after, t);
        if (!crossSheet(t, before, after)) return false;
        if (after.scalar == owner_.scalar && !isAfterSheet_) {
            owner_ = after;
            return true;
        }
        // The face of the new owner; where another object ends, that of the other.
        const FaceCrossing* face = &here_.front();
        for (const FaceCrossing& crossing : here_)
            if (objectOf(crossing) == after.object) face = &crossing;
        const Vec3d normal = data_.worldNormal(face->triangle);
        return moveTo(after, t, RunStart{ray_.voxelAt(t, dimension_), volume::BrickVolume::kNoPlane, false, &normal});
    }

    // Meets the sheet of the highest priority, if it has a higher one than the object behind its face. Returns false if
    // the visitor ends the walk.
    bool crossSheet(double t, Owner before, Owner after) {
        const FaceCrossing* sheet = nullptr;
        for (const FaceCrossing& crossing : here_) {
            const std::uint32_t object = objectOf(crossing);
            if (data_.objects[object].isSolid || !visitor_.isDrawn(data_.objects[object].scalar)) continue;
            const std::uint32_t behind = (crossing.isEntry ? after : before).object;
            if (object > behind || (isMaterial(behind) && data_.objects[object].isSkin)) continue;
            if (sheet == nullptr || object < objectOf(*sheet)) sheet = &crossing;
        }
        if (sheet == nullptr) return true;
        const Vec3d normal = data_.worldNormal(sheet->triangle),
                    across = normalized(data_.tree.normal(sheet->triangle));
        const Owner owner{objectOf(*sheet), data_.objects[objectOf(*sheet)].scalar};
        if (!moveTo(owner, t, RunStart{ray_.voxelAt(t, dimension_), volume::BrickVolume::kNoPlane, false, &normal}))
            return false;
        const double voxelsPerT =
            std::max(std::abs(dot(across, ray_.direction)), length(ray_.direction) / kMostVoxelsOfSheet);
        if (visitor_.leave(owner_.scalar, t, t + 1 / voxelsPerT)) return false;
        isAfterSheet_ = true;
        return true;
    }

    bool moveTo(Owner owner, double t, const RunStart& start) {
        if (owner.scalar == owner_.scalar && !isAfterSheet_) return true;
        if (!isAfterSheet_ && visitor_.leave(owner_.scalar, start_, t)) return false;
        isAfterSheet_ = false;
        owner_ = owner;
        start_ = t;
        return !visitor_.enter(owner.scalar, t, start);
    }
    [[nodiscard]] std::uint32_t objectOf(const FaceCrossing& crossing) const noexcept {
        return data_.tree.triangle(crossing.triangle).object;
    }

    const Data& data_;
    const volume::BrickVolume& bricks_;
    Vec3i dimension_;
    const VoxelRay& ray_;
    double samePlace_, to_;  // units of the ray's parameter
    RunVisitor& visitor_;
    CrossingCursor crossings_;
    std::span<const VoxelOwners::Part> voxels_;
    InsideObjects inside_;
    std::vector<FaceCrossing> here_;  // crossings in one place
    Owner voxelOwner_, owner_;
    double start_;
    bool isAfterSheet_ = false;  // the sheet's run has ended, the next one has not begun
};

}  // namespace

void FaceModel::walk(const volume::BrickVolume& bricks, const VoxelRay& ray, double metresPerT, double from, double to,
                     RunVisitor& visitor) const {
    VoxelOwners voxels(*data_);
    if (data_->hasVoxels) walkRuns(bricks, ray, from, to, voxels);
    FaceWalk(*data_, bricks, ray, metresPerT, from, to, visitor).walk(voxels.parts());
}

std::unique_ptr<PointCaster> FaceModel::makeCaster(const PreparedFrame& frame) const { return makeSampleCaster(frame); }

}  // namespace svt::render
