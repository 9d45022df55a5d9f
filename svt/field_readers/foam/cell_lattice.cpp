#include <svt/field_readers/foam/cell_lattice.hpp>

#include <svt/field_readers/foam/foam_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::field_readers {
namespace {

constexpr double kSlack = 1e-3;  // of the smallest cell: OpenFOAM writes six digits by default
constexpr std::size_t kMostNodesPerCell = 16;
constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

using Labels = std::vector<std::int64_t>;

class LatticeReader {
public:
    LatticeReader(const std::filesystem::path& folder, std::uint64_t maxBytes)
        : folder_(folder / "constant" / "polyMesh"), maxBytes_(maxBytes) {}

    Result<CellLattice> read() {
        SVT_DO(readPoints());
        SVT_DO(readCells());
        for (std::size_t axis = 0; axis < 3; ++axis) SVT_DO(setPlaces(axis));
        if (lattice_.nodes() / kMostNodesPerCell > boxes_.size())
            return Error(Code::InputTooBig,
                         fmt::format("the {} cells have sizes that need a lattice of {} nodes; give them one size, or "
                                     "resample the results (ResampleToImage of ParaView) and add the .vti",
                                     boxes_.size(), lattice_.nodes()),
                         {folder_.string(), 0, 0, {}});
        SVT_DO(setNodes());
        return std::move(lattice_);
    }

private:
    template <class Read>
    auto readFile(const char* name, const Read& read) -> decltype(read(std::declval<FoamReader&>())) {
        SVT_TRY(bytes, foamBytes(folder_ / name, maxBytes_));
        SVT_TRY(reader, FoamReader::open(*bytes, folder_ / name));
        return read(*reader);
    }

    Result<void> readPoints() {
        const auto read = [this](FoamReader& reader) -> Result<std::vector<double>> {
            lattice_.frame = frameOfComment(reader.header().note);
            return reader.scalars(3);
        };
        SVT_TRY(points, readFile("points", read));
        points_ = std::move(*points);
        return {};
    }

    Result<void> readCells() {
        SVT_TRY(faces, readFile("faces", [](FoamReader& reader) { return reader.lists(); }));
        SVT_TRY(owner, readFile("owner", [](FoamReader& reader) { return reader.labels(); }));
        SVT_TRY(neighbour, readFile("neighbour", [](FoamReader& reader) { return reader.labels(); }));
        const std::size_t count = faces->starts.size() - 1;
        if (owner->size() != count || neighbour->size() > count)
            return badField(
                fmt::format("{} faces have {} owners and {} neighbours", count, owner->size(), neighbour->size()),
                folder_);
        std::int64_t cells = 0;
        for (const Labels* of : {&*owner, &*neighbour})
            for (const std::int64_t cell : *of) cells = std::max(cells, cell + 1);
        if (cells == 0 || static_cast<std::size_t>(cells) > count)
            return badField(fmt::format("{} faces cannot have {} cells", count, cells), folder_);
        boxes_.resize(static_cast<std::size_t>(cells));
        for (std::size_t face = 0; face < count; ++face) {
            SVT_TRY(box, boxOfFace(*faces, face));
            SVT_DO(addFace((*owner)[face], *box, face));
            if (face < neighbour->size()) SVT_DO(addFace((*neighbour)[face], *box, face));
        }
        return {};
    }

    Result<Box3d> boxOfFace(const FoamReader::Lists& faces, std::size_t face) const {
        Box3d box;
        const auto begin = static_cast<std::size_t>(faces.starts[face]);
        const auto end = static_cast<std::size_t>(faces.starts[face + 1]);
        for (std::size_t n = begin; n < end; ++n) {
            const std::int64_t point = faces.labels[n];
            if (point < 0 || static_cast<std::size_t>(point) >= points_.size() / 3)
                return badField(
                    fmt::format("face {} has the point {}, and the mesh has {}", face, point, points_.size() / 3),
                    folder_ / "faces");
            const double* at = &points_[3 * static_cast<std::size_t>(point)];
            if (!std::isfinite(at[0] + at[1] + at[2]))
                return badField(fmt::format("point {} is not finite", point), folder_ / "points");
            box.add(Vec3d{at[0], at[1], at[2]});
        }
        const Vec3d size = box.size();
        const double longest = std::max({size.x, size.y, size.z});
        const int flat = static_cast<int>(size.x <= kSlack * longest) + static_cast<int>(size.y <= kSlack * longest) +
                         static_cast<int>(size.z <= kSlack * longest);
        if (begin == end || flat != 1)
            return badField(
                fmt::format("face {} does not lie across an axis, so the cells are not boxes; resample the results "
                            "(ResampleToImage of ParaView) and add the .vti",
                            face),
                folder_ / "faces");
        return box;
    }

    Result<void> addFace(std::int64_t cell, const Box3d& box, std::size_t face) {
        if (cell < 0) return badField(fmt::format("face {} has the cell {}", face, cell), folder_ / "owner");
        boxes_[static_cast<std::size_t>(cell)].add(box);
        return {};
    }

    [[nodiscard]] double centre(std::size_t cell, std::size_t axis) const noexcept {
        const int a = static_cast<int>(axis);
        return (boxes_[cell].min[a] + boxes_[cell].max[a]) / 2;
    }

    Result<void> setPlaces(std::size_t axis) {
        std::vector<double> centres(boxes_.size());
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t cell = 0; cell < boxes_.size(); ++cell) {
            centres[cell] = centre(cell, axis);
            smallest = std::min(smallest, boxes_[cell].size()[static_cast<int>(axis)]);
        }
        if (!(smallest > 0)) return badField("a cell has no extent", folder_);
        std::sort(centres.begin(), centres.end());
        std::vector<double>& places = lattice_.places[axis];
        for (const double at : centres)
            if (places.empty() || at > places.back() + kSlack * smallest) places.push_back(at);
        return {};
    }

    Result<void> setNodes() {
        std::vector<bool> isTaken(lattice_.nodes());
        lattice_.nodeOfCell.resize(boxes_.size(), kFree);
        for (std::size_t cell = 0; cell < boxes_.size(); ++cell) {
            std::size_t node = 0;
            for (std::size_t axis = 3; axis-- > 0;) {
                const std::vector<double>& places = lattice_.places[axis];
                const auto above = std::upper_bound(places.begin(), places.end(), centre(cell, axis));
                node = node * places.size() + static_cast<std::size_t>(above - places.begin()) - 1;
            }
            if (isTaken[node]) return badField(fmt::format("cell {} lies where another one lies", cell), folder_);
            isTaken[node] = true;
            lattice_.nodeOfCell[cell] = static_cast<std::uint32_t>(node);
        }
        return {};
    }

    std::filesystem::path folder_;
    std::uint64_t maxBytes_;
    std::vector<double> points_;
    std::vector<Box3d> boxes_;
    CellLattice lattice_;
};

}  // namespace

Result<CellLattice> readCellLattice(const std::filesystem::path& folder, std::uint64_t maxBytes) {
    return LatticeReader(folder, maxBytes).read();
}

}  // namespace svt::field_readers
