#include <svt/readers/cityjson/cityjson_reader.hpp>

#include <svt/core/parallel.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/cityjson/cityjson_crs.hpp>
#include <svt/readers/cityjson/cityjson_geometry.hpp>
#include <svt/readers/cityjson/cityjson_link.hpp>
#include <svt/readers/cityjson/cityjson_objects.hpp>
#include <svt/readers/cityjson/cityjson_textures.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/textures/texture_colors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace svt::readers {
namespace {

using namespace cityjson;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kBatchBytes = std::size_t{8} << 20;
/// A few bytes of instance stand for a whole template, so the total expanded size is limited.
constexpr std::uint64_t kMaxInstancedBytes = std::uint64_t{1} << 28;

/// A JSON text never contains '}' and then '{' with only blanks between, so the end of the first line reveals a
/// sequence.
bool isSequence(std::string_view text) noexcept {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    const std::size_t lineEnd = begin == std::string_view::npos ? begin : text.find('\n', begin);
    if (lineEnd == std::string_view::npos) return false;
    const std::string_view line = withoutBlanks(text.substr(begin, lineEnd - begin));
    const std::size_t next = text.find_first_not_of(kBlanks, lineEnd);
    return line.ends_with('}') && next != std::string_view::npos && text[next] == '{';
}

/// The members of a CityJSON object or feature, collected in one pass.
struct RootMembers {
    std::optional<json::element> type, version, transform, cityObjects, vertices, metadata, appearance, templates;

    RootMembers(json::object root, const Place& place, Diagnostics& diagnostics) {
        for (const auto [key, value] : root) {
            std::optional<json::element>* member = find(key);
            if (member == nullptr) continue;
            if (*member)
                diagnostics.add(Severity::Warning, Code::DuplicateId,
                                fmt::format("a second member '{}'; the first counts", key), place);
            else
                *member = value;
        }
    }

private:
    std::optional<json::element>* find(std::string_view key) noexcept {
        if (key == "type") return &type;
        if (key == "version") return &version;
        if (key == "transform") return &transform;
        if (key == "CityObjects") return &cityObjects;
        if (key == "vertices") return &vertices;
        if (key == "metadata") return &metadata;
        if (key == "appearance") return &appearance;
        if (key == "geometry-templates") return &templates;
        return nullptr;
    }
};

/// v * scale + translate.
struct Transform {
    Vec3d scale{1, 1, 1}, translate{0, 0, 0};

    [[nodiscard]] Vec3d apply(Vec3d v) const noexcept {
        // No fused operation: the same two roundings for equal integers, so shared vertices have identical bits.
        return {v.x * scale.x + translate.x, v.y * scale.y + translate.y, v.z * scale.z + translate.z};
    }
};

std::optional<Vec3d> readVec3(const OptionalElement& value) {
    const auto array = asArray(value);
    if (!array) return std::nullopt;
    Vec3d result;
    int axis = 0;
    for (const json::element item : *array) {
        const auto number = asNumber(item);
        if (!number || axis == 3) return std::nullopt;
        result[axis++] = *number;
    }
    return axis == 3 ? std::optional(result) : std::nullopt;
}

/// A vertex that is not three numbers becomes NaN; surfaces that use it are reported and left out.
/// \param fractional  is increased by the number of vertices that are not integers
std::vector<Vec3d> readVertices(json::array array, const Transform& transform, std::atomic<std::uint64_t>& fractional) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec3d> vertices;
    vertices.reserve(array.size());
    for (const json::element item : array) {
        const auto v = readVec3(item);
        if (v && (std::trunc(v->x) != v->x || std::trunc(v->y) != v->y || std::trunc(v->z) != v->z)) ++fractional;
        vertices.push_back(v ? transform.apply(*v) : Vec3d{kNan, kNan, kNan});
    }
    return vertices;
}

std::vector<model::Material> readMaterials(const std::optional<json::element>& appearance) {
    std::vector<model::Material> materials;
    const auto array = asArray(findMember(asObject(appearance), "materials"));
    if (!array) return materials;
    const auto toUnit = [](double value) { return static_cast<float>(value >= 0 ? std::min(value, 1.0) : 0.0); };
    for (const json::element item : *array) {
        model::Material& material = materials.emplace_back();
        const auto object = asObject(item);
        if (!object) continue;
        if (const auto name = findMember(*object, "name")) material.name = asString(*name).value_or(std::string_view());
        if (const auto color = readVec3(findMember(*object, "diffuseColor")))
            material.diffuse = {toUnit(color->x), toUnit(color->y), toUnit(color->z)};
        if (const auto value = findMember(*object, "transparency"))
            material.transparency = toUnit(asNumber(*value).value_or(0));
    }
    return materials;
}

