#include <svt/core/file.hpp>

#include <svt/core/file/temporary_file.hpp>
#include <svt/core/machine.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

namespace svt {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> keepsExisting{false};

constexpr std::size_t kBufferBytes = 256 * 1024;
/// Limit of one write(). Larger calls take Linux three to five times as long on ext4 (2.6 GB in calls of 14 MB: 4 to 10
/// s; in calls of 1 MB: 1.5 to 2.4 s).
constexpr std::size_t kMaxWriteBytes = std::size_t{1} << 20;

std::string systemReason(int systemError) { return std::generic_category().message(systemError); }

Error cannotOpen(const fs::path& path, std::string message) {
    return Error(Code::CannotOpen, std::move(message), Place{path.string(), 0, 0, {}});
}

Error cannotOpen(const fs::path& path, int systemError) {
    switch (systemError) {
        case ENOENT: return cannotOpen(path, "the file does not exist; check the spelling and the folder");
        case ENOTDIR: return cannotOpen(path, "a part of the path is a file, not a folder");
        case EACCES:
        case EPERM: return cannotOpen(path, "no permission to read the file; change its permissions or copy it");
        case EMFILE:
        case ENFILE: return cannotOpen(path, "too many files are open; close some or raise the limit (ulimit -n)");
        default: return cannotOpen(path, "the file cannot be opened: " + systemReason(systemError));
    }
}

Error cannotWrite(const fs::path& path, Code code, std::string message) {
    return Error(code, std::move(message), Place{path.string(), 0, 0, {}});
}

Error cannotWrite(const fs::path& path, int systemError) {
    const auto error = [&](Code code, std::string message) { return cannotWrite(path, code, std::move(message)); };
    switch (systemError) {
        case ENOSPC: return error(Code::DiskFull, "no space is left on the disk; free some or choose another folder");
        case EDQUOT: return error(Code::DiskFull, "the disk quota is used up; free some or choose another folder");
        case ENOENT:
            return error(Code::CannotWrite,
                         fmt::format("the folder {} does not exist; create it first",
                                     path.has_parent_path() ? path.parent_path().string() : "of the file"));
        case ENOTDIR: return error(Code::CannotWrite, "a part of the path is a file, not a folder");
        case EISDIR: return error(Code::CannotWrite, "this is a folder; remove it, or give another name");
        case EACCES:
        case EPERM:
            return error(Code::CannotWrite,
                         "no permission to write here; change the permissions or choose another folder");
        case EROFS: return error(Code::CannotWrite, "the file system is read-only; choose another folder");
        case ENAMETOOLONG: return error(Code::CannotWrite, "the file name is too long; choose a shorter one");
        case EFBIG:
            return error(Code::CannotWrite,
                         "the file is larger than this file system or the size limit (ulimit -f) allows");
        case EPIPE: return error(Code::CannotWrite, "the reader at the other end of the pipe has closed it");
        default: return error(Code::CannotWrite, "the file cannot be written: " + systemReason(systemError));
    }
}

/// The error if no file can be created next to `target`, to which `given` leads.
Error cannotMake(const fs::path& given, const fs::path& target, int systemError) {
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code ignored;
    if (systemError != ENOENT) return cannotWrite(given, systemError);
    if (fs::is_directory(folder, ignored))
        return cannotWrite(
            given, Code::CannotWrite,
            fmt::format("the system makes no files in the folder {}; choose another folder", folder.string()));
    if (target != given)
        return cannotWrite(given, Code::CannotWrite,
                           fmt::format("this is a link to {}, and the folder {} does not exist; create it, or remove "
                                       "the link",
                                       target.string(), folder.string()));
    return cannotWrite(given, systemError);
}

int openDescriptor(const char* path, int flags) noexcept {
    for (;;) {
        const int descriptor = ::open(path, flags | O_CLOEXEC);
        if (descriptor >= 0 || errno != EINTR) return descriptor;
    }
}

/// Closes its descriptor on destruction.
class Descriptor {
public:
    explicit Descriptor(int descriptor) noexcept : descriptor_(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { ::close(descriptor_); }

private:
    int descriptor_;
};

/// Opens a regular file for reading and determines its size.
Result<int> openInput(const fs::path& path, std::uint64_t maxBytes, std::uint64_t& size) {
    // Without O_NONBLOCK, opening a pipe without a writer would block forever.
    const int descriptor = openDescriptor(path.c_str(), O_RDONLY | O_NONBLOCK);
    if (descriptor < 0) return cannotOpen(path, errno);
    const auto refuse = [&](Error error) {
        ::close(descriptor);
        return error;
    };
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return refuse(cannotOpen(path, errno));
    if (!S_ISREG(status.st_mode))
        return refuse(cannotOpen(
            path, S_ISDIR(status.st_mode) ? "this is a folder; give the name of a file in it"
                                          : "this is a pipe or device, which cannot be read; copy it to a file first"));
    size = static_cast<std::uint64_t>(status.st_size);
    if (size > maxBytes)
        return refuse(Error(Code::InputTooBig, fmt::format("the file has {} bytes, the limit is {}", size, maxBytes),
                            Place{path.string(), 0, 0, {}}));
    if (size > SIZE_MAX) return refuse(cannotOpen(path, EFBIG));
    return descriptor;
}

/// The time of the last change of a file's bytes, in nanoseconds.
std::int64_t changeTime(const struct stat& status) noexcept {
    return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

/// Fills `to` from the file at `offset` as far as the file goes; `count` bytes of it. Returns 0, or errno.
int readAt(int descriptor, std::uint64_t offset, std::span<std::byte> to, std::size_t& count) noexcept {
    for (count = 0; count < to.size();) {
        const std::size_t size = std::min(to.size() - count, std::size_t{1} << 30);
        const ::ssize_t got = ::pread(descriptor, to.data() + count, size, static_cast<::off_t>(offset + count));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) break;
        count += static_cast<std::size_t>(got);
    }
    return 0;
}

}  // namespace

Result<FileBytes> FileBytes::read(const fs::path& path, std::uint64_t maxBytes) {
    std::uint64_t size = 0;
    SVT_TRY(input, openInput(path, maxBytes, size));
    const Descriptor descriptor(*input);
    FileBytes file;
    try {
        file.own_ = std::make_unique_for_overwrite<std::byte[]>(static_cast<std::size_t>(size));
    } catch (const std::bad_alloc&) {
        return Error(
            Code::InputTooBig,
            fmt::format("its {} are more than there is memory for; split the file, or grant more", bytesText(size)),
            Place{path.string(), 0, 0, {}});
    }
    std::size_t count = 0;
    if (const int reason = readAt(*input, 0, {file.own_.get(), static_cast<std::size_t>(size)}, count); reason != 0)
        return cannotOpen(path, reason);
    if (struct stat now{};
        ::fstat(*input, &now) != 0 || count != size || static_cast<std::uint64_t>(now.st_size) != size)
        return cannotOpen(path, fmt::format("the size of the file changed while it was read, from {} to {} bytes; wait "
                                            "until the program that writes it is done",
                                            size, now.st_size));
    file.bytes_ = {file.own_.get(), static_cast<std::size_t>(size)};
    return file;
}

Result<FileBytes> FileBytes::map(const fs::path& path, std::uint64_t maxBytes) {
    std::uint64_t size = 0;
    SVT_TRY(input, openInput(path, maxBytes, size));
    const Descriptor descriptor(*input);
    FileBytes file;
    if (size == 0) return file;
    void* memory = ::mmap(nullptr, static_cast<std::size_t>(size), PROT_READ, MAP_PRIVATE, *input, 0);
    if (memory == MAP_FAILED) return cannotOpen(path, errno);
    file.bytes_ = {static_cast<const std::byte*>(memory), static_cast<std::size_t>(size)};
    return file;
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})), own_(std::move(other.own_)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(own_, other.own_);
    return *this;
}

