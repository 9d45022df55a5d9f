/// \file
/// Writes a volume for MagicaVoxel (.vox, version 150 with the scene graph), which voxel editors and game engines open.
///
/// One group per label with voxels, with its name or id. Its voxels are in models of up to 256 x 256 x 256, the
/// format's limit; a model is cropped to the voxels of the label. z is up. The root has the attributes `svt_spacing`
/// (size of a voxel, metres), `svt_origin` (world coordinates of the first sample) and `svt_crs` (their CRS). The
/// palette contains the colours of the labels with their opacity. If there are more than 255, it contains the most
/// frequent ones, and others are replaced by the nearest.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/dense.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

constexpr std::int32_t kMostVoxels = 256;  // of a model, along each axis
constexpr std::uint64_t kMostBytes = 0x7FFFFFFF;
constexpr std::size_t kColors = 255;

using VoxColor = std::array<std::uint8_t, 4>;

VoxColor voxColor(Vec3f color, float opacity) {
    VoxColor bytes{};
    const std::array<float, 4> channels{color.x, color.y, color.z, opacity};
    for (std::size_t c = 0; c < 4; ++c) bytes[c] = colorByte(channels[c]);
    return bytes;
}

/// Colours, and the number of each scalar's colour: 1 to 255.
struct VoxPalette {
    std::vector<VoxColor> colors;
    std::vector<std::uint8_t> numberOf;
};

