#include <svt/field_writers/write_lattice.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/fields/lattice_nodes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace svt::field_writers {
namespace {

using fields::Field;
using fields::FieldHead;
using volume::Grid;

/// A field at one time, and where its nodes are.
struct Lattice {
    const Field& field;
    const Grid& grid;
    std::size_t time = 0;

    [[nodiscard]] Vec3i size() const noexcept { return field.head.lattice.size; }
    [[nodiscard]] bool isRegular() const noexcept { return field.head.lattice.positions[0].empty(); }
    [[nodiscard]] std::size_t nodes() const noexcept { return fields::placeCount(field.head, 0); }
    /// Node (0, 0, 0), world space.
    [[nodiscard]] Vec3d origin() const noexcept { return grid.worldFromIndex(fields::nodeAt(field.head.lattice, 0)); }
    /// Metres between nodes of a regular lattice.
    [[nodiscard]] Vec3d step() const noexcept {
        const Vec3d step = field.head.lattice.step, spacing = grid.spacing();
        return {step.x * spacing.x, step.y * spacing.y, step.z * spacing.z};
    }
    [[nodiscard]] float value(std::size_t node, int component) const noexcept {
        const auto components = static_cast<std::size_t>(field.head.components);
        return field.values[(time * components + static_cast<std::size_t>(component)) * nodes() + node];
    }
};

bool isAlongWorldAxes(const Grid& grid) noexcept {
    const auto& axes = grid.axes();
    return axes[0] == Vec3d{1, 0, 0} && axes[1] == Vec3d{0, 1, 0} && axes[2] == Vec3d{0, 0, 1};
}

Result<void> writeFloats(const std::vector<float>& floats, AtomicFile& file) {
    return file.write(std::as_bytes(std::span(floats)));
}

// The values node by node, x fastest; vectors along the axes of the world.
Result<void> writeValues(const Lattice& lattice, AtomicFile& file) {
    constexpr std::size_t kNodesAtOnce = std::size_t{1} << 20;
    const auto& [x, y, z] = lattice.grid.axes();
    const bool isVector = lattice.field.head.components == 3;
    std::vector<float> floats;
    for (std::size_t begin = 0; begin < lattice.nodes(); begin += kNodesAtOnce) {
        floats.clear();
        for (std::size_t n = begin; n < std::min(begin + kNodesAtOnce, lattice.nodes()); ++n) {
            if (!isVector) {
                floats.push_back(lattice.value(n, 0));
                continue;
            }
            const Vec3d v =
                x * double{lattice.value(n, 0)} + y * double{lattice.value(n, 1)} + z * double{lattice.value(n, 2)};
            for (int axis = 0; axis < 3; ++axis) floats.push_back(static_cast<float>(v[axis]));
        }
        SVT_DO(writeFloats(floats, file));
    }
    return {};
}

Result<void> writeCount(std::uint64_t bytes, AtomicFile& file) {
    return file.write(std::as_bytes(std::span(&bytes, 1)));
}

std::uint64_t valueBytes(const Lattice& lattice) noexcept {
    return lattice.nodes() * static_cast<std::uint64_t>(lattice.field.head.components) * sizeof(float);
}

// An array of strings: the numbers of their bytes, with 0 behind each.
std::string vtkText(std::string_view name, std::string_view value) {
    std::string text = fmt::format(R"(<Array type="String" Name="{}" NumberOfTuples="1" format="ascii">)", name);
    for (const char c : value) text += fmt::format("{} ", static_cast<unsigned char>(c));
    return text + "0 </Array>\n";
}

// The elements that image data and rectilinear grids share.
std::string vtkFieldData(const Lattice& lattice) {
    const FieldHead& head = lattice.field.head;
    std::string text = "<FieldData>\n";
    text +=
        fmt::format(R"(<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)",
                    head.times[lattice.time]);
    text += '\n' + vtkText("unit", head.unit) + vtkText("quantity", head.quantity) + vtkText("medium", head.medium);
    if (head.epoch) text += vtkText("epoch", *head.epoch);
    return text + "</FieldData>\n";
}

std::string vtkExtent(Vec3i size) { return fmt::format("0 {} 0 {} 0 {}", size.x - 1, size.y - 1, size.z - 1); }

std::string vtkPointData(const FieldHead& head) {
    return fmt::format(
        "<PointData {0}=\"{1}\">\n<DataArray type=\"Float32\" Name=\"{1}\" NumberOfComponents=\"{2}\" "
        "format=\"appended\" offset=\"0\"/>\n</PointData>\n<CellData/>\n",
        head.components == 3 ? "Vectors" : "Scalars", head.name, head.components);
}

constexpr std::string_view kVtkEnd = "\n</AppendedData>\n</VTKFile>\n";

std::string vtkBegin(std::string_view type) {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
        type);
}

