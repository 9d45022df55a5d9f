/// \file
/// Writes a semantic volume into a CityGML document, as the paper defines it: a VolumeTexture in an Appearance, by an
/// application domain extension (docs/formats/citygml/svt-ade-2.0.xsd and -3.0.xsd).
///
/// The document is that of the model, byte for byte, with one appearance of the theme "SVT" in front of its last end
/// tag; CityGML 1.0 becomes 2.0, which differs only in its namespaces. Without a document, features are buildings and
/// generic objects without geometry. The texture has scalar type, dimension, spacing, envelope (from the first to the
/// last sample: `node`), and for each feature its gml:id with the range of scalars that it and all below it own. Its
/// metadata hold `svt.json` and `labels.json` of a `.svt`, so that the document can become the same volume again.

#include <svt/core/text.hpp>
#include <svt/record/record.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/ade/model_document.hpp>
#include <svt/writers/nrrd_writer.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

/// Scalars of a label and of all labels below it: the range that encloses those of its parts.
struct ScalarRange {
    volume::Scalar first = 0, last = 0;  // 0: none
};

std::vector<ScalarRange> subtreeRanges(const volume::LabelTable& table) {
    std::vector<ScalarRange> ranges(table.labels.size());
    for (std::size_t l = table.labels.size(); l-- > 0;) {
        const volume::Label& label = table.labels[l];
        const auto add = [&](ScalarRange range) {
            if (range.first == 0) return;
            ranges[l].first = ranges[l].first == 0 ? range.first : std::min(ranges[l].first, range.first);
            ranges[l].last = std::max(ranges[l].last, range.last);
        };
        if (label.count > 0) add({label.first, label.first + label.count - 1});
        for (std::size_t child = l + 1; child < label.subtreeEnd; child = table.labels[child].subtreeEnd)
            add(ranges[child]);
    }
    return ranges;
}

std::string targets(const volume::LabelTable& table, const ModelDocument& document, bool isPlain) {
    const auto ranges = subtreeRanges(table);
    const auto reference = [&](std::size_t number) {
        return referenceTo(isPlain ? gmlId(table.labels[number].id, number) : table.labels[number].id);
    };
    std::string text;
    for (std::size_t l = 0; l < table.labels.size(); ++l) {
        if (ranges[l].first == 0) continue;
        const std::string range =
            fmt::format("<svt:scalarRange>{} {}</svt:scalarRange>", ranges[l].first, ranges[l].last);
        const std::uint32_t parent = table.labels[l].parent;
        const std::string up =
            parent == volume::kNoLabel ? "" : fmt::format("<svt:parent>{}</svt:parent>", reference(parent));
        text += document.version() == CityGmlVersion::V2
                    ? fmt::format("<svt:target uri=\"{}\">{}{}</svt:target>\n", reference(l), range, up)
                    : fmt::format(
                          "<svt:volumeAssociation><svt:VolumeAssociation><svt:target>{}</svt:target>{}{}"
                          "</svt:VolumeAssociation></svt:volumeAssociation>\n",
                          reference(l), range, up);
    }
    return text;
}

std::string_view textureName(TextureKind kind) {
    return kind == TextureKind::Pixel   ? "PixelTexture3D"
           : kind == TextureKind::Image ? "ImageTexture3D"
                                        : "ComposedTexture3D";
}

