#pragma once
/// \file
/// Packs: files of some thousand buildings, whose members are complete `.svt` files, one for each tile and level of
/// detail. docs/formats/city.md specifies them to the bit.

#include <svt/city/city_plan.hpp>
#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace svt::city {

/// A building of a member.
struct PackBuilding {
    std::uint64_t idHash = 0;
    std::uint32_t label = 0;  ///< in the member's label table
    friend bool operator==(const PackBuilding&, const PackBuilding&) = default;
};

/// A volume in a pack.
struct PackMember {
    TileKey tile;
    int detail = 0;  ///< 0: all labels at the spacing of the city; 1: one label a building at twice the spacing
    std::uint64_t offset = 0, size = 0;
    Box3d box;                            ///< of the samples, world space
    std::vector<PackBuilding> buildings;  ///< of detail 0, in the order of labels; empty of others
};

/// A pack that is open for reading.
class Pack {
public:
    /// Opens a pack and reads its directory, whose checksum is checked.
    /// \return the pack, or CannotOpen; BadPack if it is damaged, none, or of other content (\param content: its
    ///         digest, Plan::packDigests; empty: any)
    [[nodiscard]] static Result<Pack> open(const std::filesystem::path& path, const std::string& content);

    [[nodiscard]] const std::vector<PackMember>& members() const noexcept { return members_; }
    /// The volume of a member, whose bytes are those of a `.svt` file.
    /// \return the volume, or BadPack that tells what is wrong with it; CannotOpen
    [[nodiscard]] Result<volume::SemanticVolume> read(const PackMember& member) const;

private:
    Pack(std::filesystem::path path, PartFile file) : path_(std::move(path)), file_(std::move(file)) {}
    std::filesystem::path path_;
    PartFile file_;
    std::vector<PackMember> members_;
};

/// A feature that a pack lacks.
struct SkippedFeature {
    std::string file;
    std::uint64_t begin = 0;  ///< byte in its text
    std::string reason;
    friend bool operator==(const SkippedFeature&, const SkippedFeature&) = default;
};

/// What is said of a pack that is done.
struct PackReport {
    std::uint32_t pack = 0;
    std::string content;  ///< Plan::packDigests
    std::string sha256;   ///< of the pack
    std::uint64_t bytes = 0, buildings = 0, members = 0;
    std::vector<SkippedFeature> skipped;
};

/// How packs are built.
struct PackOptions {
    int threads = 1;
    double tileSeconds = 120;  ///< what a tile may take before its features are tried one by one
    double featureSeconds = 20;
    const Progress* progress = nullptr;
    /// Called before a feature's model is made, with its text; tests let it crash or hang.
    std::function<void(std::string_view)> beforeFeature;
};

[[nodiscard]] std::filesystem::path packPath(const std::filesystem::path& folder, std::uint32_t pack);

/// Builds a pack of a plan, unless it is there and proven: its report has the digest of its content, and the file the SHA-256
/// of the report. The work is done in processes of their own: one that crashes, or takes too long for a tile, ends alone;
/// then the features of that tile are tried one by one, and those that fail are left out and reported. Requires that this
/// process has started no threads (see inOwnProcess()); on systems without processes a crash is one.
/// \return the report, or BadPlan, InputChanged, CannotOpen, CannotWrite, DiskFull; TaskFailed where even the tried
///         features come to no end
[[nodiscard]] Result<PackReport> runPack(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                                         const PackOptions& options);

/// The report of a pack that is done. \param isProven  whether the SHA-256 of the file is computed and compared, too
/// \return the report, or CityIncomplete
[[nodiscard]] Result<PackReport> provenReport(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                                              bool isProven);

}  // namespace svt::city
