#include <svt/core/text.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/volume_json.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

namespace svt::volume {
namespace {

using nlohmann::json;

/// Limit of the nesting depth. A table needs: object > labels > label > attributes > attribute > value.
constexpr int kMaxDepth = 16;
/// Limit of the count of values in one label or one other list element.
constexpr std::size_t kMaxElementValues = 1'000'000;

// ---------------------------------------------------------------------------------------------- writing

void appendFormat(std::string& out, const auto& value) { fmt::format_to(std::back_inserter(out), "{}", value); }

/// Appends the shortest text that reads back as the same value, with a '.' or exponent to mark it as real.
template <std::floating_point T>
void appendReal(std::string& out, T value) {
    const std::string text = fmt::format("{}", value);
    out += text;
    if (text.find_first_of(".e") == std::string::npos) out += ".0";
}

void appendUnicodeEscape(std::string& out, char32_t point) {
    const auto unit = [&](std::uint32_t value) { fmt::format_to(std::back_inserter(out), "\\u{:04x}", value); };
    if (point < 0x10000) return unit(point);
    unit(0xD800 + ((point - 0x10000) >> 10));
    unit(0xDC00 + ((point - 0x10000) & 0x3FF));
}

template <class T, class Append>
void appendList(std::string& out, const T& values, Append append) {
    out += '[';
    bool isFirst = true;
    for (const auto& value : values) {
        if (!isFirst) out += ',';
        isFirst = false;
        append(value);
    }
    out += ']';
}

template <std::floating_point T>
void appendVec(std::string& out, Vec3<T> v) {
    appendList(out, std::array<T, 3>{v.x, v.y, v.z}, [&](T value) { appendReal(out, value); });
}

void appendValue(std::string& out, const AttributeValue& value, JsonCharacters characters) {
    if (const auto* text = std::get_if<std::string>(&value)) return appendJsonString(out, *text, characters);
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return appendFormat(out, *integer);
    if (const auto* truth = std::get_if<bool>(&value)) {
        out += *truth ? "true" : "false";
        return;
    }
    const double real = std::get<double>(value);
    if (std::isfinite(real)) return appendReal(out, real);
    out += std::isnan(real) ? R"({"real":"nan"})" : real > 0 ? R"({"real":"inf"})" : R"({"real":"-inf"})";
}

// ---------------------------------------------------------------------------------------------- reading

/// Reads the members of one JSON object. Keeps the first error; values read after an error are meaningless.
class Members {
public:
    Members(const json& object, std::string where) : object_(object), where_(std::move(where)) {
        if (!object_.is_object()) fail("is not a JSON object");
    }

    [[nodiscard]] bool isGood() const noexcept { return !error_; }
    [[nodiscard]] Error error() const { return *error_; }
    void fail(std::string_view what) {
        if (!error_) error_ = badVolume(fmt::format("{} {}", where_, what));
    }

    [[nodiscard]] bool has(const char* key) const { return isGood() && object_.contains(key); }

    /// The member, or null and an error if it is missing.
    const json* find(const char* key) {
        if (error_) return nullptr;
        const auto found = object_.find(key);
        if (found == object_.end()) {
            fail(fmt::format("has no '{}'", key));
            return nullptr;
        }
        return &*found;
    }

    void read(const char* key, std::string& out) {
        const json* value = find(key);
        if (value == nullptr) return;
        if (!value->is_string()) return fail(fmt::format("has a '{}' that is not a string", key));
        out = value->get_ref<const std::string&>();
    }
    template <std::unsigned_integral T>
    void read(const char* key, T& out) {
        if (const json* value = find(key)) readUnsigned(*value, key, out);
    }
    template <std::floating_point T>
    void read(const char* key, T& out) {
        if (const json* value = find(key)) readReal(*value, key, out);
    }
    template <std::floating_point T>
    void read(const char* key, Vec3<T>& out) {
        if (const json* value = find(key)) readVec(*value, key, out);
    }