/// The beginning of a texture: from the member of the model to the elements that all kinds of texture share.
std::string beginningOfTexture(const volume::SemanticVolume& volume, int bits, const ModelDocument& document,
                               TextureKind kind) {
    const volume::Grid& grid = volume.grid;
    const Vec3i dimension = grid.dimension();
    const Vec3d least = grid.origin(), most = grid.worldFromIndex(toDouble(dimension - Vec3i{1, 1, 1}));
    const bool isThird = document.version() == CityGmlVersion::V3;
    std::string text = fmt::format(
        "<{0}:appearanceMember xmlns:core=\"http://www.opengis.net/citygml/{1}\" "
        "xmlns:app=\"http://www.opengis.net/citygml/appearance/{1}\" xmlns:gml=\"http://www.opengis.net/gml{2}\" "
        "xmlns:svt=\"{3}\">",
        isThird ? "core" : "app", isThird ? "3.0" : "2.0", isThird ? "/3.2" : "", adeNamespace(document.version()));
    text += isThird ? "<app:Appearance gml:id=\"svt-appearance\"><app:theme>SVT</app:theme><app:adeOfAppearance>"
                      "<svt:AppearanceVolumeProperties><svt:volumeData>\n"
                    : "<app:Appearance><app:theme>SVT</app:theme><svt:volumeDataMember>\n";
    text += fmt::format("<svt:{} gml:id=\"svt-volume\">\n", textureName(kind));
    for (const std::string& data : {volume::sealText(volume, volume.columns), volume::writeHeaderJson(volume),
                                    volume::writeLabelsJson(volume.labels)})
        text +=
            fmt::format("<gml:metaDataProperty><gml:GenericMetaData>{}</gml:GenericMetaData></gml:metaDataProperty>\n",
                        xmlContent(data));
    const std::string crs = volume.crsName.empty() ? "" : fmt::format(" srsName=\"{}\"", xmlAttribute(volume.crsName));
    text += fmt::format("<svt:scalarType>uint{}</svt:scalarType>\n<svt:dimension>{} {} {}</svt:dimension>\n", bits,
                        dimension.x, dimension.y, dimension.z);
    text += fmt::format("<svt:spacing>{} {} {}</svt:spacing>\n", grid.spacing().x, grid.spacing().y, grid.spacing().z);
    text += fmt::format(
        "<svt:envelope{} srsDimension=\"3\"><gml:lowerCorner>{} {} {}</gml:lowerCorner>"
        "<gml:upperCorner>{} {} {}</gml:upperCorner></svt:envelope>\n",
        crs, least.x, least.y, least.z, most.x, most.y, most.z);
    return text + "<svt:sampleLocation>node</svt:sampleLocation>\n<svt:backgroundValue>0</svt:backgroundValue>\n";
}

std::string endOfTexture(const ModelDocument& document, TextureKind kind) {
    const std::string end = fmt::format("</svt:{}>\n", textureName(kind));
    return document.version() == CityGmlVersion::V2
               ? end + "</svt:volumeDataMember></app:Appearance></app:appearanceMember>\n"
               : end +
                     "</svt:volumeData></svt:AppearanceVolumeProperties></app:adeOfAppearance></app:Appearance>"
                     "</core:appearanceMember>\n";
}

/// Writes what stands beside the document; returns the elements that name it.
Result<std::string> writeBeside(const volume::SemanticVolume& volume, int bits, const std::filesystem::path& path,
                                const VolumeWriteOptions& options) {
    const std::string stem = stemOf(path);
    if (options.texture == TextureKind::Image) {
        const std::string name = stem + ".labels.nrrd";
        SVT_DO(checkSibling(path.parent_path() / name, "NRRD000"));
        const auto encoding = options.isCompressed ? NrrdEncoding::Gzip : NrrdEncoding::Raw;
        SVT_TRY(bytes,
                writeNrrd(volume, path.parent_path() / name, {encoding, options.threads, options.progress, false}));
        return fmt::format("<svt:imageURI>{}</svt:imageURI>\n<svt:mimeType>application/x-nrrd</svt:mimeType>\n",
                           referenceTo(name).substr(1));
    }
    SVT_TRY(files, writeSlices(volume, bits, SliceKind::Gray16, {}, path, writeStream(options)));
    std::string text;
    for (const std::string& file : *files) {
        const std::size_t slash = file.find('/');
        text += fmt::format("<svt:sliceURI>{}/{}</svt:sliceURI>\n", referenceTo(file.substr(0, slash)).substr(1),
                            file.substr(slash + 1));
    }
    return text + "<svt:mimeType>image/png</svt:mimeType>\n";
}

Result<void> writePixelImage(const volume::SemanticVolume& volume, int bits, const VolumeWriteOptions& options,
                             AtomicFile& file) {
    const Vec3i dimension = volume.grid.dimension();
    SVT_DO(file.write(fmt::format("<svt:image>1 {} {} {}", dimension.x, dimension.y, dimension.z)));
    SVT_DO(writePixelNumbers(volume, bits, {}, writeStream(options), file));
    return file.write("</svt:image>\n");
}

Result<ModelDocument> documentFor(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    if (options.cityGml.model.empty())
        return ModelDocument::plain(volume, options.cityGml.version == 2 ? CityGmlVersion::V2 : CityGmlVersion::V3);
    auto document = ModelDocument::open(options.cityGml.model);
    if (!document) return document;
    const int version = document->version() == CityGmlVersion::V2 ? 2 : 3;
    if (options.cityGml.version != 0 && options.cityGml.version != version)
        return Error(
            Code::BadArgument,
            fmt::format("--citygml {}.0: the model is CityGML {}.0, and it is kept as it is; leave --citygml out",
                        options.cityGml.version, version),
            Place{options.cityGml.model.string(), 0, 0, {}});
    return document;
}

