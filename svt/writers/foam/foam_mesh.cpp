#include <svt/writers/foam/foam_mesh.hpp>

#include <svt/core/text.hpp>
#include <svt/writers/foam/foam_file.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/simulation/air_labels.hpp>
#include <svt/writers/simulation/solid_boxes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace svt::writers {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

constexpr std::size_t kLongestName = 60;

// A side of a cell: axis 0 to 2, towards higher or lower coordinates.
struct BorderFace {
    std::uint32_t label = kNoLabel;
    std::uint32_t cell = 0;
    std::uint32_t voxel = 0;  // of the box, see airCells() for its bound
    std::uint8_t axis = 0;
    bool isUpper = false;
};

// A word that OpenFOAM and shells take without quotes.
std::string foamWord(std::string_view text) {
    std::string word;
    for (std::size_t i = 0; i < text.size() && word.size() < kLongestName;) {
        const Utf8Character character = firstCharacter(text.substr(i));
        const bool isPlain = character.code < 128 && (isLetter(static_cast<char>(character.code)) ||
                                                      isDigit(static_cast<char>(character.code)));
        word += isPlain ? static_cast<char>(character.code) : '_';
        i += std::max<std::size_t>(character.size, 1);
    }
    if (word.empty() || !isLetter(word.front())) word.insert(0, "part_");
    return word;
}

class MeshWriter {
public:
    MeshWriter(const SemanticVolume& volume, const AirCells& cells, NewFolder& folder)
        : volume_(volume), cells_(cells), folder_(folder) {}

    Result<std::vector<FoamPatch>> write() {
        findBorder();
        listPatches();
        SVT_DO(writePoints());
        SVT_DO(writeFaces());
        SVT_DO(writeCellsOfFaces());
        SVT_DO(writeBoundary());
        return std::move(patches_);
    }

private:
    // Calls use(voxel, number) for each cell, in the order of their numbers.
    template <class Use>
    void forEachCell(const Use& use) const {
        std::size_t index = 0;
        for (std::int32_t k = 0; k < cells_.size.z; ++k)
            for (std::int32_t j = 0; j < cells_.size.y; ++j)
                for (std::int32_t i = 0; i < cells_.size.x; ++i, ++index)
                    if (const std::int32_t number = cells_.numbers[index]; number != AirCells::kNone)
                        use(Vec3i{i, j, k}, static_cast<std::uint32_t>(number));
    }

    // Calls use(voxel, number, axis, other) for each inner face, in the order that OpenFOAM needs.
    template <class Use>
    void forEachInnerFace(const Use& use) const {
        forEachCell([&](Vec3i voxel, std::uint32_t number) {
            for (int axis = 0; axis < 3; ++axis) {
                Vec3i beside = voxel;
                ++beside[axis];
                if (const std::int32_t other = cells_.at(beside); other != AirCells::kNone)
                    use(voxel, number, axis, other);
            }
        });
    }

    [[nodiscard]] std::uint32_t labelAt(Vec3i voxel) const {
        const Vec3i at = cells_.first + voxel, size = volume_.columns.dimension();
        for (int axis = 0; axis < 3; ++axis)
            if (at[axis] < 0 || at[axis] >= size[axis]) return kNoLabel;
        return labelOfScalar_[volume_.columns.scalarAt(at.x, at.y, at.z)];
    }

