#pragma once
/// \file
/// File access. Reading tolerates that other programs change a file meanwhile. A failed write leaves the old file
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

/// Remembers a temporary file, a folder or a child process, which a signal removes or ends together with this process.
/// A library leaves signals to its host: nothing is remembered until a program calls cleanUpOnSignals() (machine.hpp).
/// Move-only; the destructor forgets it.
/// Threads: any. A copy of this process (fork) does not remember the files and processes of its parent.
class Unfinished {
public:
    Unfinished() = default;

    /// Calls `make` and remembers the returned path. A signal ends the process before or after the call, never within
    /// it.
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
/// Replacing the file by rename (as AtomicFile does) does not change them.
class FileBytes {
public:
    static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

    /// Reads the whole file; later changes by other programs have no effect. An empty file gives an empty span.
    /// \return the file; CannotOpen with the reason: missing, a folder, no permission, a pipe or device, or a size that
    ///         changes during reading; InputTooBig if the size exceeds `maxBytes` or the memory
    [[nodiscard]] static Result<FileBytes> read(const std::filesystem::path& path, std::uint64_t maxBytes = kNoLimit);
    /// Maps the file. Only for files that no other program knows: if another program shortens the file, access raises
    /// SIGBUS, as with every mapping. For files that others may change, use read(), or PartFile if they are large.
    /// scripts/check_banned_calls.py lists the sources that may map. Cost: O(1), pages are read when touched.
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

/// A regular file for reading parts. If another program shortens the file, the lost bytes are missing or an error, but
/// raise no signal. Replacing the file by rename does not affect the open file. Threads: parts may be read at once.
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
    /// Up to `size` bytes from `offset` on; fewer if the file ends before.
    /// \return the bytes, or CannotOpen where the system fails to read
    [[nodiscard]] Result<std::string> read(std::uint64_t offset, std::size_t size) const;
    /// The same, but it is an error if bytes are missing that the file had when it was opened.
    [[nodiscard]] Result<std::string> readAll(std::uint64_t offset, std::size_t size) const;
    /// Compares the size of the file and the time of its last change with those when it was opened. A change that keeps
    /// the size is not detected within one clock tick of the file system (some milliseconds).
    /// \return nothing, or CannotOpen where another program changed the file
    [[nodiscard]] Result<void> checkUnchanged() const;

private:
    PartFile() = default;

    std::filesystem::path path_;
    std::uint64_t size_ = 0;
    std::int64_t changed_ = 0;  // nanoseconds
    int descriptor_ = -1;
};

/// The target of the symbolic link `path`, followed through further links, even if the target does not exist; `path`
/// itself if it is not a link. Links in its folders are kept. Empty if the links form a circle.
[[nodiscard]] std::filesystem::path withoutLinks(const std::filesystem::path& path);

/// Writes to a temporary file next to `target` and renames it to `target` in commit(), so readers see either the old
/// file or the complete new one. Without commit() the temporary file is removed and the old file stays. The temporary
/// file is locked (flock) while the writer lives. A file left by a killed process has no lock; the first writer of a
/// process in a folder removes such files there. Signals (cleanUpOnSignals()) remove the temporary file, too. Symbolic
/// links are followed and kept; so are the permissions of an existing file. A target that is not a regular file
/// (/dev/stdout, a pipe) is written directly.
/// Threads: one object must be used by one thread at a time.
class AtomicFile {
public:
    /// \return the writer, or CannotWrite where the folder is missing or not writable, or the target is a folder or
    ///         write-protected; DiskFull. Cost: the first time in a folder, a search of its names
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

    enum class Durability : std::uint8_t {
        Synced,    ///< a crash of the machine leaves the old or the new file
        Temporary  ///< the file is removed soon, so its bytes need not reach the disk
    };
    /// Syncs the bytes to disk and renames the temporary file to the target.
    /// \return the number of bytes written, or DiskFull or CannotWrite; on failure the old file stays and the temporary
    ///         file is removed
    Result<std::uint64_t> commit(Durability durability = Durability::Synced);

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

/// For programs: from now on, AtomicFile replaces no regular file, but returns WouldDestroy.
void keepExistingFiles() noexcept;

/// Writes the concatenated `parts` to the file `target`; all or nothing, see AtomicFile.
/// \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target,
                                                        std::span<const std::span<const std::byte>> parts);
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target,
                                                        std::span<const std::byte> bytes);
[[nodiscard]] Result<std::uint64_t> writeFileAtomically(const std::filesystem::path& target, std::string_view text);

/// Equal for two paths to one file, also through links: its device and inode, or, if no file exists, the path that it
/// would have. Empty for devices such as /dev/null, which several writers may open.
[[nodiscard]] std::string fileIdentity(const std::filesystem::path& path);

/// Whether AtomicFile could write `target` now: the folder exists, permissions and file system allow a new file in it,
/// and some space is left. Creates and removes a temporary file; does not open a pipe or device.
/// \return nothing, or CannotWrite or DiskFull as from AtomicFile
[[nodiscard]] Result<void> checkWritable(const std::filesystem::path& target);

/// For a file whose name the program chooses in a folder of the user: opening a pipe there would wait for a reader.
/// \return nothing, or CannotWrite where a pipe, a socket or a device is at `target`
[[nodiscard]] Result<void> checkNoStream(const std::filesystem::path& target);

/// Whether stderr is a terminal, so that a person reads its messages.
[[nodiscard]] bool isErrorTerminal() noexcept;
/// Whether stdout is a terminal.
[[nodiscard]] bool isOutputTerminal() noexcept;

/// A path that reads stdin as a regular file, if stdin is a file at its begin (`< house.gml`); empty for a pipe.
[[nodiscard]] std::filesystem::path stdinAsFile();
/// Copies stdin to its end into the new file `to`.
/// \return bytes; InputTooBig if there are more than `maxBytes`; CannotOpen if stdin cannot be read; CannotWrite,
///         DiskFull
[[nodiscard]] Result<std::uint64_t> saveStdin(const std::filesystem::path& to, std::uint64_t maxBytes);

/// The path of the running program; empty where the system does not provide it.
[[nodiscard]] std::filesystem::path executablePath();

/// A path as a user writes it on this system: on Windows, where the program runs under Node.js, '\' separates folders
/// as '/' does.
[[nodiscard]] std::filesystem::path userPath(std::string text);

/// A temporary folder that only this user can read. The destructor and signals (cleanUpOnSignals()) remove it with its
/// contents.
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
