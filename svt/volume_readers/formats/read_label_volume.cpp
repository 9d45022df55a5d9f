#include <svt/core/machine.hpp>
#include <svt/volume_readers/formats/label_formats.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/table/label_tables.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace svt::volume_readers {

// Each is declared next to its reader.
extern const LabelFormat kNrrd, kTiff, kNifti, kVti, kAde, kZarr;

std::span<const LabelFormat> labelFormats() noexcept {
    static const LabelFormat kAll[] = {kNrrd, kTiff, kNifti, kVti, kAde, kZarr};
    return kAll;
}

namespace {

using namespace std::string_view_literals;

// An input that may be a label volume.
struct Candidate {
    SharedFile file;  // null for a folder
    const LabelFormat* format = nullptr;
    bool isZippedZarr = false;
};

bool isZippedZarr(const SharedFile& file) {
    if (file == nullptr) return false;
    const std::string head = file->head(4096);
    if (!head.starts_with("PK\3\4"sv)) return false;
    const auto names = {".zarray"sv, ".zgroup"sv, ".zattrs"sv, "zarr.json"sv};
    return std::ranges::any_of(names, [&](std::string_view name) { return head.find(name) != std::string_view::npos; });
}

Result<Candidate> candidateAt(const std::filesystem::path& path) {
    Candidate candidate;
    std::error_code ignored;
    const bool isFolder = std::filesystem::is_directory(path, ignored);
    if (!isFolder) {
        SVT_TRY(file, LabelFile::open(path));
        candidate.file = std::move(*file);
    }
    for (const LabelFormat& format : labelFormats())
        if (format.isFolder == isFolder && format.looksLike(candidate.file, path)) {
            candidate.format = &format;
            break;
        }
    candidate.isZippedZarr = isZippedZarr(candidate.file);
    return candidate;
}

Error unknownFormat(const Candidate& candidate) {
    if (candidate.isZippedZarr)
        return {Code::BadImage, "the file is a ZIP archive of Zarr; unpack it, and give the folder"};
    std::string known;
    for (const LabelFormat& format : labelFormats())
        known += fmt::format("{}{}", known.empty() ? "" : "; ", format.holds);
    return {Code::UnknownFormat,
            fmt::format("this is not a label volume of a known format. Readable formats: {}", known)};
}

}  // namespace

bool looksLikeLabelVolume(const std::filesystem::path& path) {
    const auto candidate = candidateAt(path);
    return candidate && (candidate->format != nullptr || candidate->isZippedZarr);
}

Result<volume::SemanticVolume> readLabelVolume(const std::filesystem::path& path, const LabelReadOptions& options) {
    std::uint64_t maxBytes = options.maxBytes;
    if (maxBytes == 0) {
        const auto grant = memoryGrant();
        maxBytes = grant ? grant->bytes / 2 : std::uint64_t{1} << 30;
    }
    // Errors of a table or of a file next to the document already have a place.
    const auto at = [&](const Error& error) {
        return error.where().file.empty() ? Error(error.code(), error.message(), Place{path.string(), 0, 0, {}})
                                          : error;
    };
    std::optional<UserTable> table;
    if (!options.labels.empty()) {
        SVT_TRY(read, readUserTable(options.labels));
        table = std::move(*read);
    }
    const auto candidate = candidateAt(path);
    if (!candidate) return at(candidate.error());
    if (candidate->format == nullptr) return at(unknownFormat(*candidate));
    const Code code = candidate->format->fault;
    const auto image = candidate->format->open(candidate->file, path, maxBytes);
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
