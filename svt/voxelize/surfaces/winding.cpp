#include <svt/voxelize/surfaces/winding.hpp>

#include <svt/voxelize/surfaces/disjoint_boxes.hpp>
#include <svt/voxelize/surfaces/lid_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace svt::voxelize {
namespace {

constexpr std::int32_t kPartSize = 64;            // samples along each axis of a part
constexpr std::int32_t kLargestLeaf = 16;         // blocks up to this size are decided sample by sample
constexpr std::int32_t kSmallest = 4;             // blocks of this size are not halved
constexpr double kShift = 1.0 / double(kQuanta);  // samples lie this far beyond their index
constexpr double kTie = 1e-9;                     // a winding number this far below 1/2 is inside
constexpr double kCountError = 0.01;              // for the count of uncertain samples
constexpr double kOpenLayer = 0.2;                // maximum thickness of the undecided layer, voxels
constexpr double kBand = 1.0 / 64;                // voxels: closer to a lid, its side is decided on the lattice
constexpr double kReach = 1.0 / 32;               // voxels: a lid closer than this to a block touches it

// Largest error of a piece that joins the far ones. Samples left open go back to the lists of larger blocks.
constexpr double foldError(std::int32_t size) noexcept {
    return size >= 32 ? 2e-6 : size == 16 ? 5e-6 : size == 8 ? 2e-5 : 1e-4;
}

double largest(Vec3d v) noexcept { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double distanceToBox(Vec3d p, const Box3d& box) noexcept {
    const Vec3d outside{std::max({box.min.x - p.x, p.x - box.max.x, 0.0}),
                        std::max({box.min.y - p.y, p.y - box.max.y, 0.0}),
                        std::max({box.min.z - p.z, p.z - box.max.z, 0.0})};
    return length(outside);
}

// The amount by which the sweep must count more, so that it can compare with 1.
std::int32_t deltaOf(double c) noexcept { return -static_cast<std::int32_t>(std::ceil(c - 0.5 - kTie)); }

double distanceToHalf(double c) noexcept { return std::abs(c - std::floor(c) - 0.5); }

bool isUncertain(double c) noexcept { return distanceToHalf(c) < 0.25; }

}  // namespace

// Halves the blocks of one part until every sample is decided. Belongs to one thread.
class WindingBlocks {
public:
    WindingBlocks(WindingFill& fill, WindingFill::Part& part) : fill_(fill), field_(*fill.field_), part_(part) {}

    void run() {
        near_.clear();
        lids_.clear();
        for (std::uint32_t n = 0; n < field_.pieces().size(); ++n) near_.push_back(n);
        for (std::uint32_t n = 0; n < fill_.lids_.size(); ++n) lids_.push_back(n);
        Block all;
        all.near = {0, near_.size()};
        all.lids = {0, lids_.size()};
        Block part = all;
        part.parent = &all;
        part.low = part_.low;
        part.size = kPartSize;
        divide(part);
    }

private:
    struct Range {
        std::size_t begin, end;
    };
    struct Block {
        const Block* parent = nullptr;
        Vec3i low{};
        std::int32_t size = 0;
        Range near{}, lids{};  // of near_ and lids_
        Vec3d center{};        // of `far`
        Jet far;               // sum of all pieces that are not near
    };
    // The samples of a block within the bounding box.
    struct Samples {
        Vec3i low, count;
        Vec3d center, half;  // index space; `half`: from the centre to the last samples
        Vec3d local;         // the centre, local space
        double radius;       // from there to the corners, metres
    };

    bool clip(const Block& block, Samples& samples) const {
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t low = std::max(block.low[axis], fill_.begin_[axis]);
            const std::int32_t high = std::min(block.low[axis] + block.size, fill_.end_[axis]);
            if (low >= high) return false;
            samples.low[axis] = low;
            samples.count[axis] = high - low;
            samples.half[axis] = (high - low - 1) / 2.0;
            samples.center[axis] = low + samples.half[axis] + kShift;
        }
        samples.local = field_.localFromIndex(samples.center);
        samples.radius = 0;
        for (const double sx : {-1.0, 1.0})
            for (const double sy : {-1.0, 1.0})
                samples.radius = std::max(
                    samples.radius, length(field_.step(0) * (sx * samples.half.x) +
                                           field_.step(1) * (sy * samples.half.y) + field_.step(2) * samples.half.z));
        return true;
    }

