#include <svt/core/file.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/vtk/vti_writer.hpp>

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {
namespace {

constexpr std::uint64_t kVtkBlockBytes = std::uint64_t{1} << 20;

std::span<const std::byte> bytesOfNumbers(const std::vector<std::uint64_t>& numbers) {
    return std::as_bytes(std::span(numbers));
}

/// Field data in the order that they are added. VTK stores the text of a string as the numbers of its bytes, with 0
/// behind each string.
class VtkFieldData {
public:
    void strings(std::string_view name, const std::vector<std::string_view>& values) {
        begin("Array", "String", name, values.size(), 1);
        for (const std::string_view value : values) {
            for (const char c : value)
                if (c != '\0') fmt::format_to(std::back_inserter(text_), "{} ", static_cast<unsigned char>(c));
            text_ += "0 ";
        }
        text_ += "</Array>\n";
    }

    template <class T>
    void numbers(std::string_view name, std::string_view type, const std::vector<T>& values,
                 std::size_t components = 1) {
        begin("DataArray", type, name, values.size() / components, components);
        for (const T value : values) fmt::format_to(std::back_inserter(text_), "{} ", value);
        text_ += "</DataArray>\n";
    }

    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    void begin(std::string_view element, std::string_view type, std::string_view name, std::size_t tuples,
               std::size_t components) {
        text_ += fmt::format(R"(<{} type="{}" Name="{}")", element, type, name);
        if (components > 1) text_ += fmt::format(R"( NumberOfComponents="{}")", components);
        text_ += fmt::format(R"( NumberOfTuples="{}" format="ascii">)", tuples);
    }

    std::string text_;
};

std::string vtkFieldData(const volume::SemanticVolume& volume) {
    std::vector<std::string_view> ids, classes, names;
    std::vector<std::uint32_t> firsts, counts;
    std::vector<std::int64_t> parents;
    std::vector<float> colors;
    for (const volume::Label& label : volume.labels.labels) {
        ids.push_back(label.id);
        classes.push_back(label.className);
        names.push_back(label.name);
        firsts.push_back(label.first);
        counts.push_back(label.count);
        parents.push_back(label.parent == volume::kNoLabel ? -1 : std::int64_t{label.parent});
        colors.insert(colors.end(), {label.color.x, label.color.y, label.color.z});
    }
    VtkFieldData fields;
    fields.strings("label_id", ids);
    fields.strings("label_class", classes);
    fields.strings("label_name", names);
    fields.numbers("label_first", "UInt32", firsts);
    fields.numbers("label_count", "UInt32", counts);
    fields.numbers("label_parent", "Int64", parents);
    fields.numbers("label_color", "Float32", colors, 3);
    const std::string header = volume::writeHeaderJson(volume), labels = volume::writeLabelsJson(volume.labels),
                      seal = volume::sealText(volume, volume.columns);
    fields.strings("svt_header", {header});
    fields.strings("svt_labels", {labels});
    fields.strings("svt_seal", {seal});
    return fields.text();
}

std::string vtiBeginning(const volume::SemanticVolume& volume, int bits, bool isCompressed) {
    const volume::Grid& grid = volume.grid;
    const Vec3i dimension = grid.dimension();
    const Vec3d spacing = grid.spacing(), corner = lowerCorner(grid);
    const auto& [x, y, z] = grid.axes();
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", dimension.x, dimension.y, dimension.z);
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text += R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64")";
    text += isCompressed ? " compressor=\"vtkZLibDataCompressor\">\n" : ">\n";
    text += fmt::format(R"(<ImageData WholeExtent="{}" Origin="{} {} {}" Spacing="{} {} {}")", extent, corner.x,
                        corner.y, corner.z, spacing.x, spacing.y, spacing.z);
    text += fmt::format(" Direction=\"{} {} {} {} {} {} {} {} {}\">\n", x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
    text += "<FieldData>\n" + vtkFieldData(volume) + "</FieldData>\n";
    text += fmt::format("<Piece Extent=\"{}\">\n<PointData/>\n<CellData Scalars=\"label\">\n", extent);
    text += fmt::format(R"(<DataArray type="UInt{}" Name="label" format="appended" offset="0"/>)", bits);
    text += "\n</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
    return text;
}

Result<void> writeVtkRaw(const volume::SemanticVolume& volume, int bits, const StreamOptions& stream,
                         AtomicFile& file) {
    SVT_DO(file.write(bytesOfNumbers({sampleBytes(volume.grid.dimension(), bits)})));
    return streamSamples(volume.columns, bits, stream, [&](auto bytes) { return file.write(bytes); });
}

// Number of blocks, bytes of a whole one, bytes of the last one if it is not whole, bytes of each compressed.
Result<void> writeVtkZlib(const volume::SemanticVolume& volume, int bits, const StreamOptions& stream,
                          AtomicFile& file) {
    const std::uint64_t bytes = sampleBytes(volume.grid.dimension(), bits);
    ZlibBlocks blocks(volume.columns, bits, {bytes, kVtkBlockBytes}, stream);
    SVT_DO(blocks.compress());
    std::vector<std::uint64_t> head{blocks.sizes().size(), kVtkBlockBytes, bytes % kVtkBlockBytes};
    head.insert(head.end(), blocks.sizes().begin(), blocks.sizes().end());
    SVT_DO(file.write(bytesOfNumbers(head)));
    return blocks.write(file);
}

}  // namespace

Result<std::uint64_t> writeVti(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_TRY(bits, checkedSampleBits(volume));
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(file->write(vtiBeginning(volume, *bits, options.isCompressed)));
    const StreamOptions stream = writeStream(options);
    SVT_DO(options.isCompressed ? writeVtkZlib(volume, *bits, stream, *file)
                                : writeVtkRaw(volume, *bits, stream, *file));
    SVT_DO(file->write("\n</AppendedData>\n</VTKFile>\n"));
    return file->commit();
}

extern const VolumeFormat kVti{.name = "vti",
                               .endings = ".vti",
                               .holds = "VTK image data: a cell per voxel, the table of labels as field data",
                               .readers = "ParaView, VTK, PyVista",
                               .content = FileContent::Vtk,
                               .isDense = true,
                               .write = writeVti};

}  // namespace svt::writers
