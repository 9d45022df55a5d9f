#include <svt/readers/textures/ifc_textures.hpp>

#include <svt/core/text.hpp>
#include <svt/image/png.hpp>
#include <svt/readers/textures/texture_colors.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace svt::readers::textures {
namespace {

using ifc::Fields;
using ifc::RecordIndex;
using ifc::Value;
using std::string_view;
namespace at = ifc::at;

constexpr std::int64_t kMaxPixelTexture = 1 << 22;  // pixels within the file
constexpr std::size_t kMaxBlob = std::size_t{64} << 20;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

// The bytes of a value of type BINARY: "0FF00" is the number of unused bits, then hexadecimal digits.
std::vector<std::byte> binaryOf(Value value) {
    string_view text = value.inner().text();
    std::vector<std::byte> bytes;
    if (text.size() < 3 || text.size() / 2 > kMaxBlob || text.front() != '"' || text.back() != '"') return bytes;
    text = text.substr(2, text.size() - 3);
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        const int high = hexDigit(text[i]), low = hexDigit(text[i + 1]);
        if (high < 0 || low < 0) return {};
        bytes.push_back(static_cast<std::byte>(high * 16 + low));
    }
    return bytes;
}

class IfcTextures {
public:
    explicit IfcTextures(const ifc::IfcFile& file)
        : file_(file), isIfc2x3_(lowerAscii(file.step().schema()).starts_with("ifc2x")) {}

    // The number of the use of a style; -1: it has no texture.
    std::int64_t addStyle(RecordIndex style) {
        for (const RecordIndex texture : file_.followAll(style, at::SurfaceStyleWithTextures::Textures)) {
            if (const auto known = useOf_.find(texture); known != useOf_.end())
                return static_cast<std::int64_t>(known->second);
            TextureImage image = imageOf(texture);
            if (image.file.empty() && image.content.empty()) continue;
            const Fields fields = file_.fieldsOf(texture);
            const bool repeats = fields[at::SurfaceTexture::RepeatS].enumeration() != "F" ||
                                 fields[at::SurfaceTexture::RepeatT].enumeration() != "F";
            const auto number = static_cast<std::uint32_t>(set.images.size());
            set.images.push_back(std::move(image));
            useOf_.emplace(texture, set.uses.size());
            set.uses.push_back({number, repeats ? Wrap::Repeat : Wrap::Clamp, true, {}, {}});
            return static_cast<std::int64_t>(set.uses.size()) - 1;
        }
        return -1;
    }

    // Adds the texture coordinates of all maps in the file to the uses.
    void addMaps() {
        if (useOf_.empty()) return;
        for (RecordIndex i = 0; i < file_.step().records().size(); ++i) {
            const std::string type = lowerAscii(file_.typeName(i));
            if (!type.ends_with("texturemap")) continue;
            for (const RecordIndex texture : file_.followAll(i, at::TextureCoordinate::Maps))
                if (const auto use = useOf_.find(texture); use != useOf_.end()) addMap(i, type, set.uses[use->second]);
        }
    }

    TextureSet set;

private:
    TextureImage imageOf(RecordIndex texture) const {
        const std::string type = lowerAscii(file_.typeName(texture));
        const Fields fields = file_.fieldsOf(texture);
        const auto field = [&](ifc::AttributePosition now, ifc::AttributePosition before) {
            return fields[isIfc2x3_ ? before : now];
        };
        TextureImage image;
        if (type == "ifcimagetexture") {
            image.file =
                field(at::ImageTexture::URLReference, at::ImageTextureOfIfc2x3::UrlReference).string().value_or("");
        } else if (type == "ifcblobtexture") {
            image.file = "IfcBlobTexture";
            image.content = binaryOf(field(at::BlobTexture::RasterCode, at::BlobTextureOfIfc2x3::RasterCode));
        } else if (type == "ifcpixeltexture") {
            image.file = "IfcPixelTexture";
            const std::int64_t width =
                field(at::PixelTexture::Width, at::PixelTextureOfIfc2x3::Width).integer().value_or(0);
            const std::int64_t height =
                field(at::PixelTexture::Height, at::PixelTextureOfIfc2x3::Height).integer().value_or(0);
            image.content = pngOf(width, height, field(at::PixelTexture::Pixel, at::PixelTextureOfIfc2x3::Pixel));
        }
        return image;
    }

