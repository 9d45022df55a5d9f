/// \file
/// Writes a volume with all its levels for VTK and ParaView: a multi-block file (.vtm) and beside it a .vti per level,
/// `<stem>.level0.vti` and so on, until 64 samples are the longest side.

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/dense/coarser_levels.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/vtk/vti_writer.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

/// Writes the levels first, then the file that names them; each all or nothing. Equal volumes give equal bytes.
/// \return bytes of all files, or WouldDestroy (something else beside it), CannotWrite, DiskFull, Cancelled;
///         BadArgument as checkedSampleBits()
Result<std::uint64_t> writeVtm(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_DO(checkedSampleBits(volume));
    SVT_TRY(coarser, coarserLevels(volume, options.threads));
    const std::vector<volume::SemanticVolume>& coarse = *coarser;
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<vtkMultiBlockDataSet>\n";
    std::vector<std::filesystem::path> files;
    for (std::size_t l = 0; l <= coarse.size(); ++l) {
        const std::string name = fmt::format("{}.level{}.vti", path.stem().string(), l);
        files.push_back(path.parent_path() / name);
        SVT_DO(checkSibling(files.back(), "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile"));
        text += fmt::format("<DataSet index=\"{}\" name=\"level {}\" file=\"{}\"/>\n", l, l, xmlAttribute(name));
    }
    text += "</vtkMultiBlockDataSet>\n</VTKFile>\n";
    std::uint64_t bytes = 0;
    for (std::size_t l = 0; l < files.size(); ++l) {
        auto written = writeVti(l == 0 ? volume : coarse[l - 1], files[l], options);
        if (!written) return written;
        bytes += *written;
    }
    auto written = writeFileAtomically(path, text);
    if (!written) return written;
    return bytes + *written;
}

}  // namespace

extern const VolumeFormat kVtm{.name = "vtm",
                               .endings = ".vtm",
                               .holds = "VTK multi-block data: all levels, each a .vti beside it",
                               .readers = "ParaView, VTK",
                               .content = FileContent::Vtk,
                               .isDense = true,
                               .write = writeVtm};

}  // namespace svt::writers
