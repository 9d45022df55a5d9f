#pragma once
/// \file
/// A folder that appears only when all of its files are written.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace svt::writers {

/// A folder under a temporary name (`.part`) beside its final place. commit() renames it; without commit() it is
/// removed. An existing folder is never replaced.
class NewFolder {
public:
    explicit NewFolder(std::filesystem::path place);
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder();

    /// \return nothing, or WouldDestroy, CannotWrite
    [[nodiscard]] Result<void> create();
    /// Writes a file; `name` may contain folders, with '/'. \return success, or DiskFull, CannotWrite
    [[nodiscard]] Result<void> write(const std::string& name, std::string_view text);
    /// Adds to the end of a file of this folder. Errors as write().
    [[nodiscard]] Result<void> append(const std::string& name, std::string_view text);
    /// \return bytes of all files, or CannotWrite
    [[nodiscard]] Result<std::uint64_t> commit();

private:
    [[nodiscard]] Result<void> put(const std::string& name, std::string_view text, bool isAdded);
    [[nodiscard]] Error at(Code code, std::string message) const;

    std::filesystem::path place_, folder_;
    std::uint64_t size_ = 0;
    bool isMade_ = false;
    Unfinished unfinished_;
};

}  // namespace svt::writers