FileBytes::~FileBytes() {
    if (!bytes_.empty() && own_ == nullptr) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

Result<PartFile> PartFile::open(const fs::path& path) {
    PartFile file;
    SVT_TRY(input, openInput(path, FileBytes::kNoLimit, file.size_));
    file.descriptor_ = *input;
    file.path_ = path;
    struct stat status {};
    if (::fstat(file.descriptor_, &status) != 0) return cannotOpen(path, errno);
    file.changed_ = changeTime(status);
    return file;
}

PartFile::PartFile(PartFile&& other) noexcept
    : path_(std::move(other.path_)),
      size_(other.size_),
      changed_(other.changed_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

PartFile& PartFile::operator=(PartFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(size_, other.size_);
    std::swap(changed_, other.changed_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

PartFile::~PartFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<std::string> PartFile::read(std::uint64_t offset, std::size_t size) const {
    std::string text(offset < size_ ? static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - offset)) : 0,
                     '\0');
    std::size_t count = 0;
    if (const int reason = readAt(descriptor_, offset, std::as_writable_bytes(std::span(text)), count); reason != 0)
        return cannotOpen(path_, reason);
    text.resize(count);
    return text;
}

Result<std::string> PartFile::readAll(std::uint64_t offset, std::size_t size) const {
    SVT_TRY(text, read(offset, size));
    if (offset < size_ && text->size() < std::min<std::uint64_t>(size, size_ - offset))
        return cannotOpen(path_,
                          fmt::format("another program shortened the file, which had {} bytes, while it was read; "
                                      "wait until it is done",
                                      size_));
    return std::move(*text);
}

Result<void> PartFile::checkUnchanged() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) return cannotOpen(path_, errno);
    if (static_cast<std::uint64_t>(status.st_size) == size_ && changeTime(status) == changed_) return {};
    return cannotOpen(path_,
                      "another program changed the file while it was in use; wait until it is done, and start again");
}

fs::path withoutLinks(const fs::path& path) {
    constexpr int kMaxLinks = 40;
    std::error_code ignored;
    fs::path target = path;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
        if (links == kMaxLinks) return {};
        const fs::path next = fs::read_symlink(target, ignored);
        if (next.empty()) break;
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return target;
}

