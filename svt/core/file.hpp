#pragma once
/// \file
/// File access: read so that other programs may change a file meanwhile; written so that a failure leaves the old file
/// untouched.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt {

/// A temporary file, a folder or a child process that a signal removes or ends with this process. A library leaves signals
/// to its host: nothing is remembered until a program calls cleanUpOnSignals() (machine.hpp). Move-only; the destructor forgets it.
/// Threads: any. In a copy of this process (fork) nothing is remembered of what its parent made.
class Unfinished {
public:
    Unfinished() = default;

    /// Calls `make` and remembers what it makes. A signal ends the process before or after the call, never within it.
    /// \param make  makes a file or a folder and returns its path; an empty path is not remembered
    [[nodiscard]] static Unfinished path(const std::function<std::filesystem::path()>& make);

    /// Calls `start` and remembers the child process. On a signal it receives SIGTERM, and is killed 5 s later.
    /// \param start  returns the id of the process; numbers below 1 are not remembered
    [[nodiscard]] static Unfinished process(const std::function<int()>& start);

    Unfinished(Unfinished&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Unfinished& operator=(Unfinished&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;
    ~Unfinished() { forget(); }

    /// Call it after the file has its final name or is removed, or after the process has ended.
    void forget() noexcept;

private:
    explicit Unfinished(std::uint64_t id) noexcept : id_(id) {}

    std::uint64_t id_ = 0;  // 0: nothing
};

/// The bytes of a regular file in memory, read-only. Move-only; they stay valid for the lifetime of the object.
/// Replacing the file by rename (as AtomicFile does) leaves them as they are.
class FileBytes {
public:
    static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

    /// Reads the whole file; what other programs do to it later does not matter. An empty file gives an empty span.
    /// \return the file, or CannotOpen that says why: missing, a folder, no permission, a pipe or device, or a size that
    ///         changes while it is read; InputTooBig for more than `maxBytes`, or than there is memory for
    [[nodiscard]] static Result<FileBytes> read(const std::filesystem::path& path, std::uint64_t maxBytes = kNoLimit);
    /// Maps the file, for one that may be larger than memory and is read from its begin to its end. If another program
    /// shortens it, access raises SIGBUS, as with every mapping. Cost: O(1), pages are read when touched.
    /// \return as read()
    [[nodiscard]] static Result<FileBytes> map(const std::filesystem::path& path, std::uint64_t maxBytes = kNoLimit);

    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&& other) noexcept;
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;
    ~FileBytes();

    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }
    /// The same bytes as characters; no encoding is checked.
    [[nodiscard]] std::string_view text() const noexcept {
        return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
    }

private:
    FileBytes() = default;

    std::span<const std::byte> bytes_;
    std::unique_ptr<std::byte[]> own_;  // null of a mapping
};

/// A regular file of which parts are read. What another program cuts off is missing, or an error, and no signal.
/// Replacing the file by rename leaves the open one as it is. Threads: parts may be read at once.
class PartFile {
public:
    /// \return the file, or CannotOpen as FileBytes
    [[nodiscard]] static Result<PartFile> open(const std::filesystem::path& path);

    PartFile(PartFile&& other) noexcept;
    PartFile& operator=(PartFile&& other) noexcept;
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile();

    /// When it was opened.
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
    /// The bytes from `offset` on, `size` of them or as many as the file has there.
    /// \return the bytes, or CannotOpen where the system fails to read
    [[nodiscard]] Result<std::string> read(std::uint64_t offset, std::size_t size) const;

private:
    PartFile() = default;

    std::filesystem::path path_;
    std::uint64_t size_ = 0;
    int descriptor_ = -1;
};

/// Where the symbolic links at `path` lead, one after the other, also where nothing is there; `path` itself if it is no
/// link. Links in its folders are kept. Empty if the links form a circle.
[[nodiscard]] std::filesystem::path withoutLinks(const std::filesystem::path& path);

/// Writes to a temporary file next to `target` and renames it to `target` in commit(), so readers see either the old
/// file or the complete new one. Without commit() the temporary file is removed and the old file stays.
/// The temporary file is locked (flock) while the writer lives. What a process left that was killed has no lock; the
/// first writer of a process in a folder removes it there. Signals remove it too (cleanUpOnSignals()).
/// Symbolic links are followed and kept; so are the permissions of an existing file. A target that is not a regular
/// file (/dev/stdout, a pipe) is written directly.
/// Threads: one object must be used by one thread at a time.
class AtomicFile {
public:
    /// \return the writer, or CannotWrite where the folder is missing or not writable, or the target is a folder or
    ///         write-protected; DiskFull. Cost: the first time in a folder, a look at all names in it
    [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& target);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends bytes, buffered.
    /// \return DiskFull or CannotWrite; nothing more can be written after an error
    Result<void> write(std::span<const std::byte> bytes);
    Result<void> write(std::string_view text);
    /// Appends `count` zero bytes.
    Result<void> writeZeros(std::uint64_t count);

    /// Syncs the bytes to disk and renames the temporary file to the target.
    /// \return the number of bytes written, or DiskFull or CannotWrite; on failure the old file stays and the temporary
    ///         file is removed
    Result<std::uint64_t> commit();

    /// Bytes appended so far.
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

private:
    AtomicFile() = default;
    Result<void> flush();
    Result<void> writeThrough(std::span<const std::byte> bytes);
    Error fail(int systemError);
    void discard() noexcept;

    std::filesystem::path path_;       // as given by the caller, for messages
    std::filesystem::path target_;     // with symbolic links resolved
    std::filesystem::path temporary_;  // empty if the target is written directly
    Unfinished unfinished_;            // the temporary file
    std::vector<std::byte> buffer_;
    std::uint64_t size_ = 0;
    int descriptor_ = -1;
    int failed_ = 0;  // errno of the first failure
};

/// Writes the concatenated `parts` to the file `target`; all or nothing, see AtomicFile.
/// \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target,
                                                        std::span<const std::span<const std::byte>> parts);
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target,
                                                        std::span<const std::byte> bytes);
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target, std::string_view text);

/// Equal for two paths to one file, through links: its device and inode, or where nothing is there, the path that it
/// would have. Empty for devices such as /dev/null, which may be opened by many.
[[nodiscard]] std::string fileIdentity(const std::filesystem::path& path);

/// Whether AtomicFile could write `target` now: the folder is there, permissions and file system allow a new file in it,
/// and some space is left. A temporary file is made and removed; a pipe or device is not opened.
/// \return nothing, or CannotWrite or DiskFull as AtomicFile tells it
[[nodiscard]] Result<void> checkWritable(const std::filesystem::path& target);

/// Whether messages to stderr are read by a person at a terminal.
[[nodiscard]] bool isErrorTerminal() noexcept;

/// The file of the running program; empty where the system does not tell.
[[nodiscard]] std::filesystem::path executablePath();

/// A path as a user writes it on this system: on Windows, where the program runs under Node.js, '\' separates folders
/// as '/' does.
[[nodiscard]] std::filesystem::path userPath(std::string text);

/// A temporary folder that only this user can read, removed with its contents by the destructor, and by
/// signals (cleanUpOnSignals()).
class PrivateFolder {
public:
    PrivateFolder();
    PrivateFolder(PrivateFolder&& other) noexcept;
    PrivateFolder& operator=(PrivateFolder&&) = delete;
    ~PrivateFolder();
    /// Empty if the folder could not be created.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
    Unfinished unfinished_;
};

}  // namespace svt
