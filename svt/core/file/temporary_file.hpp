#pragma once
/// \file
/// The temporary files of AtomicFile: named so that they are known again, locked while their writer lives, and removed
/// when it was killed.

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

/// Whether a process that still runs keeps a file from being taken for a leftover: false where the system has no locks
/// (WebAssembly), and nothing is removed there.
[[nodiscard]] bool hasFileLocks() noexcept;

/// Makes a file in `folder` (empty: the current one) and locks it until its descriptor is closed: it must be renamed or
/// removed before. The first call of a process for a folder removes leftovers there.
/// \return 0, or errno
[[nodiscard]] int openTemporaryFile(const std::filesystem::path& folder, TemporaryFile& file);

/// Removes the temporary files in `folder` that no writer has locked. A file whose lock cannot be tried (another user's,
/// a file system without locks) stays. Threads and processes may call it at once, beside writers.
/// \return how many were removed. Cost: a look at all names in the folder
std::size_t removeLeftovers(const std::filesystem::path& folder);

}  // namespace svt
