#include <svt/volume/volume_json.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/zarr/zarr_metadata.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;

Json reversed(Vec3d v) { return Json::array({v.z, v.y, v.x}); }

Json multiscales(const volume::SemanticVolume& volume, std::span<const volume::Grid> levels) {
    Json axes = Json::array();
    for (const char* name : {"z", "y", "x"}) axes.push_back({{"name", name}, {"type", "space"}, {"unit", "meter"}});
    Json datasets = Json::array();
    const volume::Grid& whole = levels.front();
    for (std::size_t l = 0; l < levels.size(); ++l) {
        // The position in a rotated grid is along its axes, from its first sample.
        const Vec3d place = levels[l].isAxisParallel()
                                ? levels[l].origin()
                                : scaled(whole.indexFromWorld(levels[l].origin()), whole.spacing());
        Json scale{{"type", "scale"}, {"scale", reversed(levels[l].spacing())}};
        Json translation{{"type", "translation"}, {"translation", reversed(place)}};
        datasets.push_back(
            {{"path", std::to_string(l)}, {"coordinateTransformations", Json::array({scale, translation})}});
    }
    const std::string& name = shownName(volume);
    return Json{{"name", name}, {"type", "mode"}, {"axes", axes}, {"datasets", datasets}};
}

Json imageLabel(const volume::LabelTable& table) {
    Json colors = Json::array(), properties = Json::array();
    for (const volume::Label& label : table.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) {
            const Vec3f color = colorOf(table, label, s);
            colors.push_back(
                {{"label-value", s},
                 {"rgba", {colorByte(color.x), colorByte(color.y), colorByte(color.z), colorByte(label.opacity)}}});
            properties.push_back(
                {{"label-value", s}, {"gml:id", label.id}, {"class", label.className}, {"name", label.name}});
            if (label.parent != volume::kNoLabel) properties.back()["parent"] = table.labels[label.parent].id;
        }
    return Json{{"colors", colors}, {"properties", properties}};
}

/// Only ASCII, because zarr-python reads no other characters.
std::string dumped(const Json& json) { return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n"; }

}  // namespace

ZarrShape zarrShape(int version) noexcept { return version == 2 ? ZarrShape{64, 64} : ZarrShape{32, 128}; }

std::string zarrGroupJson(const volume::SemanticVolume& volume, std::span<const volume::Grid> levels, int version) {
    Json scales = multiscales(volume, levels), label = imageLabel(volume.labels);
    Json svt{{"svt.json", Json::parse(volume::writeHeaderJson(volume))},
             {"labels.json", Json::parse(volume::writeLabelsJson(volume.labels))},
             {"seal", volume::sealText(volume, volume.columns)}};
    if (version == 2) {
        scales["version"] = "0.4";
        label["version"] = "0.4";
        return dumped({{"multiscales", Json::array({scales})}, {"image-label", label}, {"svt", svt}});
    }
    Json ome{{"version", "0.5"}, {"multiscales", Json::array({scales})}, {"image-label", label}};
    return dumped({{"zarr_format", 3}, {"node_type", "group"}, {"attributes", {{"ome", ome}, {"svt", svt}}}});
}

std::string zarrArrayJson(const volume::Grid& grid, int bits, int version) {
    const Vec3i d = grid.dimension();
    const ZarrShape shape = zarrShape(version);
    const Json whole = Json::array({d.z, d.y, d.x}), file = Json::array({shape.file, shape.file, shape.file}),
               chunk = Json::array({shape.chunk, shape.chunk, shape.chunk});
    if (version == 2)
        return dumped({{"zarr_format", 2},
                       {"shape", whole},
                       {"chunks", chunk},
                       {"dtype", bits == 8 ? "|u1" : fmt::format("<u{}", bits / 8)},
                       {"compressor", {{"id", "zstd"}, {"level", 3}}},
                       {"fill_value", 0},
                       {"order", "C"},
                       {"filters", nullptr},
                       {"dimension_separator", "/"}});
    Json bytes{{"name", "bytes"}};
    if (bits > 8) bytes["configuration"] = {{"endian", "little"}};
    const Json zstd{{"name", "zstd"}, {"configuration", {{"level", 3}, {"checksum", false}}}};
    const Json index{{"name", "bytes"}, {"configuration", {{"endian", "little"}}}}, crc{{"name", "crc32c"}};
    const Json sharding{{"name", "sharding_indexed"},
                        {"configuration",
                         {{"chunk_shape", chunk},
                          {"codecs", Json::array({bytes, zstd})},
                          {"index_codecs", Json::array({index, crc})},
                          {"index_location", "end"}}}};
    return dumped({{"zarr_format", 3},
                   {"node_type", "array"},
                   {"shape", whole},
                   {"data_type", fmt::format("uint{}", bits)},
                   {"chunk_grid", {{"name", "regular"}, {"configuration", {{"chunk_shape", file}}}}},
                   {"chunk_key_encoding", {{"name", "default"}, {"configuration", {{"separator", "/"}}}}},
                   {"fill_value", 0},
                   {"codecs", Json::array({sharding})},
                   {"dimension_names", Json::array({"z", "y", "x"})},
                   {"attributes", Json::object()}});
}

}  // namespace svt::writers
