#pragma once
/// \file
/// Internal: one gzip member written as a stream, compressed on all cores. Pieces of fixed size are compressed
/// independently and joined at byte boundaries, so the bytes do not depend on the number of threads.

#include <svt/core/file.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::writers {

class GzipWriter {
public:
    /// \param file     where the member goes; must outlive the writer
    /// \param threads  at most this many; 0: all cores
    explicit GzipWriter(AtomicFile& file, int threads = 0) : file_(file), threads_(threads) {}

    /// Appends bytes. \return what AtomicFile::write returns
    Result<void> write(std::span<const std::byte> bytes);
    /// Ends the member. Nothing may be written after it.
    Result<void> finish();

private:
    Result<void> compress(std::span<const std::byte> bytes);

    AtomicFile& file_;
    int threads_;
    std::vector<std::byte> pending_;  // less than one piece
    std::uint64_t size_ = 0;
    std::uint32_t crc_ = 0;
    bool isBegun_ = false;
};

}  // namespace svt::writers
