#pragma once
/// \file
/// A folder that appears when all of its files are written.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace svt::writers {

/// A folder under another name (`.part`) beside its place, which it takes in commit(); without that it is removed. A
/// folder that is there is never replaced.
class NewFolder {
public:
    explicit NewFolder(std::filesystem::path place);
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder();

    /// \return nothing, or WouldDestroy, CannotWrite
    [[nodiscard]] Result<void> create();
    /// Writes a file; `name` may have folders, with '/'. \return nothing, or DiskFull, CannotWrite
    [[nodiscard]] Result<void> write(const std::string& name, std::string_view text);
    /// \return bytes of all files, or CannotWrite
    [[nodiscard]] Result<std::uint64_t> commit();

private:
    [[nodiscard]] Error at(Code code, std::string message) const;

    std::filesystem::path place_, folder_;
    std::uint64_t size_ = 0;
    bool isMade_ = false;
    Unfinished unfinished_;
};

}  // namespace svt::writers
