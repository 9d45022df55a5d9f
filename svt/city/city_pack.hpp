#pragma once
/// \file
/// Packs: files with some thousand buildings. Their members are complete `.svt` files, one for each tile and level of
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
    int detail = 0;  ///< 0: all labels at the spacing of the city; 1: one label per building at twice the spacing
    std::uint64_t offset = 0, size = 0;
    Box3d box;                            ///< of the samples, world space
    std::vector<PackBuilding> buildings;  ///< of detail 0, in the order of labels; empty at other details
};

/// A pack that is open for reading.
class Pack {
public:
    /// Opens a pack, reads its directory and verifies the checksum of the directory.
    /// \param content  expected digest of the content (Plan::packDigests); empty: any
    /// \return the pack, or CannotOpen; BadPack if the file is damaged, is not a pack, or has other content
    [[nodiscard]] static Result<Pack> open(const std::filesystem::path& path, const std::string& content);

    [[nodiscard]] const std::vector<PackMember>& members() const noexcept { return members_; }
    /// The volume of a member. The bytes of a member are those of a `.svt` file.
    /// \return the volume, or BadPack, which names the damage; CannotOpen
    [[nodiscard]] Result<volume::SemanticVolume> read(const PackMember& member) const;
    /// The labels of a member; its samples are not decoded. Errors as read().
    [[nodiscard]] Result<volume::LabelTable> readLabels(const PackMember& member) const;

private:
    [[nodiscard]] Error damaged(const PackMember& member, const Error& reason) const;
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

/// The report of a finished pack.
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
    double tileSeconds = 120;  ///< time limit of a tile; beyond it, its features are tried one by one
    double featureSeconds = 20;
    const Progress* progress = nullptr;
    /// A function that gets a feature's text before its model is made. Tests let it crash or hang.
    std::function<void(std::string_view)> beforeFeature;
};

[[nodiscard]] std::filesystem::path packPath(const std::filesystem::path& folder, std::uint32_t pack);

/// Builds a pack of a plan, unless it exists and is proven: its report has the digest of its content, and the file has
/// the SHA-256 of the report.
///
/// The work is done in separate processes. If one crashes or exceeds the time for a tile, the features of the tile are
/// tried one by one. Features that fail are left out and reported. Requires that this process has started no threads
/// (see inOwnProcess()). On systems without processes, a crash ends this process.
/// \return the report, or BadPlan, InputChanged, CannotOpen, CannotWrite, DiskFull; TaskFailed if the pack cannot be
///         built even after its features were tried one by one
[[nodiscard]] Result<PackReport> runPack(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                                         const PackOptions& options);

/// The report of a finished pack. \param isProven  whether the SHA-256 of the file is computed and compared as well
/// \return the report, or CityIncomplete
[[nodiscard]] Result<PackReport> provenReport(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                                              bool isProven);

}  // namespace svt::city