    // Lists the lids of `parent` that touch the samples.
    Range lidsTouching(const Samples& samples, Range parent) {
        const std::size_t begin = lids_.size();
        for (std::size_t n = parent.begin; n < parent.end; ++n) {
            const WindingFill::LidTriangle& lid = fill_.lids_[lids_[n]];
            bool touches = true;
            double reach = kReach;
            for (int axis = 0; axis < 3; ++axis) {
                touches = touches && lid.low[axis] - kReach <= samples.center[axis] + samples.half[axis] &&
                          lid.high[axis] + kReach >= samples.center[axis] - samples.half[axis];
                reach += std::abs(lid.normal[axis]) * samples.half[axis];
            }
            if (touches && std::abs(dot(lid.normal, samples.center) - lid.offset) <= reach) lids_.push_back(lids_[n]);
        }
        return {begin, lids_.size()};
    }

    // Moves pieces that are far for all samples from `parent` to the polynomial of the block; lists the others.
    // \return a bound of the winding number of those listed
    double foldFar(const Samples& samples, Range parent, Block& block) {
        constexpr std::size_t kFew = 12;  // cheaper to evaluate than to fold
        constexpr double kMany = 256;     // maximum number of pieces whose errors add up
        if (block.size <= kSmallest && parent.end - parent.begin <= kFew) return kInfinity;
        block.near.begin = near_.size();
        folded_.clear();
        double bound = 0;
        const double cubed = samples.radius * samples.radius * samples.radius;
        const double allowed = foldError(block.size) * std::min(1.0, kMany / double(parent.end - parent.begin));
        for (std::size_t n = parent.begin; n < parent.end; ++n) {
            constexpr double kScale = 1 / (4 * std::numbers::pi);
            const std::uint32_t number = near_[n];
            const LidPiece& piece = field_.pieces()[number];
            const double away = distanceToBox(samples.local, piece.bounds) - samples.radius;
            if (away > 0) {
                const double inverse = 1 / away, squared = inverse * inverse;
                const double error =
                    kScale * cubed * squared * squared * std::min(piece.length, 4 * piece.area * inverse);
                if (error <= allowed) {
                    folded_.push_back(number);
                    continue;
                }
                bound += std::min(kScale * piece.area * squared, 0.5);
            } else {
                bound += 0.5;
            }
            near_.push_back(number);
        }
        block.near.end = near_.size();
        if (!folded_.empty()) block.far += field_.jet(folded_, samples.local, samples.radius);
        return bound;
    }

    [[nodiscard]] std::span<const std::uint32_t> nearOf(const Block& block) const {
        return std::span(near_).subspan(block.near.begin, block.near.end - block.near.begin);
    }

    // How far a jet departs from its value within the block.
    [[nodiscard]] double spread(const Jet& jet, const Samples& samples) const {
        const auto along = [&](Vec3d v, int axis) { return dot(v, field_.step(axis)) * samples.half[axis]; };
        double sum = jet.error;
        for (int a = 0; a < 3; ++a) {
            sum += std::abs(along(jet.gradient, a));
            const Vec3d column = jet.hessianTimes(field_.step(a) * samples.half[a]);
            for (int b = 0; b < 3; ++b) sum += std::abs(along(column, b)) / 2;
        }
        return sum;
    }

    void divide(Block block) {
        Samples samples;
        if (fill_.isOverBound() || !clip(block, samples)) return;
        const std::size_t nearEnd = near_.size(), lidsEnd = lids_.size();
        block.far = block.far.movedBy(samples.local - block.center);
        block.center = samples.local;
        fill_.work_ += block.near.end - block.near.begin + block.lids.end - block.lids.begin;
        block.lids = lidsTouching(samples, block.lids);
        const double bound = foldFar(samples, block.near, block);
        decide(block, samples, bound);
        near_.resize(nearEnd);
        lids_.resize(lidsEnd);
    }

