#pragma once
/// \file
/// Binary results of FDS: records of Fortran, and the frames that they hold. A run that goes on, or that crashed, ends within
/// a frame; the whole frames before count.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::field_readers {

/// A file of records: u32 size, bytes, u32 size, little-endian.
class RecordFile {
public:
    struct Record {
        std::uint64_t begin = 0, size = 0;
        [[nodiscard]] std::uint64_t next() const noexcept { return begin + size + 4; }
    };

    /// \return the file, or CannotOpen
    [[nodiscard]] static Result<RecordFile> open(const std::filesystem::path& path);

    [[nodiscard]] std::uint64_t size() const noexcept { return file_.size(); }
    /// The record of `size` bytes that begins at `offset`.
    /// \return the record; nothing if the file ends before its end, or other bytes stand in its place; or CannotOpen
    [[nodiscard]] Result<std::optional<Record>> record(std::uint64_t offset, std::uint64_t size) const;
    /// \return the bytes of a record, or CannotOpen
    [[nodiscard]] Result<std::string> bytes(const Record& record) const {
        return file_.readAll(record.begin, record.size);
    }

private:
    explicit RecordFile(PartFile file) : file_(std::move(file)) {}

    PartFile file_;
};

/// The frames of a file. Each has the same number of values.
struct FrameFile {
    std::filesystem::path path;
    std::array<std::int32_t, 6> bounds{};  ///< first and last index along x, y, z
    std::vector<double> times;             ///< seconds, ascending
    std::vector<RecordFile::Record> frames;
    std::uint64_t wholeFrames = 0;       ///< in the file
    std::uint64_t replaced = 0;          ///< frames that a later start of the run wrote again
    std::optional<std::uint64_t> cutAt;  ///< the byte at which the frame begins that is not whole

    [[nodiscard]] Vec3i size() const noexcept {
        return {bounds[1] - bounds[0] + 1, bounds[3] - bounds[2] + 1, bounds[5] - bounds[4] + 1};
    }
    [[nodiscard]] std::uint64_t values() const noexcept {
        return std::uint64_t(size().x) * std::uint64_t(size().y) * std::uint64_t(size().z);
    }
};

/// Lists the frames of a `.sf`; reads no values. Cost: three reads a frame.
/// \return the frames, or CannotOpen, or BadField with the byte
[[nodiscard]] Result<FrameFile> listSliceFrames(const std::filesystem::path& path);
/// The same for a `.s3d`.
[[nodiscard]] Result<FrameFile> listSmokeFrames(const std::filesystem::path& path);

/// Appends the values of a frame of a `.sf`, x fastest.
/// \return nothing, or CannotOpen
[[nodiscard]] Result<void> readSliceFrame(const RecordFile& file, const FrameFile& list, std::size_t frame,
                                          std::vector<float>& to);
/// Appends the bytes of a frame of a `.s3d`, unpacked.
/// \return nothing, or CannotOpen, or BadField if they are not as many as the frame's places
[[nodiscard]] Result<void> readSmokeFrame(const RecordFile& file, const FrameFile& list, std::size_t frame,
                                          std::vector<std::uint8_t>& to);

/// Unpacks runs: 255, value, count; other bytes stand for themselves.
/// \return whether exactly `count` bytes come out, which are appended to `to`
[[nodiscard]] bool unpackRuns(std::string_view packed, std::size_t count, std::vector<std::uint8_t>& to);

}  // namespace svt::field_readers