void keepExistingFiles() noexcept { keepsExisting = true; }

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
    AtomicFile file;
    file.path_ = target;
    if (target.empty() || !target.has_filename())
        return cannotWrite(target, Code::CannotWrite, "the name of the output file is empty");

    // Checked before links are followed by name: the link /dev/stdout may lead to a pipe, which has no name.
    struct stat status {};
    bool exists = ::stat(target.c_str(), &status) == 0;
    if (exists && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
        file.descriptor_ = openDescriptor(target.c_str(), O_WRONLY);
        if (file.descriptor_ < 0) return cannotWrite(target, errno);
        return file;
    }

    // Follow a symbolic link so that it remains a link; a dangling link names the file to create.
    file.target_ = withoutLinks(target);
    if (file.target_.empty()) return cannotWrite(target, ELOOP);

    exists = ::stat(file.target_.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) return cannotWrite(target, errno);
    if (exists && S_ISDIR(status.st_mode)) return cannotWrite(target, EISDIR);
    if (exists && keepsExisting)
        return cannotWrite(target, Code::WouldDestroy,
                           "the file exists, and --no-clobber keeps existing files; give another name");
    if (exists && ::access(file.target_.c_str(), W_OK) != 0)
        return cannotWrite(target, Code::CannotWrite,
                           "the file is write-protected; change that or choose another name");

    TemporaryFile temporary;
    if (const int reason = openTemporaryFile(file.target_.parent_path(), temporary); reason != 0)
        return cannotMake(target, file.target_, reason);
    file.descriptor_ = temporary.descriptor;
    file.temporary_ = std::move(temporary.path);
    file.unfinished_ = std::move(temporary.unfinished);
    if (exists && ::fchmod(file.descriptor_, status.st_mode & 07777) != 0) return file.fail(errno);
    return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept { *this = std::move(other); }

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(target_, other.target_);
    std::swap(temporary_, other.temporary_);
    std::swap(unfinished_, other.unfinished_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(failed_, other.failed_);
    return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
    // The file is removed while it is locked. Windows has no locks and cannot remove an open file.
    const auto close = [this] {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = -1;
    };
    if (!hasFileLocks()) close();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    temporary_.clear();
    unfinished_.forget();
    close();
    buffer_.clear();
}

Error AtomicFile::fail(int systemError) {
    if (failed_ == 0) failed_ = systemError;
    discard();
    return cannotWrite(path_, failed_);
}

Result<void> AtomicFile::writeThrough(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kMaxWriteBytes));
        if (written < 0) {
            if (errno == EINTR) continue;
            return fail(errno);
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

Result<void> AtomicFile::flush() {
    auto done = writeThrough(buffer_);
    buffer_.clear();
    return done;
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
    if (descriptor_ < 0) return fail(failed_ != 0 ? failed_ : EBADF);
    size_ += bytes.size();
    if (buffer_.size() + bytes.size() > kBufferBytes)
        if (auto flushed = flush(); !flushed) return flushed;
    if (bytes.size() >= kBufferBytes) return writeThrough(bytes);
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    return {};
}

Result<void> AtomicFile::write(std::string_view text) {
    return write(std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> AtomicFile::writeZeros(std::uint64_t count) {
    static constexpr std::byte kZeros[4096]{};
    while (count > 0) {
        const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(count, sizeof(kZeros)));
        SVT_DO(write(std::span(kZeros, piece)));
        count -= piece;
    }
    return {};
}

Result<std::uint64_t> AtomicFile::commit(Durability durability) {
    if (descriptor_ < 0) return fail(failed_ != 0 ? failed_ : EBADF);
    SVT_DO(flush());
    const bool isDirect = temporary_.empty();
    // Without fsync, a crash after the rename could leave an empty file in place of the old one.
    if (!isDirect && durability == Durability::Synced && ::fsync(descriptor_) != 0) return fail(errno);
    const auto close = [this] {
        return descriptor_ < 0 || ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR;
    };
    // Renamed while it is locked: without the lock another writer would take it for a leftover and remove it.
    if ((isDirect || !hasFileLocks()) && !close()) return fail(errno);
    if (!isDirect && ::rename(temporary_.c_str(), target_.c_str()) != 0) return fail(errno);
    temporary_.clear();
    unfinished_.forget();
    // After fsync, closing has nothing more to write, and the file has its name.
    close();
    return size_;
}

Result<std::uint64_t> writeFileAtomically(const fs::path& target, std::span<const std::span<const std::byte>> parts) {
    Result<AtomicFile> file = AtomicFile::create(target);
    if (!file) return file.error();
    for (const std::span<const std::byte> part : parts)
        if (auto written = file->write(part); !written) return written.error();
    return file->commit();
}

Result<std::uint64_t> writeFileAtomically(const fs::path& target, std::span<const std::byte> bytes) {
    return writeFileAtomically(target, std::span(&bytes, 1));
}

Result<std::uint64_t> writeFileAtomically(const fs::path& target, std::string_view text) {
    return writeFileAtomically(target, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace svt
