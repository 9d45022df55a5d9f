#include <svt/writers/foam/air_cells.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/simulation/air_labels.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace svt::writers {
namespace {

using volume::kNoLabel;
using volume::Run;
using volume::Scalar;
using volume::SemanticVolume;

constexpr std::uint64_t kBoxPerCell = 8;  // voxels of the box for each cell that the bound allows
// OpenFOAM numbers cells, points and faces with 31 bits, and a cell has three faces of its own.
constexpr std::uint64_t kMostCells = 600'000'000, kMostVoxels = std::uint64_t{1} << 31;
constexpr std::uint64_t kSmallPart = 100;  // pieces below one hundredth of the largest are left out
constexpr std::size_t kNamedPieces = 3;    // of an error
constexpr std::int32_t kNotReached = -2;   // air that belongs to no piece yet

// The chosen rooms.
class Air {
public:
    static Result<Air> of(const SemanticVolume& volume, const std::string& query) {
        Air air(volume);
        std::vector<std::uint32_t> spaces = airOfLabels(volume.labels);
        if (!query.empty()) {
            SVT_TRY(selected, analyze::selectWithParts(volume, query));
            std::vector<bool> isSelected(spaces.size());
            for (const std::uint32_t label : *selected) isSelected[label] = true;
            for (std::size_t l = 0; l < spaces.size(); ++l)
                if (spaces[l] != kNoLabel && !isSelected[spaces[l]]) spaces[l] = kNoLabel;
        }
        const auto boxes = analyze::labelBoxes(volume.columns, volume.labels);
        for (std::size_t l = 0; l < spaces.size(); ++l) {
            const volume::Label& label = volume.labels.labels[l];
            if (spaces[l] == kNoLabel || label.voxels == 0) continue;
            air.voxels += label.voxels;
            air.box.add(boxes[l]);
            for (Scalar s = label.first; s < label.first + label.count; ++s) air.spaceOfScalar[s] = spaces[l];
        }
        if (air.voxels > 0) return air;
        return Error(Code::NothingSelected, query.empty()
                                                ? "the volume has no air of rooms, which a case of OpenFOAM consists of"
                                                : fmt::format("'{}' selects no room with voxels", query));
    }

    std::vector<std::uint32_t> spaceOfScalar;  // kNoLabel: no air
    analyze::SampleBox box;
    std::uint64_t voxels = 0;

private:
    explicit Air(const SemanticVolume& volume) : spaceOfScalar(volume.labels.scalarCount(), kNoLabel) {}
};

// A connected part of the air.
struct Piece {
    std::uint64_t voxels = 0;
    std::size_t first = 0;  // index of a voxel of it
};

class PieceFinder {
public:
    explicit PieceFinder(AirCells& cells) : cells_(cells) {}

    // Numbers the voxels of each piece by the piece.
    std::vector<Piece> run() {
        std::vector<Piece> pieces;
        for (std::size_t index = 0; index < cells_.numbers.size(); ++index) {
            if (cells_.numbers[index] != kNotReached) continue;
            pieces.push_back({0, index});
            enter(index, static_cast<std::int32_t>(pieces.size() - 1));
            while (!open_.empty()) {
                const std::size_t at = open_.back();
                open_.pop_back();
                ++pieces.back().voxels;
                spread(at, static_cast<std::int32_t>(pieces.size() - 1));
            }
        }
        return pieces;
    }

private:
    void enter(std::size_t index, std::int32_t piece) {
        cells_.numbers[index] = piece;
        open_.push_back(index);
    }

    void spread(std::size_t at, std::int32_t piece) {
        const auto nx = static_cast<std::size_t>(cells_.size.x), ny = static_cast<std::size_t>(cells_.size.y);
        const std::array<std::size_t, 3> steps{1, nx, nx * ny};
        const Vec3i voxel = cells_.voxelAt(at);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t step = steps[static_cast<std::size_t>(axis)];
            if (voxel[axis] > 0 && cells_.numbers[at - step] == kNotReached) enter(at - step, piece);
            if (voxel[axis] + 1 < cells_.size[axis] && cells_.numbers[at + step] == kNotReached)
                enter(at + step, piece);
        }
    }

