#include <svt/render/face_model.hpp>
#include <svt/render/faces/face_data.hpp>
#include <svt/render/plain/sample_caster.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
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
    void clear() noexcept { windings_.clear(); }
    void cross(std::uint32_t object, int step) {
        for (auto& [known, winding] : windings_)
            if (known == object) {
                winding += step;
                return;
            }
        windings_.emplace_back(object, step);
    }
    [[nodiscard]] int winding(std::uint32_t object) const noexcept {
        for (const auto& [known, winding] : windings_)
            if (known == object) return winding;
        return 0;
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

// The crossings of a ray up to an end, one after the other.
class Crossings {
public:
    Crossings() = default;
    Crossings(const Crossings&) = delete;
    Crossings& operator=(const Crossings&) = delete;
    virtual ~Crossings() = default;
    // The next crossing; null if there is none.
    [[nodiscard]] virtual const FaceCrossing* next() = 0;
    virtual void advance() noexcept = 0;
};

// Sought in the tree, batch by batch.
class TreeCrossings final : public Crossings {
public:
    TreeCrossings(const FaceTree& tree, const VoxelRay& ray, double to) : tree_(tree), ray_(ray), to_(to) {}
    [[nodiscard]] const FaceCrossing* next() override {
        if (at_ == count_ && !isLast_) {
            count_ = tree_.findNext(ray_, last_, to_, most_, batch_);
            at_ = 0;
            isLast_ = count_ < most_;
            most_ = FaceTree::kBatch;
            if (count_ > 0) last_ = batch_[count_ - 1];
        }
        return at_ == count_ ? nullptr : &batch_[at_];
    }
    void advance() noexcept override { ++at_; }

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

// By the triangles of a beam. A crossing is known to be the next one when all triangles left begin behind it.
class BeamCrossings final : public Crossings {
public:
    BeamCrossings(const FaceTree& tree, std::span<const BeamTriangle> triangles, BeamPlace place, const VoxelRay& ray,
                  double to, std::vector<FaceCrossing>& pending)
        : tree_(tree), triangles_(triangles), place_(place), ray_(ray), across_(ray), to_(to), pending_(pending) {
        pending_.clear();
    }
    [[nodiscard]] const FaceCrossing* next() override {
        FaceCrossing crossing;
        for (; !triangles_.empty(); triangles_ = triangles_.subspan(1)) {
            const BeamTriangle& triangle = triangles_.front();
            if (!pending_.empty() && pending_.back().t < triangle.from) break;
            if (!tree_.cross(triangle, place_, ray_, across_, crossing) || crossing.t > to_) continue;
            // The first one is the last of the list.
            const auto at = std::find_if(pending_.rbegin(), pending_.rend(),
                                         [&](const FaceCrossing& other) { return crossing.isBefore(other); });
            pending_.insert(at.base(), crossing);
        }
        return pending_.empty() ? nullptr : &pending_.back();
    }
    void advance() noexcept override { pending_.pop_back(); }

private:
    const FaceTree& tree_;
    std::span<const BeamTriangle> triangles_;
    BeamPlace place_;
    const VoxelRay& ray_;
    RayAcross across_;
    double to_;
    std::vector<FaceCrossing>& pending_;  // found, not passed; the first one is the last of the list
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
    void clear() noexcept { parts_.clear(); }
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

// Lists of a walk, kept from ray to ray.
struct WalkLists {
    InsideObjects inside;
    std::vector<FaceCrossing> here;  // crossings in one place
};

// A walk along one interval of a ray.
class FaceWalk {
public:
    // \param crossings  of the ray, also behind the eye
    FaceWalk(const Data& data, Crossings& crossings, const volume::BrickVolume& bricks, const VoxelRay& ray,
             double metresPerT, double from, double to, RunVisitor& visitor, WalkLists& lists)
        : data_(data),
          bricks_(bricks),
          dimension_(bricks.dimension()),
          ray_(ray),
          samePlace_(kSamePlace / metresPerT),
          to_(to),
          visitor_(visitor),
          crossings_(crossings),
          inside_(lists.inside),
          here_(lists.here),
          start_(from) {
        inside_.clear();
        here_.clear();
    }

    void walk(std::span<const VoxelOwners::Part> voxels) {
        const double from = start_;
        voxels_ = voxels;
        // The whole ray up to the start, also behind the eye: outside of the model it is inside of no object.
        for (const FaceCrossing* crossing = crossings_.next(); crossing != nullptr && crossing->t <= from;
             crossing = crossings_.next()) {
            take(*crossing);
            crossings_.advance();
        }
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
            visitor_.leave(owner_.scalar, start_, absorbedTo(to_));
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

    // Meets the surface of the highest priority, if it has a higher one than the object behind its face. Returns false if
    // the visitor ends the walk.
    bool crossSheet(double t, Owner before, Owner after) {
        const FaceCrossing* sheet = nullptr;
        for (const FaceCrossing& crossing : here_) {
            const std::uint32_t object = objectOf(crossing);
            if (!visitor_.isDrawn(data_.objects[object].scalar) || !isSheetHere(object)) continue;
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

    // Whether an object is a surface in this place: also a closed one whose front and back lie here. At an edge that the
    // ray grazes, the two faces are not parallel.
    [[nodiscard]] bool isSheetHere(std::uint32_t object) const {
        constexpr double kOpposite = -0.99;
        if (!data_.objects[object].isSolid) return true;
        if (here_.size() < 2 || data_.objects[object].isMaterial || inside_.winding(object) > 0) return false;
        const FaceCrossing *front = nullptr, *back = nullptr;
        for (const FaceCrossing& crossing : here_)
            if (objectOf(crossing) == object) (crossing.isEntry ? front : back) = &crossing;
        return front != nullptr && back != nullptr &&
               dot(data_.worldNormal(front->triangle), data_.worldNormal(back->triangle)) < kOpposite;
    }

    bool moveTo(Owner owner, double t, const RunStart& start) {
        if (owner.scalar == owner_.scalar && !isAfterSheet_) return true;
        if (!isAfterSheet_ && visitor_.leave(owner_.scalar, start_, absorbedTo(t))) return false;
        isAfterSheet_ = false;
        owner_ = owner;
        start_ = t;
        return !visitor_.enter(owner.scalar, t, start);
    }
    // The end of the run up to t for the light that it absorbs.
    [[nodiscard]] double absorbedTo(double t) const noexcept {
        const double thickening = owner_.object == Data::kNobody ? 1 : data_.objects[owner_.object].thickening;
        return thickening == 1 ? t : start_ + (t - start_) * thickening;
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
    Crossings& crossings_;
    std::span<const VoxelOwners::Part> voxels_;
    InsideObjects& inside_;
    std::vector<FaceCrossing>& here_;
    Owner voxelOwner_, owner_;
    double start_;
    bool isAfterSheet_ = false;  // the sheet's run has ended, the next one has not begun
};

// Walks rays; those of one cell of the picture share the list of triangles that they may cross.
class FaceWalker final : public RunWalker {
public:
    FaceWalker(const Data& data, const volume::BrickVolume& bricks, const CameraRays& rays, PictureSize size)
        : data_(data), bricks_(bricks), rays_(rays), size_(size), voxels_(data) {}

    void walk(double u, double v, const CameraRay& ray, double from, double to, RunVisitor& visitor) override {
        voxels_.clear();
        if (data_.hasVoxels) walkRuns(bricks_, ray.voxelRay, from, to, voxels_);
        const double column = (u + 1) / 2 * size_.width / kCellPixels, row = (v + 1) / 2 * size_.height / kCellPixels;
        const Cell* cell = size_.width > 0 && size_.height > 0 ? &cellAt(std::floor(column), std::floor(row)) : nullptr;
        const auto walkBy = [&](Crossings& crossings) {
            FaceWalk(data_, crossings, bricks_, ray.voxelRay, ray.metresPerT, from, to, visitor, lists_)
                .walk(voxels_.parts());
        };
        if (cell == nullptr || !cell->isComplete) {
            TreeCrossings crossings(data_.tree, ray.voxelRay, to);
            return walkBy(crossings);
        }
        const BeamPlace place{static_cast<float>(2 * (column - cell->column) - 1),
                              static_cast<float>(2 * (row - cell->row) - 1)};
        BeamCrossings crossings(data_.tree, cell->triangles, place, ray.voxelRay, to, pending_);
        walkBy(crossings);
    }

private:
    static constexpr double kCellPixels = 8;
    static constexpr int kCellsKept = 8;              // along each axis: those of a tile and of its margin
    static constexpr std::size_t kMostInCell = 1024;  // more triangles are sought in the tree

    struct Cell {
        double column = std::numeric_limits<double>::quiet_NaN(), row = 0;
        bool isComplete = false;
        std::vector<BeamTriangle> triangles;
    };

    const Cell& cellAt(double column, double row) {
        const auto slotOf = [](double place) {
            return static_cast<std::size_t>(static_cast<std::int64_t>(place) & (kCellsKept - 1));
        };
        Cell& cell = cells_[slotOf(column) + kCellsKept * slotOf(row)];
        if (cell.column == column && cell.row == row) return cell;
        const auto at = [](double place, int count) { return 2 * place * kCellPixels / count - 1; };
        const FaceBeam beam(rays_, at(column, size_.width), at(column + 1, size_.width), at(row, size_.height),
                            at(row + 1, size_.height));
        cell.isComplete = data_.tree.collect(beam, kMostInCell, cell.triangles);
        cell.column = column;
        cell.row = row;
        return cell;
    }

    const Data& data_;
    const volume::BrickVolume& bricks_;
    const CameraRays& rays_;
    PictureSize size_;
    VoxelOwners voxels_;
    WalkLists lists_;
    std::array<Cell, std::size_t{kCellsKept} * kCellsKept> cells_;
    std::vector<FaceCrossing> pending_;  // of BeamCrossings
};

}  // namespace

void FaceModel::walk(const volume::BrickVolume& bricks, const VoxelRay& ray, double metresPerT, double from, double to,
                     RunVisitor& visitor) const {
    VoxelOwners voxels(*data_);
    if (data_->hasVoxels) walkRuns(bricks, ray, from, to, voxels);
    WalkLists lists;
    TreeCrossings crossings(data_->tree, ray, to);
    FaceWalk(*data_, crossings, bricks, ray, metresPerT, from, to, visitor, lists).walk(voxels.parts());
}

std::unique_ptr<RunWalker> FaceModel::makeWalker(const volume::BrickVolume& bricks, const CameraRays& rays,
                                                 PictureSize size) const {
    return std::make_unique<FaceWalker>(*data_, bricks, rays, size);
}

std::unique_ptr<PointCaster> FaceModel::makeCaster(const PreparedFrame& frame) const { return makeSampleCaster(frame); }

}  // namespace svt::render
