#pragma once
/// \file
/// Gives memory back to the system before its owner ends: what was freed, and what of a mapped file has been read.

#include <cstddef>
#include <span>

namespace svt {

/// Memory that was freed in small pieces goes back to the system, where the C library keeps it otherwise. After large
/// structures of many small parts were freed, before other large ones are made. Cost: milliseconds for each GB.
/// No effect on systems without such a call.
void returnFreeMemory() noexcept;

/// Bytes of a MappedFile that will hardly be read again: they leave the memory of the process, and are read from the file
/// if they are needed after all. No effect on bytes that are none of a MappedFile. Threads: any.
void forgetMappedBytes(std::span<const std::byte> bytes) noexcept;

}  // namespace svt
