#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <system_error>
#include <vector>

namespace svt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStreamBuffer = std::size_t{1} << 18;

Error stdinError(Code code, std::string message) { return {code, std::move(message), {"stdin", 0, 0, {}}}; }

// Reads bytes of stdin; 0 at its end, or -1 with errno. Waits if another program made the stream non-blocking.
::ssize_t readStdin(std::vector<std::byte>& to) {
    for (;;) {
        const ::ssize_t got = ::read(STDIN_FILENO, to.data(), to.size());
        if (got >= 0) return got;
        if (errno == EAGAIN) {
            pollfd wait{STDIN_FILENO, POLLIN, 0};
            ::poll(&wait, 1, -1);
        } else if (errno != EINTR) {
            return got;
        }
    }
}

}  // namespace

fs::path stdinAsFile() {
#ifndef __EMSCRIPTEN__
    struct stat status {};
    if (::fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode) && ::lseek(STDIN_FILENO, 0, SEEK_CUR) == 0)
        return "/dev/stdin";
#endif
    return {};
}

Result<std::uint64_t> saveStdin(const fs::path& to, std::uint64_t maxBytes) {
    SVT_TRY(file, AtomicFile::create(to));
    std::vector<std::byte> buffer(kStreamBuffer);
    for (;;) {
        const ::ssize_t got = readStdin(buffer);
        if (got < 0)
            return stdinError(Code::CannotOpen, "stdin cannot be read: " + std::generic_category().message(errno));
        if (got == 0) return file->commit(AtomicFile::Durability::Temporary);
        const auto size = static_cast<std::size_t>(got);
        if (size > maxBytes - file->size())
            return stdinError(Code::InputTooBig,
                              fmt::format("stdin has more than {}, the limit; a higher --max-input permits more, and "
                                          "files have no such limit",
                                          bytesText(maxBytes)));
        SVT_DO(file->write(std::span(buffer).first(size)));
    }
}

}  // namespace svt