    void decide(const Block& block, const Samples& samples, double nearBound) {
        const bool hasLids = block.lids.begin < block.lids.end;
        if (!hasLids && std::abs(block.far.value) + spread(block.far, samples) + nearBound < 0.25) return;
        if (block.size > kLargestLeaf) return halve(block);
        if (block.size <= kSmallest) return evaluateAll(block, samples);
        constexpr std::size_t kMany = 40;  // pieces: smaller blocks will have fewer
        if (block.size == kLargestLeaf && nearOf(block).size() > kMany) return halve(block);
        constexpr double kUseless = 0.1;  // an error that decides nothing
        Jet jet = field_.jet(nearOf(block), samples.local, samples.radius, kUseless);
        jet += block.far;
        if (!(jet.error <= kUseless)) return halve(block);
        const double range = spread(jet, samples);
        const double toHalf = distanceToHalf(jet.value);
        const bool hasOneDelta = !hasLids && toHalf > range + kTie;
        if (hasOneDelta && std::abs(toHalf - 0.25) > range) {
            if (const std::int32_t delta = deltaOf(jet.value); delta != 0) addBlock(samples, delta);
            if (toHalf < 0.25) part_.uncertain += volumeOf(samples);
            return;
        }
        if (hasOneDelta && jet.error <= kCountError) {
            if (const std::int32_t delta = deltaOf(jet.value); delta != 0) addBlock(samples, delta);
            return countUncertain(jet, samples);
        }
        // Samples that the error leaves open lie in a layer of this thickness in voxels.
        const Vec3d g{dot(jet.gradient, field_.step(0)), dot(jet.gradient, field_.step(1)),
                      dot(jet.gradient, field_.step(2))};
        const double open = 2 * jet.error / std::max(largest(g), 1e-300);
        if (!hasOneDelta && open <= kOpenLayer && jet.error <= kCountError && classify(block, samples, jet)) return;
        halve(block);
    }

    void halve(const Block& block) {
        Block part = block;
        part.parent = &block;
        part.size = block.size / 2;
        for (int n = 0; n < 8; ++n) {
            part.low = block.low + Vec3i{n & 1, n >> 1 & 1, n >> 2} * part.size;
            divide(part);
        }
    }

    static std::uint64_t volumeOf(const Samples& samples) {
        return std::uint64_t(samples.count.x) * std::uint64_t(samples.count.y) * std::uint64_t(samples.count.z);
    }