    template <std::unsigned_integral T>
    void readUnsigned(const json& value, const char* key, T& out) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<T>::max())
            return fail(
                fmt::format("has a '{}' that is not a whole number from 0 to {}", key, std::numeric_limits<T>::max()));
        out = static_cast<T>(value.get<std::uint64_t>());
    }
    template <std::floating_point T>
    void readReal(const json& value, const char* key, T& out) {
        if (!value.is_number()) return fail(fmt::format("has a '{}' that is not a number", key));
        const auto real = value.get<double>();
        if (!(std::abs(real) <= double{std::numeric_limits<T>::max()}))
            return fail(fmt::format("has a '{}' that is too large", key));
        out = static_cast<T>(real);
    }
    template <std::floating_point T>
    void readVec(const json& value, const char* key, Vec3<T>& out) {
        if (!value.is_array() || value.size() != 3)
            return fail(fmt::format("has a '{}' that is not a list of three", key));
        for (int axis = 0; axis < 3; ++axis) readReal(value[static_cast<std::size_t>(axis)], key, out[axis]);
    }

private:
    const json& object_;
    std::string where_;
    std::optional<Error> error_;
};

void readAttributeValue(Members& members, const json& value, AttributeValue& out) {
    if (value.is_string()) {
        out = value.get<std::string>();
    } else if (value.is_boolean()) {
        out = value.get<bool>();
    } else if (value.is_number_float()) {
        out = value.get<double>();
    } else if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX}) {
        members.fail("has an integer attribute beyond 64 bits");
    } else if (value.is_number_integer()) {
        out = value.get<std::int64_t>();
    } else if (value == json::object({{"real", "nan"}})) {
        out = std::numeric_limits<double>::quiet_NaN();
    } else if (value == json::object({{"real", "inf"}})) {
        out = std::numeric_limits<double>::infinity();
    } else if (value == json::object({{"real", "-inf"}})) {
        out = -std::numeric_limits<double>::infinity();
    } else {
        members.fail("has an attribute whose value is not a string, a number, true or false");
    }
}

void readAttributes(Members& members, const std::string& where, std::vector<Attribute>& out) {
    const json* list = members.find("attributes");
    if (list == nullptr) return;
    if (!list->is_array()) return members.fail("has 'attributes' that are not a list");
    out.reserve(list->size());
    for (const json& item : *list) {
        Members attribute(item, where + ": an attribute");
        Attribute& made = out.emplace_back();
        attribute.read("name", made.name);
        if (attribute.has("unit")) attribute.read("unit", made.unit);
        if (attribute.has("record")) attribute.read("record", made.record);
        if (const json* value = attribute.find("value")) readAttributeValue(attribute, *value, made.value);
        if (!attribute.isGood()) return members.fail(attribute.error().message());
    }
}

Result<Label> readLabel(const json& object, std::size_t number) {
    const std::string where = fmt::format("labels.json: label {}", number);
    Members members(object, where);
    Label label;
    members.read("id", label.id);
    members.read("class", label.className);
    members.read("name", label.name);
    if (const json* parent = members.find("parent"); parent != nullptr && !parent->is_null())
        members.readUnsigned(*parent, "parent", label.parent);
    members.read("subtreeEnd", label.subtreeEnd);
    members.read("first", label.first);
    members.read("count", label.count);
    members.read("voxels", label.voxels);
    members.read("volume", label.volume);
    if (members.has("area")) members.read("area", label.area);
    std::string filling;
    members.read("filling", filling);
    if (members.isGood() && !fillingFromName(filling, label.filling))
        members.fail(fmt::format("has the unknown filling '{}'", filling.substr(0, 40)));
    members.read("color", label.color);
    members.read("opacity", label.opacity);
    if (members.has("thinVoxels")) members.read("thinVoxels", label.thinVoxels);
    if (members.has("uncertainVoxels")) members.read("uncertainVoxels", label.uncertainVoxels);
    if (members.has("groups")) {
        const json& groups = *members.find("groups");
        if (!groups.is_array()) members.fail("has 'groups' that are not a list");
        for (const json& group : groups) members.readUnsigned(group, "groups", label.groups.emplace_back());
    }
    if (members.has("attributes")) readAttributes(members, where, label.attributes);
    if (!members.isGood()) return members.error();
    return label;
}