VoxPalette paletteOf(const volume::SemanticVolume& volume) {
    const volume::LabelTable& table = volume.labels;
    const auto voxels = volume.columns.countVoxels(table.scalarCount());
    std::vector<VoxColor> colors(voxels.size());
    std::map<VoxColor, std::uint64_t> counts;
    for (const volume::Label& label : table.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) {
            colors[s] = voxColor(colorOf(table, label, s), label.opacity);
            if (voxels[s] > 0) counts[colors[s]] += voxels[s];
        }
    std::vector<std::pair<std::uint64_t, VoxColor>> byCount;
    for (const auto& [color, count] : counts) byCount.emplace_back(count, color);
    std::stable_sort(byCount.begin(), byCount.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    VoxPalette palette;
    for (std::size_t c = 0; c < std::min(kColors, byCount.size()); ++c) palette.colors.push_back(byCount[c].second);
    palette.numberOf.resize(voxels.size(), 1);
    const auto distance = [](VoxColor a, VoxColor b) {
        int sum = 0;
        for (std::size_t c = 0; c < 4; ++c) sum += (int(a[c]) - int(b[c])) * (int(a[c]) - int(b[c]));
        return sum;
    };
    std::map<VoxColor, std::uint8_t> numbers;
    for (const auto& counted : counts) {
        const VoxColor color = counted.first;
        const auto nearest =
            std::min_element(palette.colors.begin(), palette.colors.end(),
                             [&](VoxColor a, VoxColor b) { return distance(a, color) < distance(b, color); });
        numbers[color] = static_cast<std::uint8_t>(nearest - palette.colors.begin() + 1);
    }
    for (std::size_t s = 0; s < voxels.size(); ++s)
        if (voxels[s] > 0 && numbers.contains(colors[s])) palette.numberOf[s] = numbers[colors[s]];
    return palette;
}

std::string voxString(std::string_view text) {
    std::string bytes;
    appendBytes(bytes, static_cast<std::int32_t>(text.size()));
    return bytes += text;
}

using VoxDictionary = std::vector<std::pair<std::string, std::string>>;

std::string voxDictionary(const VoxDictionary& entries) {
    std::string bytes;
    appendBytes(bytes, static_cast<std::int32_t>(entries.size()));
    for (const auto& [key, value] : entries) bytes += voxString(key) + voxString(value);
    return bytes;
}

std::string voxChunk(std::string_view name, std::string_view content) {
    std::string bytes(name);
    appendAs<std::int32_t>(bytes, content.size(), 0);
    return bytes += content;
}

std::string transformChunk(std::int32_t node, const VoxDictionary& attributes, std::int32_t child,
                           const VoxDictionary& frame) {
    std::string content;
    appendBytes(content, node);
    content += voxDictionary(attributes);
    appendAs<std::int32_t>(content, child, -1, -1, 1);
    return voxChunk("nTRN", content + voxDictionary(frame));
}

std::string groupChunk(std::int32_t node, const std::vector<std::int32_t>& children) {
    std::string content;
    appendBytes(content, node);
    content += voxDictionary({});
    appendBytes(content, static_cast<std::int32_t>(children.size()));
    for (const std::int32_t child : children) appendBytes(content, child);
    return voxChunk("nGRP", content);
}

std::string shapeChunk(std::int32_t node, std::int32_t model) {
    std::string content;
    appendBytes(content, node);
    content += voxDictionary({});
    appendAs<std::int32_t>(content, 1, model);
    return voxChunk("nSHP", content + voxDictionary({}));
}

/// A model: voxels of one label in one box.
struct VoxModel {
    std::uint32_t label = 0;
    analyze::SampleBox box;
};

class VoxFile {
public:
    VoxFile(const volume::SemanticVolume& volume, const VolumeWriteOptions& options)
        : volume_(volume), options_(options), palette_(paletteOf(volume)) {}

    /// Finds the models, which gives the size of the file. \return nothing, or Cancelled
    Result<void> plan() {
        const auto boxes = analyze::labelBoxes(volume_.columns, volume_.labels);
        for (std::uint32_t l = 0; l < boxes.size(); ++l) {
            if (boxes[l].isEmpty()) continue;
            SVT_DO(checkNotStopped(options_.progress));
            planLabel(l, boxes[l]);
        }
        return {};
    }

    Result<void> write(AtomicFile& file) {
        const std::string end = graph() + paletteChunk();
        std::uint64_t children = end.size();
        for (const std::size_t voxels : counts_) children += modelBytes(voxels);
        if (children > kMostBytes)
            return Error(Code::BadArgument,
                         fmt::format("{} bytes are more than a .vox can hold; use --level or --select", children));
        PieceWriter out(file);
        out.text = "VOX ";
        appendBytes(out.text, std::int32_t{150});
        out.text += "MAIN";
        appendAs<std::int32_t>(out.text, 0, children);
        for (std::size_t m = 0; m < models_.size(); ++m) {
            SVT_DO(checkNotStopped(options_.progress));
            Progress::tell(options_.progress, "write", double(m) / double(models_.size()));
            out.text += modelChunks(models_[m]);
            SVT_DO(out.flush());
        }
        out.text += end;
        return out.flush(true);
    }

private:
    static std::uint64_t modelBytes(std::size_t voxels) { return 24 + 16 + 4 * std::uint64_t(voxels); }

    /// Calls visit(i, j, k, scalar) for the voxels of a label in a box.
    template <class Visit>
    void forEachVoxel(const VoxModel& model, const Visit& visit) {
        const volume::Label& label = volume_.labels.labels[model.label];
        const auto& [min, max] = model.box;
        const Vec3i size = max - min + Vec3i{1, 1, 1};
        samples_.resize(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
        volume::copyBox<std::uint32_t>(volume_.columns, {min.y, max.y + 1, min.z, max.z + 1, min.x, max.x + 1},
                                       samples_, options_.threads);
        std::size_t n = 0;
        for (std::int32_t k = 0; k < size.z; ++k)
            for (std::int32_t j = 0; j < size.y; ++j)
                for (std::int32_t i = 0; i < size.x; ++i, ++n)
                    if (samples_[n] - label.first < label.count) visit(i, j, k, samples_[n]);
    }

    void planLabel(std::uint32_t label, const analyze::SampleBox& box) {
        for (std::int32_t z = box.min.z; z <= box.max.z; z += kMostVoxels)
            for (std::int32_t y = box.min.y; y <= box.max.y; y += kMostVoxels)
                for (std::int32_t x = box.min.x; x <= box.max.x; x += kMostVoxels) {
                    VoxModel model{label, {{x, y, z}, {x, y, z}}};
                    for (int axis = 0; axis < 3; ++axis)
                        model.box.max[axis] = std::min(model.box.min[axis] + kMostVoxels - 1, box.max[axis]);
                    std::size_t voxels = 0;
                    analyze::SampleBox used;
                    forEachVoxel(model, [&](std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t) {
                        const Vec3i at = Vec3i{x, y, z} + Vec3i{i, j, k};
                        used.add({at, at});
                        ++voxels;
                    });
                    if (voxels == 0) continue;
                    models_.push_back({label, used});
                    counts_.push_back(voxels);
                }
    }

    std::string modelChunks(const VoxModel& model) {
        const Vec3i size = model.box.max - model.box.min + Vec3i{1, 1, 1};
        std::string sizes, voxels;
        appendBytes(sizes, size);
        appendBytes(voxels, std::int32_t{0});
        forEachVoxel(model, [&](std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t scalar) {
            for (const std::int32_t at : {i, j, k}) voxels += static_cast<char>(at);
            voxels += static_cast<char>(palette_.numberOf[scalar]);
        });
        const auto count = static_cast<std::int32_t>(voxels.size() / 4 - 1);
        std::memcpy(voxels.data(), &count, sizeof count);
        return voxChunk("SIZE", sizes) + voxChunk("XYZI", voxels);
    }

    /// Transform 0 with group 1, below it a transform and a group for each label, below that its models.
    [[nodiscard]] std::string graph() const {
        const Vec3d spacing = volume_.grid.spacing(), origin = volume_.grid.origin();
        std::string nodes = transformChunk(0,
                                           {{"_name", validText(volume_.modelName)},
                                            {"svt_spacing", fmt::format("{} {} {}", spacing.x, spacing.y, spacing.z)},
                                            {"svt_origin", fmt::format("{} {} {}", origin.x, origin.y, origin.z)},
                                            {"svt_crs", validText(volume_.crsName)}},
                                           1, {});
        std::int32_t next = 2;
        std::vector<std::int32_t> groups;
        std::string below;
        for (std::size_t m = 0; m < models_.size();) {
            const volume::Label& label = volume_.labels.labels[models_[m].label];
            const std::int32_t transform = next++, group = next++;
            groups.push_back(transform);
            std::vector<std::int32_t> shapes;
            std::string models;
            for (const std::uint32_t owner = models_[m].label; m < models_.size() && models_[m].label == owner; ++m) {
                const auto& [min, max] = models_[m].box;
                // A model is placed by its middle, rounded down.
                Vec3i middle = min;
                for (int axis = 0; axis < 3; ++axis) middle[axis] += (max[axis] - min[axis] + 1) / 2;
                const std::int32_t place = next++, shape = next++;
                shapes.push_back(place);
                models +=
                    transformChunk(place, {}, shape, {{"_t", fmt::format("{} {} {}", middle.x, middle.y, middle.z)}});
                models += shapeChunk(shape, static_cast<std::int32_t>(m));
            }
            below += transformChunk(transform,
                                    {{"_name", validText(shownName(label))},
                                     {"svt_id", validText(label.id)},
                                     {"svt_class", validText(label.className)}},
                                    group, {});
            below += groupChunk(group, shapes) + models;
        }
        return nodes + groupChunk(1, groups) + below;
    }

    [[nodiscard]] std::string paletteChunk() const {
        std::string content;
        for (const VoxColor& color : palette_.colors)
            for (const std::uint8_t byte : color) content += static_cast<char>(byte);
        content.resize(1024, '\0');
        return voxChunk("RGBA", content);
    }

    const volume::SemanticVolume& volume_;
    const VolumeWriteOptions& options_;
    VoxPalette palette_;
    std::vector<VoxModel> models_;
    std::vector<std::size_t> counts_;
    std::vector<std::uint32_t> samples_;
};

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: a box of 256 x 256 x 256 samples; the
/// voxels are unrolled twice.
/// \return bytes, or BadArgument for more voxels than VolumeWriteOptions::maxVoxels, NothingSelected if no label has
///         voxels, CannotWrite, DiskFull, Cancelled
Result<std::uint64_t> writeVox(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_DO(checkedSampleBits(volume));
    const auto counts = volume.columns.countVoxels(volume.labels.scalarCount());
    std::uint64_t voxels = 0;
    for (std::size_t s = 1; s < counts.size(); ++s) voxels += counts[s];
    if (voxels == 0) return Error(Code::NothingSelected, "the volume has no voxels");
    if (voxels > options.maxVoxels)
        return Error(Code::BadArgument,
                     fmt::format("{} voxels, and {} at most are to be written; use --level or --select, or give "
                                 "--max-voxels",
                                 voxels, options.maxVoxels));
    VoxFile vox(volume, options);
    SVT_DO(vox.plan());
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(vox.write(*file));
    return file->commit();
}

}  // namespace

extern const VolumeFormat kVox{.name = "vox",
                               .endings = ".vox",
                               .holds = "MagicaVoxel: voxels, a group for each label",
                               .readers = "MagicaVoxel, Blender, Goxel, Unity, Godot",
                               .content = FileContent::Vox,
                               .isDense = true,
                               .write = writeVox};

}  // namespace svt::writers