    void addRun(std::int32_t i, std::int32_t j, std::int32_t low, std::int32_t high, std::int32_t delta) {
        part_.corrections.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                                     static_cast<std::uint16_t>(low), static_cast<std::uint16_t>(high), delta});
    }

    void addBlock(const Samples& samples, std::int32_t delta) {
        for (std::int32_t j = samples.low.y; j < samples.low.y + samples.count.y; ++j)
            for (std::int32_t i = samples.low.x; i < samples.low.x + samples.count.x; ++i)
                addRun(i, j, samples.low.z, samples.low.z + samples.count.z, delta);
    }

    // Adds the runs of equal deltas_ of each column.
    void addDeltas(const Samples& samples) {
        const std::int32_t* delta = deltas_;
        for (std::int32_t j = 0; j < samples.count.y; ++j)
            for (std::int32_t i = 0; i < samples.count.x; ++i) {
                for (std::int32_t k = 0; k < samples.count.z;) {
                    const std::int32_t first = k, value = delta[k];
                    while (k < samples.count.z && delta[k] == value) ++k;
                    if (value != 0)
                        addRun(samples.low.x + i, samples.low.y + j, samples.low.z + first, samples.low.z + k, value);
                }
                delta += samples.count.z;
            }
    }

    // A jet along the columns of a block: value at sample (i, j, k) of it.
    struct Polynomial {
        double value, gx, gy, gz, xx, yy, zz, yz, xz, xy;
        Vec3d half;
        Polynomial(const Jet& jet, const Samples& samples, const LidField& field)
            : value(jet.value), half(samples.half) {
            const Vec3d x = field.step(0), y = field.step(1), z = field.step(2);
            const Vec3d hx = jet.hessianTimes(x), hy = jet.hessianTimes(y), hz = jet.hessianTimes(z);
            gx = dot(jet.gradient, x);
            gy = dot(jet.gradient, y);
            gz = dot(jet.gradient, z);
            xx = dot(hx, x) / 2;
            yy = dot(hy, y) / 2;
            zz = dot(hz, z) / 2;
            xy = dot(hx, y);
            xz = dot(hx, z);
            yz = dot(hy, z);
        }
        // Calls `body(n, value)` for the samples of column (i, j), n = 0 at the bottom.
        template <class Body>
        void column(std::int32_t i, std::int32_t j, std::int32_t count, Body&& body) const {
            const double x = i - half.x, y = j - half.y;
            const double constant = value + x * (gx + xx * x + xy * y) + y * (gy + yy * y);
            const double slope = gz + xz * x + yz * y;
            for (std::int32_t k = 0; k < count; ++k) {
                const double z = k - half.z;
                body(k, constant + z * (slope + zz * z));
            }
        }
        [[nodiscard]] double at(Vec3i n) const {
            const double x = n.x - half.x, y = n.y - half.y, z = n.z - half.z;
            return value + x * (gx + xx * x + xy * y) + y * (gy + yy * y) + z * (gz + xz * x + yz * y + zz * z);
        }
    };

    void countUncertain(const Jet& jet, const Samples& samples) {
        const Polynomial polynomial(jet, samples, field_);
        std::uint64_t uncertain = 0;
        for (std::int32_t j = 0; j < samples.count.y; ++j)
            for (std::int32_t i = 0; i < samples.count.x; ++i)
                polynomial.column(i, j, samples.count.z, [&](std::int32_t, double c) { uncertain += isUncertain(c); });
        part_.uncertain += uncertain;
    }

    // Whether the sample is so close to a lid of the block that its side must be decided on the lattice.
    [[nodiscard]] bool isClose(const Block& block, Vec3i sample) const {
        const Vec3d at{sample.x + kShift, sample.y + kShift, sample.z + kShift};
        for (std::size_t n = block.lids.begin; n < block.lids.end; ++n) {
            const WindingFill::LidTriangle& lid = fill_.lids_[lids_[n]];
            if (std::abs(dot(lid.normal, at) - lid.offset) <= kBand) return true;
        }
        return false;
    }

    // The change of c at a sample close to a lid if the sides of lids are decided on the lattice; NaN if only all
    // pieces together can decide.
    [[nodiscard]] double latticeDifference(const Block& block, Vec3i sample) const {
        constexpr double kAround = 1.0 / 8;  // voxels: lids farther away are seen alike on the lattice
        const Vec3d at{sample.x + kShift, sample.y + kShift, sample.z + kShift};
        double sum = 0;
        for (std::size_t n = block.lids.begin; n < block.lids.end; ++n) {
            const WindingFill::LidTriangle& lid = fill_.lids_[lids_[n]];
            if (std::abs(dot(lid.normal, at) - lid.offset) > kAround) continue;
            if (distanceToBox(at, {lid.low, lid.high}) > kAround) continue;
            sum += field_.latticeDifference(lids_[n], sample);
        }
        const double whole = std::nearbyint(sum);
        return std::abs(sum - whole) < 0.1 ? whole : std::numeric_limits<double>::quiet_NaN();
    }

    // c at a sample of the block.
    [[nodiscard]] double evaluate(const Block& block, Vec3i sample) {
        constexpr std::uint64_t kScalar = 16;  // a single sample takes as long as this number at once
        const Vec3d p = field_.localOfSample(sample);
        const bool close = isClose(block, sample);
        for (const Block* b = &block;; b = b->parent) {
            fill_.work_ += kScalar * nearOf(*b).size();
            const double c = b->far.at(p - b->center) +
                             (close ? field_.windingNear(nearOf(*b), sample) : field_.winding(nearOf(*b), p));
            if (b->parent == nullptr || distanceToHalf(c) > b->far.error + kTie) return c;
        }
    }

    void evaluateAll(const Block& block, const Samples& samples) {
        const auto forEach = [&](auto&& body) {
            std::size_t n = 0;
            for (std::int32_t j = 0; j < samples.count.y; ++j)
                for (std::int32_t i = 0; i < samples.count.x; ++i)
                    for (std::int32_t k = 0; k < samples.count.z; ++k) body(n++, Vec3i{i, j, k});
            return n;
        };
        positions_ = {};
        positions_.count = forEach([&](std::size_t n, Vec3i at) {
            const Vec3d p = field_.step(0) * (at.x - samples.half.x) + field_.step(1) * (at.y - samples.half.y) +
                            field_.step(2) * (at.z - samples.half.z);
            positions_.x[n] = p.x;
            positions_.y[n] = p.y;
            positions_.z[n] = p.z;
        });
        fill_.work_ += positions_.count * nearOf(block).size();
        double windings[kLidSamples];
        windingsAt(field_, nearOf(block), block.far, samples.local, positions_, windings);
        const bool hasLids = block.lids.begin < block.lids.end;
        const double margin = block.far.error + kArcError + kTie;
        forEach([&](std::size_t n, Vec3i at) {
            double c = windings[n];
            if (hasLids && isClose(block, samples.low + at)) c += latticeDifference(block, samples.low + at);
            if (!(distanceToHalf(c) > margin)) c = evaluate(block, samples.low + at);
            deltas_[n] = deltaOf(c);
            part_.uncertain += isUncertain(c);
        });
        addDeltas(samples);
    }

    // True if all lids of the block lie in one plane within the block.
    [[nodiscard]] bool isOnePlane(const Block& block, const Samples& samples) const {
        const WindingFill::LidTriangle& first = fill_.lids_[lids_[block.lids.begin]];
        const double at = dot(first.normal, samples.center) - first.offset;
        for (std::size_t n = block.lids.begin + 1; n < block.lids.end; ++n) {
            const WindingFill::LidTriangle& lid = fill_.lids_[lids_[n]];
            const double sign = dot(lid.normal, first.normal) < 0 ? -1 : 1;
            const Vec3d turn = lid.normal * sign - first.normal;
            const double shift = sign * (dot(lid.normal, samples.center) - lid.offset) - at;
            if (std::abs(shift) + length(scaled(turn, samples.half)) + length(turn) > kBand / 2) return false;
        }
        return true;
    }

    // Decides sample by sample. Returns false if the lids of the block are not in one plane.
    bool classify(const Block& block, const Samples& samples, const Jet& jet) {
        const bool hasLids = block.lids.begin < block.lids.end;
        Vec3d normal{};
        double offset = -1;  // without lids all samples are on the side > 0
        int jump[2] = {0, 0};
        const Polynomial polynomial(jet, samples, field_);
        if (hasLids) {
            if (!isOnePlane(block, samples)) return false;
            normal = fill_.lids_[lids_[block.lids.begin]].normal;
            offset = fill_.lids_[lids_[block.lids.begin]].offset;
            // On either side c and its smooth continuation differ by a whole number: read it at the farthest samples.
            for (const int side : {0, 1}) {
                Vec3i n;
                for (int axis = 0; axis < 3; ++axis)
                    n[axis] = (normal[axis] > 0) == (side == 1) ? samples.count[axis] - 1 : 0;
                const double smooth = polynomial.at(n);
                const double difference = evaluate(block, samples.low + n) - smooth;
                jump[side] = static_cast<int>(std::nearbyint(difference));
                if (std::abs(difference - jump[side]) > 0.05) return false;
            }
        }
        std::int32_t* delta = deltas_;
        std::uint64_t uncertain = 0;
        const double margin = jet.error + kTie;
        for (std::int32_t j = 0; j < samples.count.y; ++j)
            for (std::int32_t i = 0; i < samples.count.x; ++i) {
                const Vec3i bottom = samples.low + Vec3i{i, j, 0};
                const double height = normal.x * (bottom.x + kShift) + normal.y * (bottom.y + kShift) +
                                      normal.z * (bottom.z + kShift) - offset;
                polynomial.column(i, j, samples.count.z, [&](std::int32_t k, double smooth) {
                    const double away = height + normal.z * k;
                    double c = smooth + jump[away > 0];
                    if (distanceToHalf(c) <= margin || (std::abs(away) <= kBand && jump[0] != jump[1]))
                        c = evaluate(block, bottom + Vec3i{0, 0, k});
                    *delta++ = deltaOf(c);
                    uncertain += isUncertain(c);
                });
            }
        part_.uncertain += uncertain;
        addDeltas(samples);
        return true;
    }

    WindingFill& fill_;
    const LidField& field_;
    WindingFill::Part& part_;
    std::vector<std::uint32_t> near_, lids_;  // stacks of lists
    std::vector<std::uint32_t> folded_;
    LidSamples positions_;
    std::int32_t deltas_[kLargestLeaf * kLargestLeaf * kLargestLeaf];
};

