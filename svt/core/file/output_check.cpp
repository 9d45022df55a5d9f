#include <svt/core/file.hpp>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

namespace svt {
namespace {

namespace fs = std::filesystem;

/// Less than any output needs.
constexpr std::uintmax_t kLeastSpace = std::uintmax_t{16} << 10;

Error cannotWriteTo(const fs::path& path, Code code, std::string message) {
    return Error(code, std::move(message), Place{path.string(), 0, 0, {}});
}

/// Bytes available to this user on the file system of `path`; kLeastSpace if unknown.
std::uintmax_t spaceLeft(const fs::path& path) {
    std::error_code error;
    const fs::path folder = withoutLinks(path).parent_path();
    const fs::space_info space = fs::space(folder.empty() ? fs::path(".") : folder, error);
    // File systems without files of their own, and some network file systems, report that they have no space at all.
    if (error || space.capacity == 0) return kLeastSpace;
    return ::geteuid() == 0 ? space.free : space.available;
}

}  // namespace

std::string fileIdentity(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        if (S_ISCHR(status.st_mode)) return {};
        // Not every file system under Node.js has inodes.
        if (status.st_ino != 0)
            return fmt::format("{}:{}", static_cast<std::uint64_t>(status.st_dev),
                               static_cast<std::uint64_t>(status.st_ino));
    }
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(withoutLinks(path), ignored), ignored).string();
}

Result<void> checkWritable(const fs::path& target) {
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
        // A pipe is not opened, because its reader would take the end of the check for the end of the file.
        if (::access(target.c_str(), W_OK) == 0) return {};
        return cannotWriteTo(target, Code::CannotWrite,
                             "no permission to write here; change the permissions or choose another name");
    }
    // Only an attempt shows whether permissions, read-only file systems and the like allow writing.
    SVT_DO(AtomicFile::create(target));
    if (const std::uintmax_t space = spaceLeft(target); space < kLeastSpace)
        return cannotWriteTo(
            target, Code::DiskFull,
            fmt::format("no space is left on the disk (only {} bytes); free some or choose another folder", space));
    return {};
}

Result<void> checkNoStream(const fs::path& target) {
    struct stat status {};
    if (::stat(target.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) return {};
    return cannotWriteTo(target, Code::CannotWrite,
                         "this is a pipe or device in the place of a file; remove it or choose another folder");
}

}  // namespace svt
