#pragma once
/// \file
/// The formats in which a volume can be written. One table is the source of `svt convert`, its help, shell completions
/// and the manual; one call writes any format.

#include <svt/core/diagnostics.hpp>
#include <svt/core/file_content.hpp>
#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/record/members.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/surface_source.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

/// The place of the samples in document formats (X3D, CityGML).
enum class TextureKind : std::uint8_t {
    Pixel,     ///< PixelTexture3D: numbers in the document
    Image,     ///< ImageTexture3D: an NRRD beside the document
    Composed,  ///< ComposedTexture3D: a folder of PNG slices beside the document
    Atlas      ///< only X3D: one PNG beside the document, colours without labels (ImageTextureAtlas of X3DOM)
};
constexpr auto namesOf(TextureKind) {
    using enum TextureKind;
    return std::to_array<Name<TextureKind>>(
        {{Pixel, "pixel"}, {Image, "image"}, {Composed, "composed"}, {Atlas, "atlas"}});
}

/// The components whose voxels are merged into boxes together.
enum class MergeBy : std::uint8_t { Label, Class, Material };
constexpr auto namesOf(MergeBy) {
    using enum MergeBy;
    return std::to_array<Name<MergeBy>>({{Label, "label"}, {Class, "class"}, {Material, "material"}});
}

/// Options of one format, declared beside its writer.
struct CityGmlWriteOptions {
    std::filesystem::path model;  ///< the model from which the volume was built; it is kept unchanged; empty: none
    int version = 0;              ///< 2 or 3; 0: version of the model, 3 without a model
};
struct ZarrWriteOptions {
    int version = 2;  ///< 2 (OME-NGFF 0.4) or 3 (0.5)
};
/// Options of neuroglancer.
struct PrecomputedWriteOptions {
    bool hasMeshes = false;  ///< also write the surface of each label
    bool isSharded = false;  ///< chunks in shards, many per file
};
/// Options of 3D Tiles.
struct TilesetWriteOptions {
    /// Latitude, longitude (degrees) and height over the ellipsoid (metres) of the lower corner; unset: by the CRS.
    std::optional<Vec3d> place;
    std::optional<double> lift;  ///< added to heights, metres; unset: nothing (see globeHeights())
    bool hasVoxels = false;      ///< voxels by the draft extensions instead of surfaces
    bool isCompressed = false;   ///< surfaces by EXT_meshopt_compression
    bool isPerBuilding = false;  ///< one feature for each building instead of each component
};
struct VdbWriteOptions {
    bool hasLevelSets = false;  ///< each class as signed distances instead of a fog volume
};
/// Options of FDS and of lists of boxes.
struct BoxWriteOptions {
    MergeBy mergeBy = MergeBy::Label;
    std::size_t maxBoxes = 1'000'000;  ///< more boxes are an error
    std::string holes, vents;          ///< FDS: queries for open components, and for those with vents on both sides
};
/// Options of OpenFOAM.
struct FoamWriteOptions {
    std::string air;                        ///< query for the rooms; empty: all
    std::vector<std::string> temperatures;  ///< of surfaces, "QUERY:CELSIUS"; later ones take precedence
};
record::Members<CityGmlWriteOptions> membersOf(const CityGmlWriteOptions*) noexcept;
record::Members<ZarrWriteOptions> membersOf(const ZarrWriteOptions*) noexcept;
record::Members<PrecomputedWriteOptions> membersOf(const PrecomputedWriteOptions*) noexcept;
record::Members<TilesetWriteOptions> membersOf(const TilesetWriteOptions*) noexcept;
record::Members<VdbWriteOptions> membersOf(const VdbWriteOptions*) noexcept;
record::Members<BoxWriteOptions> membersOf(const BoxWriteOptions*) noexcept;
record::Members<FoamWriteOptions> membersOf(const FoamWriteOptions*) noexcept;

struct VolumeWriteOptions {
    bool isCompressed = true;                  ///< dense formats with a choice: gzip or zlib; false: raw
    GlbFaces faces = GlbFaces::Planes;         ///< formats of triangles
    SurfaceSource from = SurfaceSource::Auto;  ///< glTF and 3D Tiles
    TextureKind texture = TextureKind::Pixel;
    /// The most samples as numbers in a document, and the most cells of a mesh.
    std::uint64_t maxVoxels = std::uint64_t{1} << 24;
    CityGmlWriteOptions cityGml;
    ZarrWriteOptions zarr;
    PrecomputedWriteOptions precomputed;
    TilesetWriteOptions tileset;
    VdbWriteOptions vdb;
    BoxWriteOptions boxes;
    FoamWriteOptions foam;
    Diagnostics* diagnostics = nullptr;  ///< receives what a writer assumed or left out
    int threads = 0;                     ///< maximum; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< stages by format
};

/// The labels that are written as triangles of the model. \param automatic  the choice of SurfaceSource::Auto
[[nodiscard]] constexpr MeshChoice meshChoice(const VolumeWriteOptions& options, MeshChoice automatic) noexcept {
    if (options.from == SurfaceSource::Voxels || options.faces == GlbFaces::Voxels) return MeshChoice::None;
    if (options.faces == GlbFaces::Meshes) return MeshChoice::All;
    return options.from == SurfaceSource::Meshes ? MeshChoice::Open : automatic;
}

/// The options that a user can set.
record::Members<VolumeWriteOptions> membersOf(const VolumeWriteOptions*) noexcept;

/// A format, declared beside its code.
struct VolumeFormat {
    std::string_view name;  ///< name in the option, such as "nrrd"; unique
    /// Endings of files, separated by "|": ".nii|.nii.gz". The longest match for a name decides its format.
    std::string_view endings;
    std::string_view holds;    ///< content, for the manual
    std::string_view readers;  ///< programs that read it
    FileContent content;       ///< kind of files that it may replace; Nothing: a folder
    bool isDense = false;      ///< every sample is written
    /// Writes a file, see writeVolume().
    Result<std::uint64_t> (*write)(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                   const VolumeWriteOptions& options);
};

/// All formats, in the order of the manual.
[[nodiscard]] std::span<const VolumeFormat> volumeFormats() noexcept;

/// The format by the ending of `path`, case-insensitive; null for an unknown ending.
[[nodiscard]] const VolumeFormat* volumeFormatOf(const std::filesystem::path& path);

/// Writes the volume in the format that the ending of the file name selects, all or nothing. Equal volumes give equal
/// bytes. Memory of dense formats: below 256 MB besides volume and label table, regardless of the dense size.
/// \return bytes written, or BadArgument (unknown format, or a volume that the format cannot store, with the reason),
///         CannotWrite, DiskFull, Cancelled, NothingSelected; more with writeGlb()
[[nodiscard]] Result<std::uint64_t> writeVolume(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                                const VolumeWriteOptions& options = {});

}  // namespace svt::writers