    AirCells& cells_;
    std::vector<std::size_t> open_;
};

// Marks the air of the box.
void markAir(const SemanticVolume& volume, const Air& air, AirCells& cells) {
    cells.first = air.box.min;
    cells.size = air.box.max - air.box.min + Vec3i{1, 1, 1};
    cells.numbers.assign(static_cast<std::size_t>(cells.size.x) * static_cast<std::size_t>(cells.size.y) *
                             static_cast<std::size_t>(cells.size.z),
                         AirCells::kNone);
    for (std::int32_t j = 0; j < cells.size.y; ++j)
        for (std::int32_t i = 0; i < cells.size.x; ++i) {
            std::int32_t k = 0;
            for (const Run& run : volume.columns.column(cells.first.x + i, cells.first.y + j)) {
                const std::int32_t end = std::min(static_cast<std::int32_t>(run.end) - cells.first.z, cells.size.z);
                if (air.spaceOfScalar[run.scalar] != kNoLabel)
                    for (; k < end; ++k) cells.numbers[cells.indexOf({i, j, k})] = kNotReached;
                k = std::max(k, end);
            }
        }
}

// "'Kitchen' with 8359 cells, 'Hall' with 1200 cells"
std::string largestPieces(const SemanticVolume& volume, const Air& air, const AirCells& cells,
                          std::vector<Piece> pieces) {
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.voxels > b.voxels; });
    std::string text;
    for (std::size_t p = 0; p < std::min(pieces.size(), kNamedPieces); ++p) {
        const Vec3i of = cells.first + cells.voxelAt(pieces[p].first);
        const std::uint32_t room = air.spaceOfScalar[volume.columns.scalarAt(of.x, of.y, of.z)];
        text += fmt::format("{}'{}' with {} cells", text.empty() ? "" : ", ", shownName(volume.labels.labels[room]),
                            pieces[p].voxels);
    }
    return text;
}

}  // namespace

Result<AirCells> airCells(const SemanticVolume& volume, const std::string& query, std::uint64_t maxCells) {
    SVT_TRY(air, Air::of(volume, query));
    const Vec3i size = air->box.max - air->box.min + Vec3i{1, 1, 1};
    const auto box =
        static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) * static_cast<std::uint64_t>(size.z);
    maxCells = std::min(maxCells, kMostCells);
    if (air->voxels > maxCells || box > std::min(kBoxPerCell * maxCells, kMostVoxels))
        return Error(Code::BadArgument,
                     fmt::format("the air has {} voxels in a box of {}, more than the bound of {} cells; choose rooms "
                                 "with --air, take larger cells with --level, or raise --max-voxels",
                                 air->voxels, box, maxCells));
    AirCells cells;
    markAir(volume, *air, cells);
    const std::vector<Piece> pieces = PieceFinder(cells).run();
    const auto largest = std::max_element(pieces.begin(), pieces.end(),
                                          [](const Piece& a, const Piece& b) { return a.voxels < b.voxels; });
    cells.leftOut = air->voxels - largest->voxels;
    if (cells.leftOut > largest->voxels / kSmallPart)
        return Error(
            Code::BadArgument,
            fmt::format("the air is in {} pieces that do not touch, and a case of OpenFOAM has one; the largest "
                        "are {}; choose rooms with --air, such as --air 'name=Kitchen'",
                        pieces.size(), largestPieces(volume, *air, cells, pieces)));
    const auto kept = static_cast<std::int32_t>(largest - pieces.begin());
    for (std::int32_t& number : cells.numbers)
        number = number == kept ? static_cast<std::int32_t>(cells.count++) : AirCells::kNone;
    return cells;
}

}  // namespace svt::writers