std::string_view readTheme(const std::optional<json::element>& appearance) {
    return asString(findMember(asObject(appearance), "default-theme-material")).value_or(std::string_view());
}

/// The objects of one line of a sequence.
struct ParsedLine {
    std::string_view text;
    std::uint64_t number = 0;  ///< 1-based
    std::vector<ParsedObject> objects;
    std::vector<model::Material> materials;  ///< of this line only
    TextureSource textures;                  ///< of this line only
    Diagnostics diagnostics;
};

class CityJsonReader {
public:
    CityJsonReader(std::string_view text, std::string_view name, const ReadOptions& options, Diagnostics& diagnostics)
        : text_(text), name_(name), options_(options), diagnostics_(diagnostics) {}

    Result<model::BuildingModel> read() {
        const bool hasLines = isSequence(text_);
        std::string_view head = text_;
        std::uint64_t headLine = 1;
        if (hasLines) {
            const std::size_t begin = text_.find_first_not_of(kBlanks);
            headLine += static_cast<std::uint64_t>(
                std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
            head = text_.substr(begin, text_.find('\n', begin) - begin);
            rest_ = text_.substr(begin + head.size());
        }
        SVT_DO(readHead(head, headLine, hasLines));
        if (hasLines) {
            SVT_DO(checkEnd(headLine));
            SVT_DO(readLines(headLine));
        }
        if (Progress::isCancelled(options_.progress)) return cancelled();
        if (isTransformGiven_ && fractionalVertices_ > 0)
            diagnostics_.add(Severity::Warning, Code::BadValue,
                             fmt::format("{} vertices are not integers, which 'transform' requires; it is applied to "
                                         "them as they are",
                                         fractionalVertices_.load()),
                             place(0));
        SVT_DO(linkObjects(std::move(objects_), name_, model_, anchors_, diagnostics_));
        if constexpr (textures::kReadsTextures)
            SVT_DO(textures::colorTextured(model_, textures_, name_, options_, diagnostics_));
        SVT_DO(settleCrs(model_, name_, anchors_, options_, diagnostics_));
        Progress::tell(options_.progress, "read", 1);
        return std::move(model_);
    }

private:
    [[nodiscard]] Place place(std::uint64_t line) const { return {std::string(name_), line, 0, {}}; }
    [[nodiscard]] Error tooManyInstances() const {
        return Error(
            Code::InputTooBig,
            fmt::format(
                "template geometries are used so often that they would take {} bytes of JSON; at most {} can be read",
                instancedBytes_.load(), kMaxInstancedBytes),
            place(0));
    }
    [[nodiscard]] Error cancelled() const { return Error(Code::Cancelled, "reading was cancelled", place(0)); }

    Result<void> readHead(std::string_view text, std::uint64_t line, bool hasLines) {
        const TextOrigin origin{name_, line};
        SVT_TRY(root, headText_.parse(text, origin, options_.maxDepth, diagnostics_));
        if (Progress::isCancelled(options_.progress)) return cancelled();
        Progress::tell(options_.progress, "read", hasLines ? 0 : 0.5);
        const auto object = asObject(*root);
        if (!object)
            return Error(Code::BadJson, "the text is not a JSON object; expected a CityJSON object", place(line));
        const RootMembers members(*object, place(0), diagnostics_);
        const auto type = asString(members.type);
        if (type == "CityJSONFeature")
            return Error(Code::BadJson,
                         "a CityJSONFeature without the CityJSON object that has its transform; "
                         "expected that object in the first line",
                         place(line));
        if (type != "CityJSON")
            return Error(
                Code::BadJson,
                fmt::format("the member 'type' is '{}', expected 'CityJSON'", type ? shortened(*type) : "(absent)"),
                place(line));
        SVT_DO(readVersion(members.version, hasLines));
        SVT_DO(readTransform(members.transform));
        readMetadata(members.metadata, model_, name_, diagnostics_);
        model_.source = name_;
        model_.materials = readMaterials(members.appearance);
        headMaterials_ = model_.materials.size();
        theme_ = readTheme(members.appearance);
        if constexpr (textures::kReadsTextures)
            if (!options_.imageFolder.empty()) {
                headTextures_ = cityjson::readTextures(members.appearance);
                textures_.images = headTextures_.images;
            }
        readTemplates(members.templates);

        const auto cityObjects = asObject(members.cityObjects);
        if (!cityObjects)
            return Error(Code::BadJson, "the member 'CityObjects' is absent or not a JSON object", place(line));
        const auto vertices = asArray(members.vertices);
        if (!vertices && !(hasLines && cityObjects->size() == 0))
            return Error(Code::BadJson, "the member 'vertices' is absent or not an array", place(line));
        std::vector<Vec3d> points;
        if (vertices) points = readVertices(*vertices, transform_, fractionalVertices_);
        return readObjects(*cityObjects, contextOf(origin, points));
    }

    [[nodiscard]] TextContext contextOf(const TextOrigin& origin, std::span<const Vec3d> vertices) {
        const TextureSource* const textures = options_.imageFolder.empty() ? nullptr : &headTextures_;
        return {origin, vertices, &templates_,       0,       headMaterials_, headMaterials_,
                theme_, textures, &model_.materials, nullptr, textures};
    }

    Result<void> readVersion(const std::optional<json::element>& value, bool hasLines) {
        std::string version;
        if (value) {
            if (const auto text = asString(*value))
                version = *text;
            else if (const auto number = asNumber(*value))
                version = fmt::format("{:.1f}", *number);
        }
        if (version.empty()) {
            diagnostics_.add(Severity::Warning, Code::UnknownVersion, "no 'version'; read as 2.0", place(0));
            version = "2.0";
        }
        const bool hasMajor = version.starts_with("1.") || version.starts_with("2.");
        if (!hasMajor)
            return Error(Code::UnknownVersion,
                         fmt::format("version '{}' cannot be read, only 1.x and 2.x; convert the file with "
                                     "cjio or citygml-tools first",
                                     shortened(version)),
                         place(0));
        const std::string_view main = std::string_view(version).substr(0, 3);
        if (main != "1.0" && main != "1.1" && main != "2.0")
            diagnostics_.add(Severity::Note, Code::UnknownVersion,
                             fmt::format("version '{}' is not known; read as {}", shortened(version),
                                         main[0] == '1' ? "1.1" : "2.0"),
                             place(0));
        model_.format = fmt::format("{} {}", hasLines ? "CityJSONSeq" : "CityJSON", shortened(version));
        isTransformOptional_ = main == "1.0";
        return {};
    }

    Result<void> readTransform(const std::optional<json::element>& value) {
        if (!value) {
            if (!isTransformOptional_)
                diagnostics_.add(Severity::Warning, Code::BadValue, "no 'transform'; vertices are taken as they are",
                                 place(0));
            return {};
        }
        const auto object = asObject(*value);
        const auto scale = readVec3(findMember(object, "scale")), translate = readVec3(findMember(object, "translate"));
        if (!scale || !translate || scale->x == 0 || scale->y == 0 || scale->z == 0)
            return Error(
                Code::BadValue,
                "'transform' needs a 'scale' of three numbers that are not 0 and a 'translate' of three numbers",
                place(0));
        transform_ = {*scale, *translate};
        isTransformGiven_ = true;
        return {};
    }

    void readTemplates(const std::optional<json::element>& value) {
        const auto object = asObject(value);
        if (!object) return;
        if (const auto array = asArray(findMember(*object, "templates")))
            for (const json::element geometry : *array) {
                templates_.geometries.push_back(geometry);
                // At least the size of a feature, so that empty templates count as well.
                templates_.textBytes.push_back(std::max<std::size_t>(64, simdjson::minify(geometry).size()));
            }
        std::atomic<std::uint64_t> fractionalOfTemplates{0};  // allowed
        if (const auto array = asArray(findMember(*object, "vertices-templates")))
            templates_.vertices = readVertices(*array, {}, fractionalOfTemplates);
    }

    Result<void> readObjects(json::object cityObjects, const TextContext& context) {
        std::vector<std::pair<std::string_view, json::element>> members;
        members.reserve(cityObjects.size());
        for (const auto [id, value] : cityObjects) members.emplace_back(id, value);
        for (const auto& [id, value] : members) instancedBytes_ += instancedBytes(value, templates_);
        if (instancedBytes_ > kMaxInstancedBytes) return tooManyInstances();
        objects_.resize(members.size());
        parallelFor(members.size(), 8, options_.threads, [&](std::size_t begin, std::size_t end) {
            if (Progress::isCancelled(options_.progress)) return;
            for (std::size_t i = begin; i < end; ++i)
                objects_[i] = readCityObject(members[i].first, members[i].second, context);
        });
        if (Progress::isCancelled(options_.progress)) return cancelled();
        for (ParsedObject& object : objects_) joinTextures(object, {});
        return {};
    }

    /// Appends the uses of an object to those of the model.
    /// \param imageOf  the numbers that the images of a line get; images of the header keep theirs
    void joinTextures([[maybe_unused]] ParsedObject& object,
                      [[maybe_unused]] const std::vector<std::uint32_t>& imageOf) {
        if constexpr (textures::kReadsTextures) {
            const std::size_t first = textures_.uses.size();
            if (first + object.textureUses.size() > textures::kMaxUses) object.textureUses.clear();
            for (model::Polygon& polygon : object.polygons) {
                if (!textures::isUse(polygon.material)) continue;
                const std::size_t use = textures::useOf(polygon.material);
                polygon.material =
                    use < object.textureUses.size() ? textures::materialOfUse(first + use) : std::int32_t{-1};
            }
            for (textures::TextureUse& use : object.textureUses) {
                if (use.image >= headTextures_.images.size())
                    use.image = imageOf[use.image - headTextures_.images.size()];
                textures_.uses.push_back(std::move(use));
            }
            object.textureUses = {};
        }
    }

    /// A sequence is cut off if its last line is; that line also lacks a line break.
    Result<void> checkEnd(std::uint64_t headLine) {
        const std::size_t begin = rest_.rfind('\n') + 1;
        if (!isCutOff(rest_.substr(begin))) return {};
        const auto before = static_cast<std::uint64_t>(
            std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
        const std::string found = "the last line ends within its object: the file was cut off";
        if (!options_.allowTruncated)
            return Error(Code::Truncated,
                         found + "; copy or export it again, or read it up to the cut (--allow-truncated)",
                         place(headLine + before));
        diagnostics_.add(Severity::Warning, Code::Truncated, found + "; it was read up to the cut",
                         place(headLine + before));
        return {};
    }

    /// Reads lines in batches of a fixed number of bytes; a batch is parsed in parallel and joined in order.
    Result<void> readLines(std::uint64_t headLine) {
        std::uint64_t number = headLine;
        std::size_t position = 0;
        while (position < rest_.size()) {
            std::vector<ParsedLine> batch;
            for (std::size_t bytes = 0; position < rest_.size() && bytes < kBatchBytes;) {
                const std::size_t end = std::min(rest_.find('\n', position), rest_.size());
                const std::string_view line = withoutBlanks(rest_.substr(position, end - position));
                if (!line.empty()) batch.push_back({line, number, {}, {}, {}, {}});
                bytes += line.size();
                position = end + 1;
                ++number;
            }
            parallelFor(batch.size(), 16, options_.threads, [&](std::size_t begin, std::size_t end) {
                if (Progress::isCancelled(options_.progress)) return;
                JsonText json;
                for (std::size_t i = begin; i < end; ++i) readLine(json, batch[i]);
            });
            if (Progress::isCancelled(options_.progress)) return cancelled();
            if (instancedBytes_ > kMaxInstancedBytes) return tooManyInstances();
            for (ParsedLine& line : batch) joinLine(line);
            Progress::tell(options_.progress, "read",
                           static_cast<double>(std::min(position, rest_.size())) / static_cast<double>(rest_.size()));
        }
        return {};
    }

    /// Runs in parallel with other lines: only reads the members of this reader, writes only to `line`.
    void readLine(JsonText& json, ParsedLine& line) {
        const TextOrigin origin{name_, line.number};
        const auto leaveOut = [&](std::string_view why) {
            line.diagnostics.add(Severity::Error, Code::BadJson, fmt::format("{}; the line is left out", why),
                                 place(line.number));
        };
        auto root = json.parse(line.text, origin, options_.maxDepth, line.diagnostics);
        if (!root) {
            line.diagnostics.add(Severity::Error, root.error().code(),
                                 fmt::format("{}; the line is left out", root.error().message()), root.error().where());
            return;
        }
        const auto object = asObject(*root);
        if (!object) return leaveOut("no JSON object");
        const RootMembers members(*object, place(line.number), line.diagnostics);
        const auto type = asString(members.type);
        if (type != "CityJSONFeature")
            return leaveOut(fmt::format("the member 'type' is '{}', expected 'CityJSONFeature'",
                                        type ? shortened(*type) : "(absent)"));
        const auto cityObjects = asObject(members.cityObjects);
        const auto vertices = asArray(members.vertices);
        if (!cityObjects || !vertices) return leaveOut("the object 'CityObjects' or the array 'vertices' is absent");
        // The sum over a batch decides, so that failure does not depend on the order of threads.
        for (const auto [id, value] : *cityObjects) instancedBytes_ += instancedBytes(value, templates_);
        if (instancedBytes_ > kMaxInstancedBytes) return;
        const std::vector<Vec3d> points = readVertices(*vertices, transform_, fractionalVertices_);
        TextContext context = contextOf(origin, points);
        line.materials = readMaterials(members.appearance);
        if (!line.materials.empty()) {
            // Numbered after those of the header here; joinLine() assigns the numbers of the model.
            context.materialBegin = headMaterials_;
            context.materialEnd = context.materialBegin + line.materials.size();
            context.ownMaterials = &line.materials;
        }
        if (const auto theme = readTheme(members.appearance); !theme.empty()) context.materialTheme = theme;
        if constexpr (textures::kReadsTextures)
            if (context.headTextures != nullptr && members.appearance) {
                line.textures = cityjson::readTextures(members.appearance);
                if (line.textures.theme.empty()) line.textures.theme = headTextures_.theme;
                if (!line.textures.images.empty()) context.ownTextures = &line.textures;
            }
        line.objects.reserve(cityObjects->size());
        for (const auto [id, value] : *cityObjects) line.objects.push_back(readCityObject(id, value, context));
    }

    void joinLine(ParsedLine& line) {
        diagnostics_.append(line.diagnostics);
        // Lines repeat the same few materials; the model stores each once.
        std::vector<std::int32_t> numberOf;
        for (model::Material& material : line.materials) {
            const auto next = static_cast<std::int32_t>(model_.materials.size());
            const auto [entry, isNew] =
                materialNumbers_.emplace(std::tuple(material.name, material.diffuse.x, material.diffuse.y,
                                                    material.diffuse.z, material.transparency),
                                         next);
            if (isNew) model_.materials.push_back(std::move(material));
            numberOf.push_back(entry->second);
        }
        std::vector<std::uint32_t> imageOf;
        if constexpr (textures::kReadsTextures)
            for (textures::TextureImage& image : line.textures.images) {
                const auto next = static_cast<std::uint32_t>(textures_.images.size());
                const auto [entry, isNew] = imageNumbers_.emplace(image.file, next);
                if (isNew) textures_.images.push_back(std::move(image));
                imageOf.push_back(entry->second);
            }
        const auto first = static_cast<std::int32_t>(headMaterials_);
        for (ParsedObject& object : line.objects) {
            for (model::Polygon& polygon : object.polygons)
                if (polygon.material >= first)
                    polygon.material = numberOf[static_cast<std::size_t>(polygon.material - first)];
            for (textures::TextureUse& use : object.textureUses)
                if (use.otherwise >= first) use.otherwise = numberOf[static_cast<std::size_t>(use.otherwise - first)];
            joinTextures(object, imageOf);
            objects_.push_back(std::move(object));
        }
    }

    std::string_view text_, rest_, name_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    JsonText headText_;  ///< owns the templates and the theme
    Transform transform_;
    bool isTransformOptional_ = false, isTransformGiven_ = false;
    TemplateSet templates_;
    std::atomic<std::uint64_t> instancedBytes_{0}, fractionalVertices_{0};
    std::string_view theme_;
    std::size_t headMaterials_ = 0;
    /// Key: name, colour and transparency of the materials of lines.
    std::map<std::tuple<std::string, float, float, float, float>, std::int32_t> materialNumbers_;
    TextureSource headTextures_;
    textures::TextureSet textures_;
    std::map<std::string, std::uint32_t> imageNumbers_;  ///< of lines, by file
    std::vector<ParsedObject> objects_;
    std::vector<Vec3d> anchors_;
    model::BuildingModel model_;
};

}  // namespace

bool looksLikeCityJson(std::span<const std::byte> head) noexcept {
    std::string_view text(reinterpret_cast<const char*>(head.data()), std::min<std::size_t>(head.size(), 4096));
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    text = withoutBlanks(text);
    if (!text.starts_with('{')) return false;
    for (const std::string_view word :
         {"\"CityJSON\"", "\"CityJSONFeature\"", "\"CityObjects\"", "\"geometry-templates\""})
        if (text.find(word) != std::string_view::npos) return true;
    return withoutBlanks(text.substr(1)).starts_with("\"vertices\"");
}

Result<model::BuildingModel> readCityJson(std::span<const std::byte> bytes, std::string_view name,
                                          const ReadOptions& options, Diagnostics* diagnostics) {
    Diagnostics ignored;
    if (bytes.size() > options.maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("the file has {} bytes, the limit is {}", bytes.size(), options.maxBytes),
                     {std::string(name), 0, 0, {}});
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return CityJsonReader(text, name, options, diagnostics != nullptr ? *diagnostics : ignored).read();
}

extern const Format kCityJson{.name = "cityjson",
                              .endings = ".json|.jsonl|.cityjson",
                              .holds = "CityJSON and CityJSONSeq",
                              .looksLike = looksLikeCityJson,
                              .read = readCityJson};

}  // namespace svt::readers
