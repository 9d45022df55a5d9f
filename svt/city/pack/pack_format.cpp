#include <svt/city/pack/pack_format.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/core/bytes.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace svt::city {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kHead{"svtpack\0", 8}, kTail{"svtpend\0", 8};
constexpr std::uint32_t kPackVersion = 1;
constexpr std::size_t kHeadBytes = 48, kTailBytes = 32, kAlignment = 8;
constexpr std::size_t kPieceBytes = std::size_t{1} << 20;

Error badPack(const std::filesystem::path& path, std::string_view what) {
    return {Code::BadPack, fmt::format("{}; remove the file and run its task again", what), {path.string(), 0, 0, {}}};
}

std::uint64_t sumOf(std::string_view text) { return idHash(text); }

void appendMember(std::string& to, const PackMember& member) {
    appendAs<std::uint8_t>(to, member.detail, member.tile.level, 0, 0);
    appendBytes(to, member.tile.x, member.tile.y, static_cast<std::uint32_t>(member.buildings.size()), member.offset,
                member.size, member.box.min, member.box.max);
    for (const PackBuilding& building : member.buildings) appendBytes(to, building.idHash, building.label);
}

bool takeMember(ByteReader& from, std::uint64_t bodyEnd, PackMember& member) {
    member.detail = from.take<std::uint8_t>();
    member.tile.level = from.take<std::uint8_t>();
    from.skip(2);
    std::uint32_t buildings = 0;
    from.take(member.tile.x, member.tile.y, buildings, member.offset, member.size, member.box.min, member.box.max);
    if (!from.isGood() || buildings > from.left() / 12) return false;
    for (std::uint32_t b = 0; b < buildings; ++b) {
        PackBuilding& building = member.buildings.emplace_back();
        from.take(building.idHash, building.label);
    }
    return from.isGood() && isFinite(member.box.min) && isFinite(member.box.max) && !member.box.isEmpty() &&
           member.tile.level <= (member.detail < kFirstClassDetail ? Plan::kTopLevel : kMaxLevel) &&
           member.offset >= kHeadBytes && member.offset % kAlignment == 0 && member.offset <= bodyEnd &&
           member.size <= bodyEnd - member.offset;
}

}  // namespace

Result<PackWriter> PackWriter::create(const std::filesystem::path& path, const std::string& content) {
    std::error_code failed;
    std::filesystem::create_directories(path.parent_path(), failed);
    SVT_DO(checkNoStream(path));
    SVT_TRY(file, AtomicFile::create(path));
    PackWriter writer(std::move(*file));
    std::string head(kHead);
    appendBytes(head, kPackVersion, std::uint32_t{0}, digestFromHex(content));
    SVT_DO(writer.write(head));
    return writer;
}

Result<void> PackWriter::write(std::span<const std::byte> bytes) {
    sum_.add(bytes);
    return file_.write(bytes);
}

Result<PackMember> PackWriter::add(PackMember member, std::span<const std::byte> bytes) {
    const std::string zeros((kAlignment - file_.size() % kAlignment) % kAlignment, '\0');
    SVT_DO(write(zeros));
    member.offset = file_.size();
    member.size = bytes.size();
    appendMember(directory_, member);
    ++count_;
    SVT_DO(write(bytes));
    return member;
}

Result<std::string> PackWriter::commit() {
    std::string directory, tail;
    appendBytes(directory, count_);
    directory += directory_;
    appendAs<std::uint64_t>(tail, file_.size(), directory.size(), sumOf(directory));
    tail += kTail;
    SVT_DO(write(directory + tail));
    SVT_DO(file_.commit());
    return hexOf(sum_.finish());
}

Result<Pack> Pack::open(const std::filesystem::path& path, const std::string& content) {
    SVT_TRY(file, PartFile::open(path));
    const std::uint64_t bytes = file->size();
    if (bytes < kHeadBytes + kTailBytes) return badPack(path, "this is not a pack");
    const std::uint64_t tailBegin = bytes - kTailBytes;
    SVT_TRY(headText, file->read(0, kHeadBytes), tailText = file->read(tailBegin, kTailBytes));
    if (!tailText) return tailText.error();
    if (!headText->starts_with(kHead)) return badPack(path, "this is not a pack");
    ByteReader head(std::string_view(*headText).substr(kHead.size()));
    if (head.take<std::uint32_t>() != kPackVersion)
        return Error(Code::PlanVersion, "the pack has a version that this program does not know",
                     {path.string(), 0, 0, {}});
    head.skip(4);
    if (const auto own = head.take<Digest>(); !content.empty() && own != digestFromHex(content))
        return badPack(path, "the pack is one of another plan, or of other files");
    ByteReader tail(*tailText);
    const auto offset = tail.take<std::uint64_t>(), size = tail.take<std::uint64_t>(), sum = tail.take<std::uint64_t>();
    if (tail.text(kTail.size()) != kTail || offset < kHeadBytes || offset > tailBegin || size != tailBegin - offset)
        return badPack(path, "the directory of the pack is damaged, or its end is missing");
    SVT_TRY(directory, file->read(offset, static_cast<std::size_t>(size)));
    if (directory->size() != size || sumOf(*directory) != sum)
        return badPack(path, "the directory of the pack is damaged, or its end is missing");
    Pack pack(path, std::move(*file));
    ByteReader from(*directory);
    for (auto count = from.take<std::uint32_t>(); count > 0; --count) {
        PackMember member;
        if (!takeMember(from, offset, member)) return badPack(path, "the directory of the pack is damaged");
        pack.members_.push_back(std::move(member));
    }
    return pack;
}

