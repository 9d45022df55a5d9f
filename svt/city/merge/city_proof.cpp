#include <svt/city/merge/city_proof.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/city/store/store.hpp>
#include <svt/core/bytes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace svt::city {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::size_t kRootSum = 24, kFenceSum = 32, kIdCount = 16;  // in the heads of index.bin and ids.bin

using Json = nlohmann::ordered_json;

std::uint64_t numberAt(std::string_view bytes, std::size_t at) {
    ByteReader from(bytes.substr(std::min(at, bytes.size())));
    return from.take<std::uint64_t>();
}

Json fileJson(const char* name, std::string_view bytes) {
    return {{"file", name}, {"bytes", bytes.size()}, {"sha256", hexOf(digestOf(bytes))}};
}

CityProof::File fileOf(const nlohmann::json& row) {
    return {row.at("bytes").get<std::uint64_t>(), row.at("sha256").get<std::string>()};
}

std::uint64_t checksumOf(const nlohmann::json& row, const char* key) {
    const auto text = row.at(key).get<std::string>();
    std::uint64_t sum = 0;
    std::from_chars(text.data(), text.data() + text.size(), sum, 16);
    return sum;
}

}  // namespace

void putProofs(Json& json, std::string_view index, std::string_view ids, std::string_view packs,
               const CityProof::Words& words) {
    json["index"] = fileJson("index.bin", index);
    json["index"]["root"] = fmt::format("{:016x}", numberAt(index, kRootSum));
    json["ids"] = fileJson("ids.bin", ids);
    json["ids"]["count"] = numberAt(ids, kIdCount);
    json["ids"]["fence"] = fmt::format("{:016x}", numberAt(ids, kFenceSum));
    json["words"] = {{"file", "words.bin"},      {"bytes", words.bytes},
                     {"sha256", words.sha256},   {"count", words.count},
                     {"fenceAt", words.fenceAt}, {"fence", fmt::format("{:016x}", words.fence)}};
    json["packDigests"] = fileJson("packs.bin", packs);
}

std::string sealedJson(Json json) {
    const auto textOf = [&](const std::string& digest) {
        json["digest"] = digest;
        return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    };
    return textOf(hexOf(digestOf(textOf(""))));
}

bool hasOwnDigest(std::string_view text, const nlohmann::json& json) {
    const auto told = json.find("digest");
    if (told == json.end()) return text.find("\"sha256\"") == std::string_view::npos;
    if (!told->is_string()) return false;
    const auto& digest = told->get_ref<const std::string&>();
    const std::size_t at = text.find("\"" + digest + "\"");
    if (digest.empty() || at == std::string_view::npos) return false;
    std::string plain(text);
    plain.erase(at + 1, digest.size());
    return hexOf(digestOf(plain)) == digest;
}

std::optional<CityProof> readProof(const nlohmann::json& json) {
    if (!json.contains("digest")) return std::nullopt;
    CityProof proof;
    proof.index = fileOf(json.at("index"));
    proof.root = checksumOf(json.at("index"), "root");
    proof.ids = fileOf(json.at("ids"));
    proof.idCount = json.at("ids").at("count").get<std::uint64_t>();
    proof.fence = checksumOf(json.at("ids"), "fence");
    proof.packs = fileOf(json.at("packDigests"));
    if (const auto words = json.find("words"); words != json.end())
        proof.words = {fileOf(*words), words->at("count").get<std::uint64_t>(),
                       words->at("fenceAt").get<std::uint64_t>(), checksumOf(*words, "fence")};
    return proof;
}

Result<std::string> differenceOf(const Store& store, const char* name, const CityProof::File& file) {
    SVT_TRY(size, store.size(name));
    if (*size != file.bytes)
        return fmt::format("the file has {} bytes, and city.json says {}: it is damaged or of another merge", *size,
                           file.bytes);
    if (*size > kMostProvenBytes) return std::string();
    Sha256 sum;
    for (std::uint64_t at = 0; at < *size; at += kPiece) {
        SVT_TRY(piece, store.read(name, at, kPiece));
        sum.add(*piece);
    }
    if (hexOf(sum.finish()) == file.sha256) return std::string();
    return std::string("the SHA-256 of the file is not the one that city.json says: it is damaged or of another merge");
}

}  // namespace svt::city
