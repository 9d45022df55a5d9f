#pragma once
/// \file
/// The temporary files of AtomicFile: recognizable by name, locked while their writer lives, and removed after it was
/// killed.

#include <svt/core/file.hpp>

#include <cstddef>
#include <filesystem>

namespace svt {

/// A new, empty file that is open for writing.
struct TemporaryFile {
    int descriptor = -1;
    std::filesystem::path path;
    Unfinished unfinished;  // until it is renamed or removed
};

/// Whether locks protect the files of running processes from removal as leftovers: false where the system has no locks
/// (WebAssembly); nothing is removed there.
[[nodiscard]] bool hasFileLocks() noexcept;

/// Creates a file in `folder` (empty: the current one) and locks it until its descriptor is closed. Rename or remove
/// the file before that. The first call of a process for a folder removes leftovers there.
/// \return 0, or errno
[[nodiscard]] int openTemporaryFile(const std::filesystem::path& folder, TemporaryFile& file);

/// Removes the temporary files in `folder` that no writer has locked. A file whose lock cannot be tried (another
/// user's, a file system without locks) stays. Threads and processes may call it concurrently, also while others write.
/// \return the number of removed files. Cost: one pass over all names in the folder
std::size_t removeLeftovers(const std::filesystem::path& folder);

}  // namespace svt