Result<void> writeVti(const Lattice& lattice, AtomicFile& file) {
    const Vec3d origin = lattice.origin(), step = lattice.step();
    const auto& [x, y, z] = lattice.grid.axes();
    const std::string extent = vtkExtent(lattice.size());
    std::string text = vtkBegin("ImageData");
    text += fmt::format(R"(<ImageData WholeExtent="{}" Origin="{} {} {}" Spacing="{} {} {}")", extent, origin.x,
                        origin.y, origin.z, step.x, step.y, step.z);
    text += fmt::format(" Direction=\"{} {} {} {} {} {} {} {} {}\">\n", x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
    text += vtkFieldData(lattice) + fmt::format("<Piece Extent=\"{}\">\n", extent) + vtkPointData(lattice.field.head) +
            "</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
    SVT_DO(file.write(text));
    SVT_DO(writeCount(valueBytes(lattice), file));
    SVT_DO(writeValues(lattice, file));
    return file.write(kVtkEnd);
}

// World coordinates of the nodes along an axis.
std::vector<double> coordinatesAlong(const Lattice& lattice, int axis) {
    const fields::Lattice& nodes = lattice.field.head.lattice;
    const auto& positions = nodes.positions[static_cast<std::size_t>(axis)];
    std::vector<double> coordinates;
    for (std::int32_t n = 0; n < nodes.size[axis]; ++n) {
        Vec3d index{};
        index[axis] =
            positions.empty() ? nodes.first[axis] + n * nodes.step[axis] : positions[static_cast<std::size_t>(n)];
        coordinates.push_back(lattice.grid.worldFromIndex(index)[axis]);
    }
    return coordinates;
}

Result<void> writeVtr(const Lattice& lattice, AtomicFile& file) {
    const std::string extent = vtkExtent(lattice.size());
    std::string text = vtkBegin("RectilinearGrid");
    text += fmt::format("<RectilinearGrid WholeExtent=\"{}\">\n", extent) + vtkFieldData(lattice) +
            fmt::format("<Piece Extent=\"{}\">\n", extent) + vtkPointData(lattice.field.head) + "<Coordinates>\n";
    std::array<std::vector<double>, 3> coordinates;
    std::uint64_t offset = sizeof(std::uint64_t) + valueBytes(lattice);
    for (int axis = 0; axis < 3; ++axis) {
        auto& along = coordinates[static_cast<std::size_t>(axis)] = coordinatesAlong(lattice, axis);
        text += fmt::format("<DataArray type=\"Float64\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                            std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1), offset);
        offset += sizeof(std::uint64_t) + along.size() * sizeof(double);
    }
    text += "</Coordinates>\n</Piece>\n</RectilinearGrid>\n<AppendedData encoding=\"raw\">\n_";
    SVT_DO(file.write(text));
    SVT_DO(writeCount(valueBytes(lattice), file));
    SVT_DO(writeValues(lattice, file));
    for (const std::vector<double>& along : coordinates) {
        SVT_DO(writeCount(along.size() * sizeof(double), file));
        SVT_DO(file.write(std::as_bytes(std::span(along))));
    }
    return file.write(kVtkEnd);
}

Result<void> writeNrrd(const Lattice& lattice, AtomicFile& file) {
    const FieldHead& head = lattice.field.head;
    const Vec3d origin = lattice.origin(), step = lattice.step();
    const Vec3i size = lattice.size();
    std::string text = "NRRD0004\ntype: float\ndimension: 3\nspace dimension: 3\n";
    text += fmt::format("sizes: {} {} {}\nspace directions:", size.x, size.y, size.z);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d along = lattice.grid.axes()[static_cast<std::size_t>(axis)] * step[axis];
        text += fmt::format(" ({},{},{})", along.x, along.y, along.z);
    }
    text += fmt::format("\nspace origin: ({},{},{})\nspace units: \"m\" \"m\" \"m\"\nkinds: domain domain domain\n",
                        origin.x, origin.y, origin.z);
    text += fmt::format("content: {}\nsample units: {}\nendian: little\nencoding: raw\n", head.name, head.unit);
    text += fmt::format("svt_time:={}\nsvt_medium:={}\n\n", head.times[lattice.time], head.medium);
    SVT_DO(file.write(text));
    return writeValues(lattice, file);
}

struct LatticeFormat {
    std::string_view ending;
    bool holdsUnevenSteps, holdsRotation, holdsVectors;
    Result<void> (*write)(const Lattice& lattice, AtomicFile& file);
};
constexpr LatticeFormat kLatticeFormats[] = {{".vti", false, true, true, writeVti},
                                             {".vtr", true, false, true, writeVtr},
                                             {".nrrd", false, true, false, writeNrrd}};

// Why a format cannot hold the field; empty if it can.
std::string reasonAgainst(const LatticeFormat& format, const Lattice& lattice) {
    if (!format.holdsUnevenSteps && !lattice.isRegular())
        return "the steps of the lattice are uneven; write a .vtr or a .csv";
    if (!format.holdsRotation && !isAlongWorldAxes(lattice.grid))
        return lattice.isRegular() ? "the grid is rotated; write a .vti" : "the grid is rotated; write a .csv";
    if (!format.holdsVectors && lattice.field.head.components > 1) return "the field is a vector; write a .vti";
    return {};
}

}  // namespace

Result<std::uint64_t> writeLattice(const Field& field, const Grid& grid, std::size_t time,
                                   const std::filesystem::path& path) {
    const Lattice lattice{field, grid, time};
    const std::string ending = lowerAscii(path.extension().string());
    for (const LatticeFormat& format : kLatticeFormats) {
        if (format.ending != ending) continue;
        if (std::string reason = reasonAgainst(format, lattice); !reason.empty())
            return Error(Code::BadArgument,
                         fmt::format("{} cannot hold the field '{}': {}", ending, field.head.name, reason),
                         {path.string(), 0, 0, {}});
        SVT_TRY(file, AtomicFile::create(path));
        SVT_DO(format.write(lattice, *file));
        return file->commit();
    }
    return Error(Code::BadArgument, fmt::format("'{}' is not a format of fields; write .vti, .vtr or .nrrd", ending),
                 {path.string(), 0, 0, {}});
}

}  // namespace svt::field_writers
