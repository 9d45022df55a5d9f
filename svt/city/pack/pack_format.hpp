#pragma once
/// \file
/// Writes packs.

#include <svt/city/base/sha256.hpp>
#include <svt/city/city_pack.hpp>

#include <string>

namespace svt::city {

class PackWriter {
public:
    [[nodiscard]] static Result<PackWriter> create(const std::filesystem::path& path, const std::string& content);
    /// \return the member with offset and size
    Result<PackMember> add(PackMember member, std::span<const std::byte> bytes);
    /// Writes the directory, syncs and renames. \return SHA-256 of the file
    [[nodiscard]] Result<std::string> commit();
    [[nodiscard]] std::uint64_t size() const noexcept { return file_.size(); }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

private:
    explicit PackWriter(AtomicFile file) : file_(std::move(file)) {}
    Result<void> write(std::span<const std::byte> bytes);
    Result<void> write(std::string_view text) { return write(std::as_bytes(std::span(text.data(), text.size()))); }

    AtomicFile file_;
    Sha256 sum_;
    std::string directory_;
    std::uint32_t count_ = 0;
};

/// report.json and back.
[[nodiscard]] std::string reportJson(const PackReport& report);
[[nodiscard]] Result<PackReport> readReport(const std::filesystem::path& path);
[[nodiscard]] std::filesystem::path reportPath(const std::filesystem::path& folder, std::uint32_t pack);

}  // namespace svt::city