WindingFill::WindingFill(const mesh::ObjectMesh& shell, const mesh::MeshSet& meshes, const volume::Grid& grid,
                         const IndexFromLocal& indexFromLocal, std::uint32_t claim, std::uint64_t solidAngles)
    : shell_(coverShell(shell)), lattice_(makeIndexMesh(shell_.mesh, indexFromLocal)), claim_(claim) {
    field_ = std::make_unique<LidField>(shell_, lattice_, grid, meshes.origin);
    for (const LidPiece& piece : field_->pieces()) {
        const Vec3d a = indexFromLocal.point(piece.apex), b = indexFromLocal.point(piece.from),
                    c = indexFromLocal.point(piece.to);
        Box3d bounds;
        for (const Vec3d& corner : {a, b, c}) bounds.add(corner);
        const Vec3d normal = normalized(cross(b - a, c - a));
        lids_.push_back({bounds.min, bounds.max, normal, dot(normal, a)});
    }
    // From outside its bounding box the shell is seen within a half-space.
    QuantaPoint low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    for (const QuantaPoint& point : lattice_.points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    for (int axis = 0; axis < 3; ++axis) {
        const auto sample = [&](std::int32_t quanta) {
            return std::clamp<std::int32_t>(static_cast<std::int32_t>(firstSampleAbove(quanta)), 0,
                                            grid.dimension()[axis]);
        };
        begin_[axis] = sample(low[std::size_t(axis)]);
        end_[axis] = sample(high[std::size_t(axis)]);
    }
    const double box = double(end_.x - begin_.x) * double(end_.y - begin_.y) * double(end_.z - begin_.z);
    bound_ = solidAngles + static_cast<std::uint64_t>(20'000 * std::cbrt(box * box));
    if (shell_.loops.empty() || begin_.x >= end_.x || begin_.y >= end_.y || begin_.z >= end_.z) return;
    const auto first = [](std::int32_t sample) { return sample / kPartSize * kPartSize; };
    for (std::int32_t z = first(begin_.z); z < end_.z; z += kPartSize)
        for (std::int32_t y = first(begin_.y); y < end_.y; y += kPartSize)
            for (std::int32_t x = first(begin_.x); x < end_.x; x += kPartSize) parts_.push_back({{x, y, z}, {}, 0});
}

std::size_t WindingFill::runPart(std::size_t n) {
    WindingBlocks(*this, parts_[n]).run();
    return parts_[n].corrections.size();
}

std::uint64_t WindingFill::finish(std::vector<ClaimedBox>& boxes) {
    if (isOverBound()) parts_.clear();
    std::uint64_t uncertain = 0;
    std::int32_t least = 0, most = 0;
    for (const Part& part : parts_) {
        uncertain += part.uncertain;
        for (const Correction& c : part.corrections) {
            least = std::min(least, c.delta);
            most = std::max(most, c.delta);
        }
    }
    // Boxes that count one, in as many layers as needed.
    std::vector<ClaimedBox> layer;
    for (std::int32_t level = least; level <= most; ++level) {
        if (level == 0) continue;
        layer.clear();
        for (const Part& part : parts_)
            for (const Correction& c : part.corrections)
                if (level > 0 ? c.delta >= level : c.delta <= level)
                    layer.push_back({c.j, c.j + 1, c.i, c.i + 1, c.low, c.high, claim_, level < 0});
        addDisjoint(layer, boxes);
    }
    parts_.clear();
    return uncertain;
}

double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept {
    const auto solidAngle = [](Vec3d a, Vec3d b, Vec3d c) {
        return 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    };
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles)
        sum += solidAngle(normalized(mesh.vertices[triangle.corners[0]] - point),
                          normalized(mesh.vertices[triangle.corners[1]] - point),
                          normalized(mesh.vertices[triangle.corners[2]] - point));
    return sum / (4 * std::numbers::pi);
}

}  // namespace svt::voxelize