    void findBorder() {
        labelOfScalar_.assign(volume_.labels.scalarCount(), kNoLabel);
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l) {
            const volume::Label& label = volume_.labels.labels[l];
            for (volume::Scalar s = label.first; s < label.first + label.count; ++s) labelOfScalar_[s] = l;
        }
        forEachCell([&](Vec3i voxel, std::uint32_t number) {
            for (std::uint8_t axis = 0; axis < 3; ++axis)
                for (const bool isUpper : {false, true}) {
                    Vec3i beside = voxel;
                    beside[axis] += isUpper ? 1 : -1;
                    if (cells_.at(beside) == AirCells::kNone)
                        border_.push_back({labelAt(beside), number, static_cast<std::uint32_t>(cells_.indexOf(voxel)),
                                           axis, isUpper});
                    else if (isUpper)
                        ++innerFaces_;
                }
        });
        std::stable_sort(border_.begin(), border_.end(),
                         [](const BorderFace& a, const BorderFace& b) { return a.label < b.label; });
    }

    void listPatches() {
        const Vec3d spacing = volume_.grid.spacing();
        const std::array<double, 3> areas{spacing.y * spacing.z, spacing.x * spacing.z, spacing.x * spacing.y};
        const std::vector<std::uint32_t> air = airOfLabels(volume_.labels);
        std::array<std::uint64_t, 3> faces{};
        std::set<std::string> used;
        const auto close = [&] {
            FoamPatch& patch = patches_.back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                patch.faces += static_cast<std::uint32_t>(faces[axis]);
                patch.area += static_cast<double>(faces[axis]) * areas[axis];
            }
            faces = {};
        };
        for (const BorderFace& face : border_) {
            if (patches_.empty() || patches_.back().label != face.label) {
                if (!patches_.empty()) close();
                const std::string word =
                    face.label == kNoLabel ? "background" : foamWord(shownName(volume_.labels.labels[face.label]));
                std::string name = word;
                for (int n = 2; !used.insert(name).second; ++n) name = fmt::format("{}_{}", word, n);
                patches_.push_back(
                    {face.label, std::move(name), face.label != kNoLabel && air[face.label] != kNoLabel, 0, 0});
            }
            ++faces[face.axis];
        }
        if (!patches_.empty()) close();
    }

    [[nodiscard]] std::size_t nodeIndex(Vec3i node) const noexcept {
        return static_cast<std::size_t>(node.x) +
               static_cast<std::size_t>(cells_.size.x + 1) *
                   (static_cast<std::size_t>(node.y) +
                    static_cast<std::size_t>(cells_.size.y + 1) * static_cast<std::size_t>(node.z));
    }

    Result<void> writePoints() {
        pointOfNode_.assign(nodeIndex(cells_.size) + 1, AirCells::kNone);
        forEachCell([&](Vec3i voxel, std::uint32_t) {
            for (int corner = 0; corner < 8; ++corner)
                pointOfNode_[nodeIndex(voxel + Vec3i{corner & 1, corner >> 1 & 1, corner >> 2})] = 0;
        });
        std::uint32_t points = 0;
        for (std::int32_t& point : pointOfNode_)
            if (point != AirCells::kNone) point = static_cast<std::int32_t>(points++);
        FoamFile file(folder_, "constant/polyMesh/points", "vectorField", placeText(volume_.grid));
        file.line("{}\n(", points);
        std::size_t index = 0;
        for (std::int32_t k = 0; k <= cells_.size.z; ++k)
            for (std::int32_t j = 0; j <= cells_.size.y; ++j)
                for (std::int32_t i = 0; i <= cells_.size.x; ++i) {
                    if (pointOfNode_[index++] == AirCells::kNone) continue;
                    const Vec3d at = cornerOf(cells_.first + Vec3i{i, j, k}, volume_.grid);
                    file.line("({} {} {})", at.x, at.y, at.z);
                }
        file.line(")");
        return file.end();
    }

    // The upper side of a voxel across an axis, anticlockwise as seen from above; the lower side clockwise.
    void addFace(FoamFile& file, Vec3i voxel, int axis, bool isUpper) const {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        std::array<std::int32_t, 4> points{};
        Vec3i node = voxel;
        if (isUpper) ++node[axis];
        const auto point = [&] { return pointOfNode_[nodeIndex(node)]; };
        points[0] = point();
        ++node[next];
        points[isUpper ? 1 : 3] = point();
        ++node[last];
        points[2] = point();
        --node[next];
        points[isUpper ? 3 : 1] = point();
        file.line("4({} {} {} {})", points[0], points[1], points[2], points[3]);
    }

    Result<void> writeFaces() {
        FoamFile file(folder_, "constant/polyMesh/faces", "faceList");
        file.line("{}\n(", innerFaces_ + border_.size());
        forEachInnerFace([&](Vec3i voxel, std::uint32_t, int axis, std::int32_t) { addFace(file, voxel, axis, true); });
        for (const BorderFace& face : border_) addFace(file, cells_.voxelAt(face.voxel), face.axis, face.isUpper);
        file.line(")");
        return file.end();
    }

    Result<void> writeCellsOfFaces() {
        const std::string counts = fmt::format("nCells:{} nFaces:{} nInternalFaces:{}", cells_.count,
                                               innerFaces_ + border_.size(), innerFaces_);
        FoamFile owner(folder_, "constant/polyMesh/owner", "labelList", counts);
        owner.line("{}\n(", innerFaces_ + border_.size());
        forEachInnerFace([&](Vec3i, std::uint32_t number, int, std::int32_t) { owner.line("{}", number); });
        for (const BorderFace& face : border_) owner.line("{}", face.cell);
        owner.line(")");
        SVT_DO(owner.end());
        FoamFile neighbour(folder_, "constant/polyMesh/neighbour", "labelList", counts);
        neighbour.line("{}\n(", innerFaces_);
        forEachInnerFace([&](Vec3i, std::uint32_t, int, std::int32_t other) { neighbour.line("{}", other); });
        neighbour.line(")");
        return neighbour.end();
    }

    Result<void> writeBoundary() {
        FoamFile file(folder_, "constant/polyMesh/boundary", "polyBoundaryMesh");
        file.line("{}\n(", patches_.size());
        std::uint64_t first = innerFaces_;
        for (const FoamPatch& patch : patches_) {
            file.line("    {}\n    {{\n        type {};\n        nFaces {};\n        startFace {};\n    }}", patch.name,
                      patch.isAir ? "patch" : "wall", patch.faces, first);
            first += patch.faces;
        }
        file.line(")");
        return file.end();
    }

    const SemanticVolume& volume_;
    const AirCells& cells_;
    NewFolder& folder_;
    std::vector<std::uint32_t> labelOfScalar_;
    std::vector<BorderFace> border_;
    std::uint64_t innerFaces_ = 0;
    std::vector<FoamPatch> patches_;
    std::vector<std::int32_t> pointOfNode_;
};

}  // namespace

Result<std::vector<FoamPatch>> writeFoamMesh(const SemanticVolume& volume, const AirCells& cells, NewFolder& folder) {
    return MeshWriter(volume, cells, folder).write();
}

}  // namespace svt::writers
