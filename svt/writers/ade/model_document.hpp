#pragma once
/// \file
/// The document around a volume: the document of a model, into which the volume is inserted, or a plain one.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

enum class CityGmlVersion : std::uint8_t { V2, V3 };

/// The namespace of the extension.
[[nodiscard]] std::string_view adeNamespace(CityGmlVersion version) noexcept;

/// A document in two halves; the appearance is written between them.
class ModelDocument {
public:
    /// Opens a model. \return its document, or CannotOpen, UnknownFormat, BadArgument (it already has a volume)
    [[nodiscard]] static Result<ModelDocument> open(const std::filesystem::path& path);
    /// Features as buildings and generic objects, without geometry.
    [[nodiscard]] static ModelDocument plain(const volume::SemanticVolume& volume, CityGmlVersion version);

    [[nodiscard]] CityGmlVersion version() const noexcept { return version_; }
    /// The values of all attributes gml:id of a model, as written, sorted; none for a plain document.
    [[nodiscard]] std::vector<std::string_view> ids() const;
    [[nodiscard]] Result<void> writeBegin(AtomicFile& file) const;
    [[nodiscard]] Result<void> writeEnd(AtomicFile& file) const;

private:
    [[nodiscard]] Result<void> write(std::string_view text, AtomicFile& file) const;

    std::optional<FileBytes> mapped_;
    std::string begin_, end_;  // of a plain document
    std::size_t cut_ = 0;      // of a mapped one
    CityGmlVersion version_ = CityGmlVersion::V3;
    bool isFirstVersion_ = false;  // CityGML 1.0, whose namespaces are replaced
};

/// "#id" as a reference; characters that a URI does not allow become %XX.
[[nodiscard]] std::string referenceTo(std::string_view id);

/// A gml:id for the id of a label: itself if XML allows it, otherwise "label-NUMBER".
[[nodiscard]] std::string gmlId(std::string_view id, std::size_t number);

}  // namespace svt::writers