    // The pixels of an IfcPixelTexture: 1 to 4 bytes each, from the lower left on.
    static std::vector<std::byte> pngOf(std::int64_t width, std::int64_t height, Value list) {
        if (width < 1 || height < 1 || width > image::kMaxPngSize || height > image::kMaxPngSize ||
            width * height > kMaxPixelTexture)
            return {};
        image::Image<image::Rgba8> pixels(static_cast<std::int32_t>(width), static_cast<std::int32_t>(height));
        step::ValueCursor cursor(list);
        Value value;
        for (std::int32_t y = pixels.height() - 1; y >= 0; --y)
            for (std::int32_t x = 0; x < pixels.width(); ++x) {
                if (!cursor.next(value)) return {};
                const std::vector<std::byte> bytes = binaryOf(value);
                if (bytes.empty() || bytes.size() > 4) return {};
                const auto channel = [&](std::size_t i) { return std::to_integer<std::uint8_t>(bytes[i]); };
                const std::size_t green = bytes.size() < 3 ? 0 : 1, blue = bytes.size() < 3 ? 0 : 2;
                const bool hasAlpha = bytes.size() % 2 == 0;
                pixels.at(x, y) = {channel(0), channel(green), channel(blue),
                                   hasAlpha ? channel(bytes.size() - 1) : std::uint8_t{255}};
            }
        auto png = image::encodePng(pixels);
        return png ? std::move(*png) : std::vector<std::byte>();
    }

    void addMap(RecordIndex map, string_view type, TextureUse& use) {
        if (type == "ifctexturemap") {
            std::vector<TexturePoint> ring;
            for (const RecordIndex vertex : file_.followAll(map, at::TextureMap::Vertices))
                addPoint(file_.fieldsOf(vertex)[at::TextureVertex::Coordinates], ring);
            return addRing(ring, use);
        }
        const Fields fields = file_.fieldsOf(map);
        std::vector<TexturePoint> vertices;
        const RecordIndex list = file_.follow(fields[at::IndexedTextureMap::TexCoords]);
        step::ValueCursor points(file_.fieldsOf(list)[at::TextureVertexList::TexCoordsList]);
        for (Value point; points.next(point) && file_.guard().takeElements(1);) addPoint(point, vertices);
        if (type == "ifcindexedtriangletexturemap") {
            step::ValueCursor triangles(fields[at::IndexedTriangleTextureMap::TexCoordIndex]);
            for (Value triangle; triangles.next(triangle);) addRing(ringOf(triangle, vertices), use);
        } else if (type == "ifcindexedpolygonaltexturemap") {
            for (const RecordIndex face : file_.followAll(fields[at::IndexedPolygonalTextureMap::TexCoordIndices]))
                addRing(ringOf(file_.fieldsOf(face)[at::TextureCoordinateIndices::TexCoordIndex], vertices), use);
        }
    }

    static void addPoint(Value pair, std::vector<TexturePoint>& points) {
        const std::vector<Value> values = step::itemsOf(pair);
        if (values.size() < 2) return;
        points.push_back({values[0].number().value_or(0), values[1].number().value_or(0)});
    }

    // The points of a list of numbers that begin with 1; empty if one does not exist.
    static std::vector<TexturePoint> ringOf(Value list, const std::vector<TexturePoint>& vertices) {
        std::vector<TexturePoint> ring;
        step::ValueCursor numbers(list);
        for (Value number; numbers.next(number);) {
            const std::int64_t index = number.integer().value_or(0);
            if (index < 1 || static_cast<std::size_t>(index) > vertices.size()) return {};
            ring.push_back(vertices[static_cast<std::size_t>(index) - 1]);
        }
        return ring;
    }

    void addRing(const std::vector<TexturePoint>& ring, TextureUse& use) {
        if (ring.size() < 3 || !file_.guard().takeElements(ring.size())) return;
        use.points.insert(use.points.end(), ring.begin(), ring.end());
        use.ringEnds.push_back(static_cast<std::uint32_t>(use.points.size()));
    }

    const ifc::IfcFile& file_;
    bool isIfc2x3_;
    std::unordered_map<RecordIndex, std::size_t> useOf_;  // of each texture
};

}  // namespace

bool isTexturedStyle(const ifc::IfcFile& file, RecordIndex record) {
    return equalsIgnoringCase(file.typeName(record), "IfcSurfaceStyleWithTextures");
}

void colorTexturedStyles(const ifc::IfcFile& file, const std::vector<TexturedStyle>& styles,
                         std::vector<model::Material>& materials, string_view fileName, const ReadOptions& options,
                         Diagnostics& diagnostics) {
    if (styles.empty()) return;
    IfcTextures textures(file);
    std::vector<std::int64_t> useOfStyle;
    for (const TexturedStyle& style : styles) useOfStyle.push_back(textures.addStyle(style.style));
    textures.addMaps();
    const MeanColors means = meanColors(textures.set, options.imageFolder, options);
    reportImages(means, fileName, diagnostics);
    for (std::size_t s = 0; s < styles.size(); ++s) {
        model::Material& material = materials[styles[s].material];
        const auto mean = useOfStyle[s] < 0 ? std::nullopt : means.ofUses[static_cast<std::size_t>(useOfStyle[s])];
        material.hasColor = mean.has_value() || styles[s].hasGrey;
        if (mean) material.diffuse = roundedColor(*mean);
    }
}

}  // namespace svt::readers::textures