/// Refuses a model that lacks all features of the volume. Reports those that it lacks, because their targets lead
/// nowhere.
Result<void> checkFeatures(const volume::LabelTable& table, const ModelDocument& document,
                           const VolumeWriteOptions& options) {
    const std::vector<std::string_view> ids = document.ids();
    std::size_t all = 0, missing = 0;
    const volume::Label* first = nullptr;
    for (const volume::Label& label : table.labels) {
        ++all;
        if (std::binary_search(ids.begin(), ids.end(), std::string_view(xmlAttribute(label.id)))) continue;
        ++missing;
        if (first == nullptr) first = &label;
    }
    if (missing == 0) return {};
    const Place place{options.cityGml.model.string(), 0, 0, {}};
    if (missing == all && !ids.empty())
        return Error(Code::BadArgument,
                     fmt::format("the model lacks all {} features of the volume, such as '{}'; give the model from "
                                 "which the volume was built, or leave --model out",
                                 all, first->id),
                     place);
    if (options.diagnostics != nullptr)
        options.diagnostics->add(Severity::Warning, Code::DanglingReference,
                                 fmt::format("the model has no gml:id for {} of the {} features of the volume, such as "
                                             "'{}'; their scalars refer to nothing",
                                             missing, all, first->id),
                                 place);
    return {};
}

/// Beside the document it writes `<stem>.labels.nrrd`, or `<stem>_slices/0000.png` and so on.
/// \return size of the document, bytes; or
///         - BadArgument    a rotated grid, which the extension cannot store; another version than the model's; a model
///                          that already has a volume or lacks all features; too many voxels.
///         - UnknownFormat  the model is not CityGML in UTF-8.
///         - CannotOpen, CannotWrite, DiskFull, WouldDestroy, Cancelled
Result<std::uint64_t> writeAde(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_TRY(bits, checkedSampleBits(volume));
    if (!volume.grid.isAxisParallel())
        return Error(
            Code::BadArgument,
            "the grid is turned, and the extension of CityGML has no place for its axes; build the volume with "
            "--axes world");
    if (options.texture == TextureKind::Atlas)
        return Error(
            Code::BadArgument,
            "an atlas of slices has no labels, and the extension of CityGML has no place for it; use --texture "
            "pixel, image or composed");
    if (options.texture == TextureKind::Pixel) SVT_DO(checkPixelCount(volume.grid.dimension(), options.maxVoxels));
    SVT_TRY(document, documentFor(volume, options));
    if (!options.cityGml.model.empty()) SVT_DO(checkFeatures(volume.labels, *document, options));
    std::string beside;
    if (options.texture != TextureKind::Pixel) {
        SVT_TRY(written, writeBeside(volume, *bits, path, options));
        beside = std::move(*written);
    }
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(document->writeBegin(*file));
    SVT_DO(file->write(beginningOfTexture(volume, *bits, *document, options.texture)));
    SVT_DO(file->write(targets(volume.labels, *document, options.cityGml.model.empty())));
    SVT_DO(options.texture == TextureKind::Pixel ? writePixelImage(volume, *bits, options, *file)
                                                 : file->write(beside));
    SVT_DO(file->write(endOfTexture(*document, options.texture)));
    SVT_DO(document->writeEnd(*file));
    return file->commit();
}

}  // namespace

record::Members<CityGmlWriteOptions> membersOf(const CityGmlWriteOptions*) noexcept {
    using All = CityGmlWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::model>(
            "model", "of an .ade.gml: the CityGML that the volume was built from, which is kept as it is",
            {.value = "FILE",
             .otherwise = "the input, where that is CityGML",
             .group = "Output",
             .option = "--model",
             .file = FileUse::OtherInput}),
        record::memberAs<record::NumberChoice, &All::version>("version", "of an .ade.gml: the version of CityGML",
                                                              {.choices = "2.0|3.0",
                                                               .otherwise = "that of the model; 3.0 without one",
                                                               .group = "Output",
                                                               .option = "--citygml"}),
    };
    return kMembers;
}

extern const VolumeFormat kAde{
    .name = "ade",
    .endings = ".ade.gml",
    .holds = "CityGML 2.0 or 3.0: the model with the volume in it, by an application domain extension",
    .readers = "svt build; any CityGML reader sees the model",
    .content = FileContent::CityGml,
    .isDense = true,
    .write = writeAde};

}  // namespace svt::writers
