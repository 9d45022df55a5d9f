#include <svt/core/machine.hpp>
#include <svt/volume_readers/formats/label_formats.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/table/label_tables.hpp>
#include <svt/volume_readers/zarr/zarr_folder.hpp>

#include <fmt/format.h>

#include <array>
#include <optional>

namespace svt::volume_readers {
namespace {

using namespace std::string_view_literals;

enum class LabelFormat : std::uint8_t { None, Nrrd, Vti, Nifti, GzipNifti, Tiff, Ade, ZarrZip };

LabelFormat formatOf(const SharedFile& file) {
    const std::string_view text = file->text();
    if (text.starts_with("NRRD000"sv)) return LabelFormat::Nrrd;
    if (text.starts_with("II*\0"sv) || text.starts_with("II+\0"sv) || text.starts_with("MM\0*"sv) ||
        text.starts_with("MM\0+"sv))
        return LabelFormat::Tiff;
    const auto isNifti = [](std::string_view head) {
        return head.size() >= 348 &&
               ((head.starts_with("\x5c\1\0\0"sv) && head.substr(344, 1) == "n") || head.starts_with("\x1c\2\0\0n"sv));
    };
    if (isNifti(text)) return LabelFormat::Nifti;
    if (text.starts_with("\x1f\x8b"sv)) {
        std::array<char, 348> head{};
        const ReadSamples read = gzipSamples(file, file->bytes(), Code::BadImage);
        const bool isRead = static_cast<bool>(read(std::as_writable_bytes(std::span(head))));
        return isRead && isNifti({head.data(), head.size()}) ? LabelFormat::GzipNifti : LabelFormat::None;
    }
    const std::string_view begin = text.substr(0, 4096);
    if (text.starts_with("PK\3\4"sv))
        for (const std::string_view name : {".zarray"sv, ".zgroup"sv, ".zattrs"sv, "zarr.json"sv})
            if (begin.find(name) != std::string_view::npos) return LabelFormat::ZarrZip;
    if (begin.find("<VTKFile") != std::string_view::npos) return LabelFormat::Vti;
    if (text.substr(0, 65536).find("CityModel") != std::string_view::npos &&
        findAdeTexture(text) != std::string_view::npos)
        return LabelFormat::Ade;
    return LabelFormat::None;
}

Result<LabelImage> openImage(const SharedFile& file, const std::filesystem::path& path) {
    switch (formatOf(file)) {
        case LabelFormat::Nrrd: return openNrrd(file);
        case LabelFormat::Vti: return openVti(file);
        case LabelFormat::Nifti: return openNifti(file, false);
        case LabelFormat::GzipNifti: return openNifti(file, true);
        case LabelFormat::Tiff: return openTiff(file);
        case LabelFormat::Ade: return openAde(file, path);
        case LabelFormat::ZarrZip:
            return Error(Code::BadImage, "the file is a ZIP archive of Zarr; unpack it, and give the folder");
        case LabelFormat::None: break;
    }
    return Error(
        Code::UnknownFormat,
        "the file is no label volume that can be read: NRRD, VTI, NIfTI, TIFF, a folder of Zarr, or CityGML with one");
}

}  // namespace

bool looksLikeLabelVolume(const std::filesystem::path& path) {
    if (looksLikeZarr(path)) return true;
    const auto file = LabelFile::open(path);
    return file && formatOf(*file) != LabelFormat::None;
}

Result<volume::SemanticVolume> readLabelVolume(const std::filesystem::path& path, const LabelReadOptions& options) {
    std::uint64_t maxBytes = options.maxBytes;
    if (maxBytes == 0) {
        const auto grant = memoryGrant();
        maxBytes = grant ? grant->bytes / 2 : std::uint64_t{1} << 30;
    }
    // Errors of a table or of a file beside the document tell their own place.
    const auto at = [&](const Error& error) {
        return error.where().file.empty() ? Error(error.code(), error.message(), Place{path.string(), 0, 0, {}})
                                          : error;
    };
    std::optional<UserTable> table;
    if (!options.labels.empty()) {
        SVT_TRY(read, readUserTable(options.labels));
        table = std::move(*read);
    }
    Code code = Code::BadImage;
    const auto opened = [&]() -> Result<LabelImage> {
        if (looksLikeZarr(path)) return openZarr(path, maxBytes);
        SVT_TRY(file, LabelFile::open(path));
        if ((*file)->text().starts_with("NRRD")) code = Code::BadNrrd;
        return openImage(*file, path);
    };
    const auto image = opened();
    if (!image) return at(image.error());
    const auto warn = [&](const std::string& message) {
        if (options.diagnostics != nullptr)
            options.diagnostics->add(Severity::Warning, code, message, Place{path.string(), 0, 0, {}});
    };
    for (const std::string& warning : image->warnings) warn(warning);
    auto columns = readColumns(*image, maxBytes, code, options.progress);
    if (!columns) return at(columns.error());
    auto volume = makeVolume(*image, std::move(*columns), table ? &*table : nullptr, path);
    if (!volume) return at(volume.error());
    for (const std::string& warning : volume->warnings) warn(warning);
    return std::move(volume->volume);
}

}  // namespace svt::volume_readers
