#include <svt/core/file/temporary_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#ifndef __EMSCRIPTEN__
#include <sys/file.h>
#endif

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace svt {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".svt-", kSuffix = ".tmp";

/// A name that no other writer uses; O_EXCL catches a remaining collision. Short, so that a long target name
/// does not exceed the length limit of file names.
std::string temporaryName() {
    static std::atomic<std::uint32_t> counter{0};
    const auto ticks = static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    return fmt::format("{}{:x}-{:x}-{:x}{}", kPrefix, static_cast<unsigned>(::getpid()), counter++, ticks, kSuffix);
}

/// Whether temporaryName() makes such names: three hexadecimal numbers.
bool isTemporaryName(std::string_view name) {
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return false;
    name.remove_prefix(kPrefix.size());
    name.remove_suffix(std::min(name.size(), kSuffix.size()));
    return std::count(name.begin(), name.end(), '-') == 2 && !name.starts_with('-') && !name.ends_with('-') &&
           name.find_first_not_of("0123456789abcdef-") == std::string_view::npos;
}

enum class Lock { Held, OfAnother, Impossible };

Lock tryLock([[maybe_unused]] int descriptor) noexcept {
#ifndef __EMSCRIPTEN__
    for (;;) {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Lock::Held;
        if (errno != EINTR) return errno == EWOULDBLOCK ? Lock::OfAnother : Lock::Impossible;
    }
#else
    return Lock::Impossible;
#endif
}

int openRetrying(const char* path, int flags, mode_t mode = 0) noexcept {
    for (;;) {
        const int descriptor = ::open(path, flags | O_CLOEXEC, mode);
        if (descriptor >= 0 || errno != EINTR) return descriptor;
    }
}

/// Whether `path` still names the open file: a writer may have renamed it since, or another process removed it.
bool isNameOf(const fs::path& path, int descriptor) noexcept {
    struct stat named {
    }, open{};
    return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 && S_ISREG(open.st_mode) &&
           named.st_dev == open.st_dev && named.st_ino == open.st_ino;
}

/// Whether this process writes into a folder for the first time.
bool isFirstWrite(const fs::path& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) return false;
    static std::mutex mutex;
    static std::set<std::tuple<std::string, std::uint64_t, std::uint64_t>> known;
    const std::lock_guard lock(mutex);
    // By name too: a new folder may have the number of one that was removed.
    return known
        .emplace(folder.string(), static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino))
        .second;
}

}  // namespace

bool hasFileLocks() noexcept {
#ifndef __EMSCRIPTEN__
    return true;
#else
    return false;
#endif
}

int openTemporaryFile(const fs::path& folder, TemporaryFile& file) {
    if (hasFileLocks())
        if (const fs::path at = folder.empty() ? fs::path(".") : folder; isFirstWrite(at)) removeLeftovers(at);
    for (;;) {
        fs::path path = folder / temporaryName();
        int descriptor = -1, reason = 0;
        Unfinished unfinished = Unfinished::path([&] {
            descriptor = openRetrying(path.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
            reason = errno;
            return descriptor < 0 ? fs::path() : path;
        });
        if (descriptor < 0 && reason == EEXIST) continue;
        if (descriptor < 0) return reason;
        // Between open() and the lock, removeLeftovers() of another writer may have found the file. Then the other
        // writer holds the lock or has removed the name, and this writer takes the next name.
        const Lock lock = tryLock(descriptor);
        if (lock == Lock::Impossible || (lock == Lock::Held && isNameOf(path, descriptor))) {
            file = {descriptor, std::move(path), std::move(unfinished)};
            return 0;
        }
        ::close(descriptor);
    }
}

std::size_t removeLeftovers(const fs::path& folder) {
    std::size_t removed = 0;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const fs::path& path = at->path();
        if (!isTemporaryName(path.filename().native())) continue;
        const int descriptor = openRetrying(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
        if (descriptor < 0) continue;
        // If the lock is held and the name is unchanged, the writer is gone and no other process uses the file.
        if (tryLock(descriptor) == Lock::Held && isNameOf(path, descriptor)) removed += ::unlink(path.c_str()) == 0;
        ::close(descriptor);
    }
    return removed;
}

}  // namespace svt