Result<volume::SemanticVolume> Pack::read(const PackMember& member) const {
    SVT_TRY(bytes, file_.read(member.offset, static_cast<std::size_t>(member.size)));
    auto volume = volume::readSvt(std::as_bytes(std::span(*bytes)));
    if (!volume) return damaged(member, volume.error());
    return volume;
}

Result<volume::LabelTable> Pack::readLabels(const PackMember& member) const {
    SVT_TRY(bytes, file_.read(member.offset, static_cast<std::size_t>(member.size)));
    auto blocks = volume::openSvt(std::as_bytes(std::span(*bytes)));
    if (!blocks) return damaged(member, blocks.error());
    return std::move(blocks->labels);
}

Error Pack::damaged(const PackMember& member, const Error& reason) const {
    return badPack(path_, fmt::format("tile {}, detail {}, is damaged ({})", member.tile.toString(), member.detail,
                                      reason.message()));
}

std::filesystem::path packPath(const std::filesystem::path& folder, std::uint32_t pack) {
    return folder / "packs" / fmt::format("{:05}.svtp", pack);
}

std::filesystem::path reportPath(const std::filesystem::path& folder, std::uint32_t pack) {
    return folder / "reports" / fmt::format("{:05}.json", pack);
}

std::string reportJson(const PackReport& report) {
    Json json;
    json["format"] = "svt-city-report";
    json["pack"] = report.pack;
    json["content"] = report.content;
    json["sha256"] = report.sha256;
    json["bytes"] = report.bytes;
    json["members"] = report.members;
    json["buildings"] = report.buildings;
    json["skipped"] = Json::array();
    for (const SkippedFeature& skipped : report.skipped)
        json["skipped"].push_back({{"file", skipped.file}, {"begin", skipped.begin}, {"reason", skipped.reason}});
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<PackReport> readReport(const std::filesystem::path& path) {
    const Error damaged(Code::CityIncomplete, "there is no report of the pack, or a damaged one; run its task again",
                        {path.string(), 0, 0, {}});
    const auto file = FileBytes::read(path, std::uint64_t{64} << 20);
    if (!file) return damaged;
    PackReport report;
    try {
        const Json json = Json::parse(file->text());
        report.pack = json.at("pack").get<std::uint32_t>();
        report.content = json.at("content").get<std::string>();
        report.sha256 = json.at("sha256").get<std::string>();
        report.bytes = json.at("bytes").get<std::uint64_t>();
        report.members = json.at("members").get<std::uint64_t>();
        report.buildings = json.at("buildings").get<std::uint64_t>();
        for (const Json& skipped : json.at("skipped"))
            report.skipped.push_back({skipped.at("file").get<std::string>(), skipped.at("begin").get<std::uint64_t>(),
                                      skipped.at("reason").get<std::string>()});
    } catch (const Json::exception&) {
        return damaged;
    }
    return report;
}

Result<PackReport> provenReport(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                                bool isProven) {
    SVT_TRY(report, readReport(reportPath(folder, pack)));
    const std::filesystem::path path = packPath(folder, pack);
    const auto open = [&](std::string_view what) {
        return Error(Code::CityIncomplete, fmt::format("{}; run its task again", what), {path.string(), 0, 0, {}});
    };
    std::error_code failed;
    if (report->content != plan.packDigests[pack] || report->pack != pack)
        return open("the pack is one of another plan, or of other files");
    if (std::filesystem::file_size(path, failed) != report->bytes || failed)
        return open("the pack is missing, or has another size than its report says");
    if (!isProven) return report;
    SVT_TRY(file, PartFile::open(path));
    Sha256 sum;
    for (std::uint64_t at = 0; at < file->size(); at += kPieceBytes) {
        SVT_TRY(piece, file->read(at, kPieceBytes));
        sum.add(*piece);
    }
    if (hexOf(sum.finish()) != report->sha256) return open("the pack has another SHA-256 than its report says");
    return report;
}

}  // namespace svt::city
