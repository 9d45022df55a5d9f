#include <svt/render_gl/painter/volume_textures.hpp>

#include <svt/render_gl/painter/shared_constants.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::render_gl {
namespace {

using volume::BrickVolume;

using volume::SameLabelBox;

// Arrays are uploaded without conversion, so their layout in memory is that of the texels; see findStep() and
// voxelScalar() in ray.glsl.
static_assert(sizeof(SameLabelBox) == 16 && offsetof(SameLabelBox, min) == 0 && offsetof(SameLabelBox, max) == 6 &&
              offsetof(SameLabelBox, scalar) == 12);
using Coding = BrickVolume::BoxCoding;
static_assert(sizeof(Coding) == 8 * kCodeTexels && offsetof(Coding, cut) == 0 && offsetof(Coding, cutAxes) == 6 &&
              offsetof(Coding, plane) == 8 && offsetof(Coding, firstSideScalar) == 20);
using PaletteBrick = BrickVolume::PaletteBrick;
static_assert(sizeof(PaletteBrick) == 16 && offsetof(PaletteBrick, palette) == 0 &&
              offsetof(PaletteBrick, bitPlanes) == 4 && offsetof(PaletteBrick, bitPlaneCount) == 8 &&
              offsetof(PaletteBrick, paletteSize) == 12);
static_assert(sizeof(volume::Scalar) == 4);

// Planes as floats, for positions relative to `middle`.
std::vector<float> planesFrom(Vec3i middle, std::span<const volume::BrickPlane> planes) {
    std::vector<float> values;
    values.reserve(4 * planes.size());
    for (const volume::BrickPlane& plane : planes) {
        const Vec3d n = plane.normal;
        const double offset = plane.offset + n.x * middle.x + n.y * middle.y + n.z * middle.z;
        for (const double value : {n.x, n.y, n.z, offset}) values.push_back(static_cast<float>(value));
    }
    return values;
}

// Number of the palette brick of each brick; kNone if the brick has one scalar.
std::vector<std::uint32_t> patternsOf(const BrickVolume& volume) {
    std::vector<std::uint32_t> patterns;
    const Vec3i count = volume.brickCount();
    for (std::int32_t z = 0; z < count.z; ++z)
        for (std::int32_t y = 0; y < count.y; ++y)
            for (std::int32_t x = 0; x < count.x; ++x) {
                const BrickVolume::Entry entry = volume.entry(x, y, z);
                patterns.push_back(entry.isMixed() ? static_cast<std::uint32_t>(volume.paletteBrickNumber(entry))
                                                   : kNone);
            }
    return patterns;
}

}  // namespace

Result<VolumeTextures> VolumeTextures::make(const BrickVolume& volume, const GlLimits& limits) {
    const BrickVolume::Arrays arrays = volume.arrays();
    VolumeTextures made;
    made.dimension = volume.dimension();
    made.brickCount = volume.brickCount();
    made.middle = {made.dimension.x / 2, made.dimension.y / 2, made.dimension.z / 2};
    made.uniformBoxes = static_cast<std::uint32_t>(arrays.uniformBoxes);
    made.boxCount = static_cast<std::uint32_t>(arrays.boxes.size());
    // Shaders read a flat index, of 16 bits if they suffice.
    const std::vector<std::uint32_t> wide = volume.flatIndex();
    const bool isNarrow = arrays.boxes.size() + arrays.bricks.size() <= 65536;
    const std::vector<std::uint16_t> narrow =
        isNarrow ? std::vector<std::uint16_t>(wide.begin(), wide.end()) : std::vector<std::uint16_t>();
    made.hasVoxels = std::any_of(wide.begin(), wide.end(), [&](std::uint32_t value) { return value >= made.boxCount; });
    const std::vector<float> planes = planesFrom(made.middle, arrays.planes);

    const std::vector<std::uint32_t> patterns = made.hasVoxels ? patternsOf(volume) : std::vector<std::uint32_t>();

    clearGlErrors();
    struct Upload {
        Texture& texture;
        GLenum form;
        const void* data;
        std::size_t count, bytes;
    };
    const Upload uploads[]{
        {made.index, GLenum(isNarrow ? GL_R16UI : GL_R32UI),
         isNarrow ? static_cast<const void*>(narrow.data()) : wide.data(), wide.size(), isNarrow ? 2u : 4u},
        {made.boxes, GL_RGBA32UI, arrays.boxes.data(), arrays.boxes.size(), 16},
        {made.codes, GL_RG32UI, arrays.codes.data(), kCodeTexels * arrays.codes.size(), 8},
        {made.bricks, GL_RGBA32UI, arrays.bricks.data(), arrays.bricks.size(), 16},
        {made.palettes, GL_R32UI, arrays.palettes.data(), arrays.palettes.size(), 4},
        {made.words, GL_RG32UI, arrays.words.data(), arrays.words.size(), 8},
        {made.planes, GL_RGBA32UI, planes.data(), arrays.planes.size(), 16},
        {made.patterns, GL_R32UI, patterns.data(), patterns.size(), 4}};
    for (const Upload& upload : uploads) {
        SVT_DO(upload.texture.setArray(upload.form, upload.data, upload.count, limits));
        made.sizeBytes += upload.count * upload.bytes;
    }
    SVT_DO(checkGl("the bricks of the volume"));
    return made;
}

void VolumeTextures::setUniforms(Program& program) const {
    program.bind("brickIndex", index);
    program.bind("boxes", boxes);
    program.bind("codes", codes);
    program.bind("bricks", bricks);
    program.bind("palettes", palettes);
    program.bind("words", words);
    program.bind("planes", planes);
    program.bind("patterns", patterns);
    program.set("uniformBoxes", GLuint{uniformBoxes});
    program.set("boxCount", GLuint{boxCount});
    program.set("dimension", dimension);
    program.set("brickCount", brickCount);
    program.set("middle", middle);
}

}  // namespace svt::render_gl
