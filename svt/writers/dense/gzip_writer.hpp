#pragma once
/// \file
/// Writes one gzip member as a stream, compressed on all cores. Pieces of fixed size are compressed
/// independently and joined at byte boundaries, so the bytes do not depend on the number of threads.

#include <svt/core/file.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::writers {

class GzipWriter {
public:
    /// \param file     output file; must outlive the writer
    /// \param threads  maximum; 0: all cores
    explicit GzipWriter(AtomicFile& file, int threads = 0) : file_(file), threads_(threads) {}

    /// Appends bytes.
    /// \return the result of AtomicFile::write
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