Result<Overlap> readOverlap(const json& list, std::size_t number) {
    Members members(json::object(), fmt::format("labels.json: overlap {}", number));
    Overlap overlap;
    if (!list.is_array() || list.size() != 4 || !list[3].is_boolean()) {
        members.fail("is not a list of two labels, voxels and true or false");
    } else {
        members.readUnsigned(list[0], "label", overlap.a);
        members.readUnsigned(list[1], "label", overlap.b);
        members.readUnsigned(list[2], "voxels", overlap.voxels);
        overlap.isNested = list[3].get<bool>();
    }
    if (!members.isGood()) return members.error();
    return overlap;
}

/// Thrown in the callback of the JSON parser and caught in readLabelsJson: the only way to stop this parser.
struct StopParsing {
    Error error;
};

/// Takes labels, overlaps and colours from the parser one by one, so that at most one of them exists as JSON.
class LabelsCollector {
public:
    bool operator()(int depth, json::parse_event_t event, json& value) {
        using Event = json::parse_event_t;
        if (depth > kMaxDepth)
            throw StopParsing{badVolume(fmt::format("labels.json: nested deeper than {}", kMaxDepth))};
        if (++valuesSinceElement_ > kMaxElementValues)
            throw StopParsing{Error(Code::InputTooBig,
                                    fmt::format("labels.json: more than {} values in one element", kMaxElementValues))};
        if (event == Event::key && depth == 1) {
            key_ = value.get<std::string>();
            return key_ == "labels" || key_ == "overlaps" || key_ == "phaseColors";
        }
        if (depth != 2 || (event != Event::object_end && event != Event::array_end && event != Event::value))
            return true;
        valuesSinceElement_ = 0;
        if (key_ == "labels") {
            table.labels.push_back(take(readLabel(value, table.labels.size())));
        } else if (key_ == "overlaps") {
            table.overlaps.push_back(take(readOverlap(value, table.overlaps.size())));
        } else if (key_ == "phaseColors") {
            Members members(json::object(), "labels.json: the list of colors");
            members.readVec(value, "phaseColors", table.phaseColors.emplace_back());
            if (!members.isGood()) throw StopParsing{members.error()};
        }
        return false;
    }

    LabelTable table;

private:
    template <class T>
    static T take(Result<T> result) {
        if (!result) throw StopParsing{result.error()};
        return std::move(*result);
    }

    std::string key_;
    std::size_t valuesSinceElement_ = 0;
};

Error parseError(std::string_view entry, const json::exception& exception) {
    const auto* syntax = dynamic_cast<const json::parse_error*>(&exception);
    return badVolume(syntax != nullptr ? fmt::format("{}: invalid JSON at byte {}", entry, syntax->byte)
                                       : fmt::format("{}: a number is out of range", entry));
}

Result<void> checkVersion(Members& members) {
    std::string format;
    std::string version;
    members.read("format", format);
    if (members.isGood() && format != "svt") members.fail("has a 'format' other than svt");
    members.read("version", version);
    unsigned major = 0;
    std::size_t digits = 0;
    while (digits < version.size() && digits < 6 && isDigit(version[digits]))
        major = major * 10 + static_cast<unsigned>(version[digits++] - '0');
    if (members.isGood() && (digits == 0 || digits >= version.size() || version[digits] != '.' || major == 0))
        members.fail("has a 'version' that is not like 1.0");
    if (!members.isGood()) return members.error();
    if (major > static_cast<unsigned>(kSvtMajorVersion))
        return Error(
            Code::VolumeVersion,
            fmt::format("the file has format version {}, this program reads {}.x; use a newer SVT or build the "
                        "volume again with this one",
                        version.substr(0, 20), kSvtMajorVersion));
    return {};
}

}  // namespace

