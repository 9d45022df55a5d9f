#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/readers/format/ended_features.hpp>
#include <svt/readers/format/extrude_footprints.hpp>
#include <svt/readers/format/zip_member.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/xml/xml_names.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace svt::readers {

// Each is declared next to its reader.
extern const Format kCityGml, kCityJson, kIfc, kIndoorGml;

std::span<const Format> formats() noexcept {
    static const Format kAll[] = {kCityGml, kCityJson, kIfc, kIndoorGml};
    return kAll;
}

namespace {

using std::string_view;
using Bytes = std::span<const std::byte>;

constexpr std::size_t kHeadBytes = 1 << 20;

string_view asText(Bytes bytes) noexcept { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

bool isGzip(Bytes bytes) noexcept { return asText(bytes).starts_with("\x1F\x8B\x08"); }

// The maximum size of unpacked gzip data, and the message for larger ones.
struct UnpackLimit {
    std::uint64_t bytes;
    std::string message;
};

UnpackLimit unpackLimit(std::uint64_t packedBytes, std::uint64_t maxBytes) {
    // Models unpack to 5 to 50 times their size, the generated ones 20, deflate can do 1000.
    constexpr std::uint64_t kMaxRatio = 100, kFreeBytes = std::uint64_t{64} << 20;
    // The text stays in memory while the model is made.
    constexpr std::uint64_t kShare = 3;
    constexpr string_view kInstead =
        "unpack it (gunzip) and read the result, which takes less memory, or split the model";
    UnpackLimit limit{maxBytes, fmt::format("more than {} bytes after decompression, which is the limit", maxBytes)};
    if (const std::uint64_t byRatio = std::max(kFreeBytes, packedBytes * kMaxRatio); byRatio < limit.bytes)
        limit = {byRatio,
                 fmt::format("{} bytes of gzip data unpack to more than {}, {} times as much; models unpack to 5 "
                             "to 50 times. The file is damaged or made to fill the memory; if it is not, unpack "
                             "it (gunzip) and read the result",
                             packedBytes, bytesText(byRatio), byRatio / std::max<std::uint64_t>(packedBytes, 1))};
    if (const auto grant = memoryGrant(); grant && grant->bytes / kShare < limit.bytes)
        limit = {grant->bytes / kShare, fmt::format("the gzip data unpack to more than {}, a third of {}; {}",
                                                    bytesText(grant->bytes / kShare), grant->text, kInstead)};
    return limit;
}

// All members of a gzip file, concatenated.
Result<std::vector<std::byte>> decompressed(Bytes bytes, string_view name, std::uint64_t maxBytes) {
    const UnpackLimit limit = unpackLimit(bytes.size(), maxBytes);
    const auto fail = [&](Code code, std::string message) {
        return Error(code, std::move(message), {std::string(name), 0, 0, {}});
    };
    Inflated unpacked =
        inflateBytes(bytes, DeflateFormat::Gzip, std::max<std::uint64_t>(4 * bytes.size(), 1 << 16), limit.bytes);
    switch (unpacked.status) {
        case InflateStatus::Done:
            if (unpacked.taken == bytes.size()) return std::move(unpacked.bytes);
            return fail(Code::CannotOpen,
                        fmt::format("{} bytes stand behind the end of the gzip data, at byte {}; copy "
                                    "or download the file again",
                                    bytes.size() - unpacked.taken, unpacked.taken));
        case InflateStatus::TooLong: return fail(Code::InputTooBig, limit.message);
        case InflateStatus::CutShort:
            return fail(Code::CannotOpen, "the gzip data ends too early; the file seems to be cut off");
        case InflateStatus::Damaged: break;
    }
    return fail(Code::CannotOpen, fmt::format("damaged gzip data at byte {}", unpacked.taken));
}

// Other content that users often try: its description and the remedy.
struct KnownOther {
    string_view beginsWith;
    string_view isWhat;
};
constexpr KnownOther kOthers[] = {
    {"%PDF", "a PDF"},
    {"\x89PNG", "a PNG picture"},
    {"glTF", "a binary glTF, which has no semantics"},
    {"ply", "a PLY mesh, which has no semantics"},
    {"NRRD", "an NRRD volume"},
    {"\x1F\x8B", "gzip data within gzip data; decompress it first"},
    {"BZh", "a bzip2 file; decompress it first"},
    {"\xFD"
     "7zXZ",
     "an xz file; decompress it first"},
    {"\x28\xB5\x2F\xFD", "a zstd file; decompress it first"},
};
constexpr KnownOther kOtherRoots[] = {
    {"html", "an HTML page, perhaps an error page that was saved instead of the file"},
    {"kml", "KML"},
    {"ifcXML", "ifcXML; export it as IFC in the STEP format (.ifc)"},
    {"LandXML", "LandXML"},
    {"COLLADA", "COLLADA, which has no semantics"},
    {"X3D", "X3D, which has no semantics"},
};

std::string describeUnknown(string_view text) {
    if (text.empty()) return "the file is empty";
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const string_view trimmed = withoutBlanks(text.substr(0, 4096));
    if (trimmed.empty()) return "the file contains only blanks";
    for (const KnownOther& other : kOthers)
        if (trimmed.starts_with(other.beginsWith)) return fmt::format("this is {}", other.isWhat);
    if (lowerAscii(trimmed.substr(0, 14)) == "<!doctype html") return fmt::format("this is {}", kOtherRoots[0].isWhat);
    if (trimmed[0] == '<') {
        const xml::Prolog prolog = xml::readProlog(text);
        const string_view root = xml::splitName(prolog.rootName).localName;
        for (const KnownOther& other : kOtherRoots)
            if (lowerAscii(root) == lowerAscii(other.beginsWith)) return fmt::format("this is {}", other.isWhat);
        if (prolog.hasRoot) return fmt::format("this is XML with the root <{}>", prolog.rootName.substr(0, 60));
        return "this begins like XML, but has no root element";
    }
    if (trimmed[0] == '{' || trimmed[0] == '[') return "this is JSON, but not CityJSON";
    const bool isText = std::all_of(
        trimmed.begin(), trimmed.begin() + std::min<std::ptrdiff_t>(64, static_cast<std::ptrdiff_t>(trimmed.size())),
        [](char c) { return static_cast<unsigned char>(c) >= 0x20 || isBlank(c); });
    if (!isText) return "this is binary data of an unknown kind";
    return fmt::format("this is text of an unknown kind, it begins with '{}'",
                       trimmed.substr(0, std::min<std::size_t>(24, trimmed.find_first_of("\r\n"))));
}

Error unknownFormat(Bytes bytes, string_view name) {
    std::string known;
    for (const Format& format : formats()) known += fmt::format("{}{}", known.empty() ? "" : ", ", format.holds);
    return {Code::UnknownFormat,
            fmt::format("{}. Can be read: {}, also compressed with gzip", describeUnknown(asText(bytes)), known),
            {std::string(name), 0, 0, {}}};
}

Result<model::BuildingModel> readPlain(Bytes bytes, string_view name, const ReadOptions& options,
                                       Diagnostics* diagnostics) {
    const Bytes head = bytes.first(std::min(bytes.size(), kHeadBytes));
    for (const Format& format : formats())
        if (format.looksLike(head)) return format.read(bytes, name, options, diagnostics);
    return unknownFormat(bytes, name);
}

// A feature may state a class that its format lacks: walls as solids in CityGML 2.0, for example.
Result<model::BuildingModel> withStatedClasses(Result<model::BuildingModel> model) {
    if (!model) return model;
    for (model::Feature& feature : model->features)
        for (const Attribute& attribute : feature.attributes)
            if (attribute.name == "svtClass")
                if (const auto* stated = std::get_if<std::string>(&attribute.value);
                    stated != nullptr && !stated->empty())
                    feature.className = model::canonicalClassName(*stated);
    return model;
}

// The bytes of a deflated file of an archive, not checked yet.
Result<std::vector<std::byte>> unpackedMember(const ZipMember& member, string_view name, std::uint64_t maxBytes) {
    const UnpackLimit limit = unpackLimit(member.packed.size(), maxBytes);
    const auto fail = [&](Code code, std::string message) {
        return Error(code, std::move(message), {std::string(name), 0, 0, {}});
    };
    // The size in the archive is a guess until it is unpacked.
    Inflated unpacked =
        inflateBytes(member.packed, DeflateFormat::Raw, std::min(member.size + 1, limit.bytes), limit.bytes);
    switch (unpacked.status) {
        case InflateStatus::Done:
            if (unpacked.taken == member.packed.size()) return std::move(unpacked.bytes);
            break;
        case InflateStatus::TooLong: return fail(Code::InputTooBig, limit.message);
        case InflateStatus::CutShort:
            return fail(Code::CannotOpen, "the zip archive ends too early; it seems to be cut off");
        case InflateStatus::Damaged: break;
    }
    return fail(Code::CannotOpen,
                fmt::format("'{}' in the zip archive is damaged; copy or download the archive again", member.name));
}

// An IFC file in a zip archive (.ifczip).
Result<model::BuildingModel> readZip(Bytes bytes, string_view name, const ReadOptions& options,
                                     Diagnostics* diagnostics) {
    constexpr string_view kExtensions[] = {".ifc"};
    SVT_TRY(member, findZipMember(bytes, name, kExtensions));
    std::vector<std::byte> unpacked;
    if (member->isDeflated) {
        SVT_TRY(inflated, unpackedMember(*member, name, options.maxBytes));
        unpacked = std::move(*inflated);
    }
    const Bytes plain = member->isDeflated ? Bytes(unpacked) : member->packed;
    SVT_DO(checkZipMember(*member, plain, name));
    return readPlain(plain, name, options, diagnostics);
}

// Extrudes footprints if requested.
Result<model::BuildingModel> withBodies(Result<model::BuildingModel> model, const ReadOptions& options,
                                        Diagnostics* diagnostics) {
    if (model && options.extrudeFootprints) extrudeFootprints(*model, diagnostics);
    return model;
}

Result<model::BuildingModel> readAny(Bytes bytes, string_view name, const ReadOptions& options,
                                     Diagnostics* diagnostics) {
    if (isZip(bytes)) return readZip(bytes, name, options, diagnostics);
    if (!isGzip(bytes)) return readPlain(bytes, name, options, diagnostics);
    SVT_TRY(plain, decompressed(bytes, name, options.maxBytes));
    return readPlain(*plain, name, options, diagnostics);
}

}  // namespace

std::vector<string_view> modelEndings() {
    std::vector<string_view> endings;
    for (const Format& format : formats())
        for (const string_view ending : splitChoices(format.endings))
            if (std::ranges::find(endings, ending) == endings.end()) endings.push_back(ending);
    return endings;
}

bool hasModelEnding(const std::filesystem::path& path) {
    std::string name = lowerAscii(path.filename().string());
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    for (const string_view ending : modelEndings())
        if (name.ends_with(ending)) return true;
    return false;
}

Result<model::BuildingModel> readModel(Bytes bytes, string_view name, const ReadOptions& options,
                                       Diagnostics* diagnostics) {
    if (bytes.size() > options.maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("the file has {} bytes, the limit is {}", bytes.size(), options.maxBytes),
                     {std::string(name), 0, 0, {}});
    try {
        auto model = withStatedClasses(readAny(bytes, name, options, diagnostics));
        if (model) removeEnded(*model, options.date, diagnostics);
        return withBodies(std::move(model), options, diagnostics);
    } catch (const std::bad_alloc&) {
        // Here the file is known, and the memory of its incomplete model is free again.
        const auto grant = memoryGrant();
        return Error(
            Code::InputTooBig,
            fmt::format("reading its {} takes more memory than {}; split the model and read the parts, or grant "
                        "more",
                        bytesText(bytes.size()), grant ? grant->text : "there is"),
            {std::string(name), 0, 0, {}});
    }
}

Result<model::BuildingModel> readModel(const std::filesystem::path& path, const ReadOptions& options,
                                       Diagnostics* diagnostics) {
    SVT_TRY(file, FileBytes::read(path, options.maxBytes));
    ReadOptions own = options;
    if (own.imageFolder.empty()) own.imageFolder = path.has_parent_path() ? path.parent_path().string() : ".";
    return readModel(file->bytes(), path.string(), own, diagnostics);
}

}  // namespace svt::readers
