#pragma once
/// \file
/// Digests in city.json of itself and of the files next to it, so that damage is reported when a city is opened.

#include <svt/city/city_folder.hpp>
#include <svt/city/merge/index_file.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace svt::city {

/// Files up to this size are compared with their SHA-256 when a folder is opened (a third of a second). Larger files
/// are compared by size, and page by page when they are read.
inline constexpr std::uint64_t kMostProvenBytes = std::uint64_t{64} << 20;

/// `index`, `ids`, `words` and `packDigests` of city.json.
void putProofs(nlohmann::ordered_json& json, std::string_view index, std::string_view ids, std::string_view packs,
               const CityProof::Words& words);
/// The text of city.json, with the SHA-256 of itself: that of the text with an empty `digest`.
[[nodiscard]] std::string sealedJson(nlohmann::ordered_json json);
/// Whether the text has the digest that it states. True for texts of earlier programs, which do not state a digest.
[[nodiscard]] bool hasOwnDigest(std::string_view text, const nlohmann::json& json);

/// Sizes and digests of the files that city.json names; empty for cities of earlier programs. Throws the exceptions of
/// nlohmann.
[[nodiscard]] std::optional<CityProof> readProof(const nlohmann::json& json);
/// Compares a file with its size and digest in city.json.
/// \return an empty text, or the difference; or an error of the store
[[nodiscard]] Result<std::string> differenceOf(const Store& store, const char* name, const CityProof::File& file);

}  // namespace svt::city