void appendJsonString(std::string& out, std::string_view text, JsonCharacters characters) {
    out += '"';
    while (!text.empty()) {
        const std::size_t plain = plainLength(text, '"');
        out += text.substr(0, plain);
        text.remove_prefix(plain);
        if (text.empty()) break;
        const auto [code, size] = firstCharacter(text);
        const char32_t point = size == 0 ? 0xFFFD : code;
        if (point == '"' || point == '\\') {
            out += '\\';
            out += static_cast<char>(point);
        } else if (point == '\n') {
            out += "\\n";
        } else if (point < 0x20 || point == 0x7F || (characters == JsonCharacters::AsciiOnly && point > 0x7F)) {
            appendUnicodeEscape(out, point);
        } else if (size == 0) {
            out += "\xEF\xBF\xBD";
        } else {
            out += text.substr(0, size);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    out += '"';
}

void appendJsonLabel(std::string& out, const Label& label, JsonCharacters characters) {
    const auto text = [&](std::string_view key, std::string_view value) {
        out += key;
        appendJsonString(out, value, characters);
    };
    const auto number = [&](std::string_view key, std::uint64_t value) {
        out += key;
        appendFormat(out, value);
    };
    text(R"({"id":)", label.id);
    text(R"(,"class":)", label.className);
    text(R"(,"name":)", label.name);
    if (label.parent == kNoLabel)
        out += R"(,"parent":null)";
    else
        number(R"(,"parent":)", label.parent);
    number(R"(,"subtreeEnd":)", label.subtreeEnd);
    number(R"(,"first":)", label.first);
    number(R"(,"count":)", label.count);
    number(R"(,"voxels":)", label.voxels);
    out += R"(,"volume":)";
    appendReal(out, label.volume);
    if (label.area > 0) {
        out += R"(,"area":)";
        appendReal(out, label.area);
    }
    text(R"(,"filling":)", fillingName(label.filling));
    out += R"(,"color":)";
    appendVec(out, label.color);
    out += R"(,"opacity":)";
    appendReal(out, label.opacity);
    if (label.thinVoxels != 0) number(R"(,"thinVoxels":)", label.thinVoxels);
    if (label.uncertainVoxels != 0) number(R"(,"uncertainVoxels":)", label.uncertainVoxels);
    if (!label.groups.empty()) {
        out += R"(,"groups":)";
        appendList(out, label.groups, [&](std::uint32_t group) { appendFormat(out, group); });
    }
    if (!label.attributes.empty()) {
        out += R"(,"attributes":)";
        appendList(out, label.attributes, [&](const Attribute& attribute) {
            text(R"({"name":)", attribute.name);
            out += R"(,"value":)";
            appendValue(out, attribute.value, characters);
            if (!attribute.unit.empty()) text(R"(,"unit":)", attribute.unit);
            if (attribute.record != 0) number(R"(,"record":)", attribute.record);
            out += '}';
        });
    }
    out += '}';
}

std::string writeHeaderJson(const SemanticVolume& volume) {
    const Grid& grid = volume.grid;
    std::string out;
    const auto text = [&](std::string_view key, std::string_view value) {
        out += key;
        appendJsonString(out, value);
    };
    const auto vec = [&](std::string_view key, Vec3d value) {
        out += key;
        appendVec(out, value);
    };
    out += fmt::format("{{\n  \"format\": \"svt\",\n  \"version\": \"{}.{}\",\n  \"generator\": \"SVT\",\n",
                       kSvtMajorVersion, kSvtMinorVersion);
    out += fmt::format("  \"byteOrder\": \"little\",\n  \"tileSize\": {},\n", ColumnVolume::kTileSize);
    out += fmt::format("  \"scalarCount\": {},\n  \"scalarBits\": {},\n", volume.labels.scalarCount(),
                       volume.labels.scalarBits());
    out += fmt::format("  \"dimension\": [{},{},{}],\n", grid.dimension().x, grid.dimension().y, grid.dimension().z);
    vec("  \"spacing\": ", grid.spacing());
    vec(",\n  \"origin\": ", grid.origin());
    vec(",\n  \"axes\": [", grid.axes()[0]);
    vec(",", grid.axes()[1]);
    vec(",", grid.axes()[2]);
    text("],\n  \"crs\": ", volume.crsName);
    text(",\n  \"model\": ", volume.modelName);
    text(",\n  \"source\": ", volume.source);
    out += "\n}\n";
    return out;
}

std::string writeLabelsJson(const LabelTable& table) {
    std::string out;
    out.reserve(256 + table.labels.size() * 256);
    const auto list = [&](std::string_view key, const auto& values, auto append) {
        out += key;
        bool isFirst = true;
        for (const auto& value : values) {
            out += isFirst ? "\n" : ",\n";
            isFirst = false;
            append(value);
        }
        out += ']';
    };
    list(R"({"labels":[)", table.labels, [&](const Label& label) { appendJsonLabel(out, label); });
    list(",\n\"overlaps\":[", table.overlaps, [&](const Overlap& overlap) {
        out += fmt::format("[{},{},{},{}]", overlap.a, overlap.b, overlap.voxels, overlap.isNested);
    });
    list(",\n\"phaseColors\":[", table.phaseColors, [&](Vec3f color) { appendVec(out, color); });
    out += "}\n";
    return out;
}

Result<SvtHeader> readHeaderJson(std::string_view text) {
    if (text.size() > kMaxHeaderBytes)
        return Error(Code::InputTooBig,
                     fmt::format("svt.json has {} bytes, {} are possible", text.size(), kMaxHeaderBytes));
    json object;
    try {
        object = json::parse(text.begin(), text.end(), [](int depth, json::parse_event_t, json&) {
            if (depth > kMaxDepth)
                throw StopParsing{badVolume(fmt::format("svt.json: nested deeper than {}", kMaxDepth))};
            return true;
        });
    } catch (const json::exception& exception) {
        return parseError("svt.json", exception);
    } catch (const StopParsing& stop) {
        return stop.error;
    }
    Members members(object, "svt.json");
    SVT_DO(checkVersion(members));
    SvtHeader header;
    std::string byteOrder;
    std::uint32_t tileSize = 0;
    Vec3d dimension;
    Vec3d spacing;
    Vec3d origin;
    members.read("byteOrder", byteOrder);
    members.read("tileSize", tileSize);
    if (members.isGood() && (byteOrder != "little" || tileSize != static_cast<std::uint32_t>(ColumnVolume::kTileSize)))
        members.fail(fmt::format("must have little 'byteOrder' and a 'tileSize' of {}", ColumnVolume::kTileSize));
    members.read("scalarCount", header.scalarCount);
    members.read("dimension", dimension);
    members.read("spacing", spacing);
    members.read("origin", origin);
    members.read("crs", header.crsName);
    members.read("model", header.modelName);
    members.read("source", header.source);
    std::array<Vec3d, 3> axes;
    if (const json* list = members.find("axes")) {
        if (!list->is_array() || list->size() != 3) members.fail("has 'axes' that are not a list of three");
        for (std::size_t axis = 0; members.isGood() && axis < 3; ++axis)
            members.readVec((*list)[axis], "axes", axes[axis]);
    }
    Vec3i samples;
    for (int axis = 0; members.isGood() && axis < 3; ++axis) {
        if (!(dimension[axis] >= 2 && dimension[axis] <= Grid::kMaxDimension) ||
            dimension[axis] != std::floor(dimension[axis]))
            members.fail(fmt::format("has a 'dimension' outside 2 to {}", Grid::kMaxDimension));
        else
            samples[axis] = static_cast<std::int32_t>(dimension[axis]);
    }
    if (!members.isGood()) return members.error();
    auto grid = Grid::fromParts(samples, spacing, origin, axes);
    if (!grid) return badVolume("svt.json: " + grid.error().message());
    header.grid = *grid;
    return header;
}

Result<LabelTable> readLabelsJson(std::string_view text) {
    if (text.size() > kMaxLabelsBytes)
        return Error(Code::InputTooBig,
                     fmt::format("labels.json has {} bytes, {} are possible", text.size(), kMaxLabelsBytes));
    LabelsCollector collector;
    try {
        const json rest = json::parse(text.begin(), text.end(), std::ref(collector));
        if (!rest.is_object() || !rest.contains("labels")) return badVolume("labels.json has no list 'labels'");
        for (const json& list : rest)
            if (!list.is_array()) return badVolume("labels.json: 'labels', 'overlaps' and 'phaseColors' must be lists");
    } catch (const json::exception& exception) {
        return parseError("labels.json", exception);
    } catch (const StopParsing& stop) {
        return stop.error;
    }
    SVT_DO(checkLabels(collector.table));
    return std::move(collector.table);
}

Result<void> checkLabels(const LabelTable& table) {
    const std::size_t count = table.labels.size();
    const auto wrong = [&](std::size_t number, std::string_view what) {
        return badVolume(
            fmt::format("label {} of {} ('{}') {}", number, count, table.labels[number].id.substr(0, 80), what));
    };
    if (count >= kNoLabel) return badVolume("more labels than 32 bits can number");
    std::vector<std::uint32_t> ancestors;
    std::uint64_t scalarEnd = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const Label& label = table.labels[i];
        while (!ancestors.empty() && table.labels[ancestors.back()].subtreeEnd <= i) ancestors.pop_back();
        const std::uint32_t parent = ancestors.empty() ? kNoLabel : ancestors.back();
        if (label.parent != parent)
            return wrong(i,
                         "has a parent that does not contain it: parents must come first, with all that is below "
                         "them right behind");
        const std::size_t enclosingEnd = parent == kNoLabel ? count : table.labels[parent].subtreeEnd;
        if (label.subtreeEnd <= i || label.subtreeEnd > enclosingEnd)
            return wrong(i, fmt::format("has a subtree that ends at {}, {} to {} is possible", label.subtreeEnd, i + 1,
                                        enclosingEnd));
        ancestors.push_back(static_cast<std::uint32_t>(i));
        for (const std::uint32_t group : label.groups)
            if (group >= count) return wrong(i, fmt::format("is in group {}, which does not exist", group));
        const std::uint64_t end = std::uint64_t{label.first} + label.count;
        if (end > kMaxScalarCount)
            return wrong(i, fmt::format("has scalars up to {}, {} are possible", end, kMaxScalarCount));
        if (label.count > 0) {
            if (label.first < scalarEnd)
                return wrong(i, fmt::format("has scalars from {}, which are taken; {} is the first that is free",
                                            label.first, scalarEnd));
            scalarEnd = end;
        }
        const bool isFinite = std::isfinite(label.volume) && std::isfinite(label.area) &&
                              std::isfinite(label.opacity) && std::isfinite(label.color.x) &&
                              std::isfinite(label.color.y) && std::isfinite(label.color.z);
        if (!isFinite) return wrong(i, "has a volume, color or opacity that is not a finite number");
        if (fillingName(label.filling) == "none" && label.filling != Filling::None)
            return wrong(i, "has a filling that does not exist");
    }
    for (const Overlap& overlap : table.overlaps)
        if (overlap.a >= count || overlap.b >= count)
            return badVolume(fmt::format("an overlap names labels {} and {}, {} exist", overlap.a, overlap.b, count));
    if (!table.phaseColors.empty() && table.phaseColors.size() != table.scalarCount())
        return badVolume(
            fmt::format("{} phase colors found, {} or none expected", table.phaseColors.size(), table.scalarCount()));
    for (const Vec3f color : table.phaseColors)
        if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z))
            return badVolume("a phase color is not a finite number");
    return {};
}

}  // namespace svt::volume
