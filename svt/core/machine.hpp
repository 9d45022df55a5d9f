#pragma once
/// \file
/// Facts from the operating system about the machine and the share of this process, work in a separate process, and
/// libraries that are loaded on first use. Values that a system does not provide (a browser, Node.js) are empty.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace svt {

/// Whether this build runs under a sanitizer of the compiler, which needs additional address space and time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kIsSanitized =
    __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kIsSanitized = false;
#endif

struct MemoryFigures {
    std::optional<std::uint64_t> totalBytes;      ///< of the machine
    std::optional<std::uint64_t> availableBytes;  ///< of the machine, without swapping
    std::optional<std::uint64_t> swapBytes;       ///< of the machine, in addition
    std::optional<std::uint64_t> limitBytes;      ///< of this process; only where it is below the total
    std::string limitedBy;  ///< "control group", "ulimit -v", "ulimit -d" or `by` of limitMemory(); empty: none
};
[[nodiscard]] MemoryFigures memoryFigures();

/// Memory that this process may take: its limit, or else all of the machine.
struct MemoryGrant {
    std::uint64_t bytes = 0;
    std::string text;  ///< "the 24.0 GB that the machine has", "the 300 MB that --memory grants"
};
/// \return the grant; empty where the system does not provide it
[[nodiscard]] std::optional<MemoryGrant> memoryGrant();

/// From now on, allocations fail (std::bad_alloc) if they would increase the data of this process beyond `bytes`. Files
/// of FileBytes::map() do not count. Under a sanitizer, which needs its own address space, only memoryFigures() reports
/// the limit.
/// \param by  source of the limit, for MemoryFigures::limitedBy
void limitMemory(std::uint64_t bytes, std::string_view by);

/// The same with the memory of the machine or the control group as the limit, including swap space and the possible
/// stacks of threads. Beyond it, the system would end this process or another one without a message. No effect if a
/// limit exists already, or under a sanitizer, which needs its own address space.
void limitMemoryToMachine();

/// Removes a limit of limitMemoryToMachine(), for third-party code that reserves much more than it uses (OpenGL
/// drivers).
void unlimitMemory();

/// "512 MB", "24.0 GB".
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

/// Number of cores of the machine. hardwareThreads() is the number that this process may use.
[[nodiscard]] std::optional<int> machineCores() noexcept;

/// Processor time that the control group (a container) grants this process, in cores, such as 1.5; empty: no limit.
[[nodiscard]] std::optional<double> grantedCores();

/// Bytes that this user may still write on the disk of `folder`.
[[nodiscard]] std::optional<std::uint64_t> freeBytes(const std::filesystem::path& folder);

/// Whether there is a desktop that windows can be opened on.
[[nodiscard]] std::optional<bool> hasDesktop() noexcept;

/// The folder with the settings of this user for all programs: $XDG_CONFIG_HOME if it is an absolute path, else
/// $HOME/.config; %APPDATA% on Windows. Empty where the system does not provide it.
[[nodiscard]] std::filesystem::path settingsFolder();

/// Whether an environment variable has a value that is not empty.
[[nodiscard]] bool isInEnvironment(const char* name) noexcept;

/// The file that runs when a program is started as `name`; empty: not in PATH.
[[nodiscard]] std::filesystem::path findProgram(std::string_view name);

/// The result of work in a separate process.
struct OwnProcessResult {
    std::string text;   ///< texts of Say, and output to stderr meanwhile; at most 64 KiB
    std::string fault;  ///< why the work did not complete, such as "ended by signal 11"; empty: it did
};
/// Hands a text to the process that waits.
using Say = std::function<void(std::string_view)>;

/// Does `work` in a copy of this process and waits for it, so that a crash or an endless loop in third-party code (a
/// graphics driver) ends only the copy. Texts handed over before that stay. Nothing is written to stdout. Requires that
/// this process has not started threads: the copy has only the calling thread, so parallelFor() there would wait for
/// the others forever. On systems without processes, the work is done in this process.
/// \param seconds  after this time the copy is ended
[[nodiscard]] OwnProcessResult inOwnProcess(double seconds, const std::function<void(const Say&)>& work);

/// For programs, at their start: HUP, INT, TERM and PIPE remove and end unfinished files and processes (Unfinished),
/// and then end this process as they do by default. Ignored signals stay ignored. Writing beyond the file size limit
/// (XFSZ) becomes an error of the write. No effect on systems without signals.
void cleanUpOnSignals();

/// Ends a child process and its group: SIGTERM, so that it can clean up, and SIGKILL after 5 s. Waits for its end.
/// \return its status as from waitpid()
int endProcess(int process) noexcept;

/// For programs, at their start: opens /dev/null for each of stdin, stdout and stderr that is closed. Otherwise the
/// first opened files would get their numbers, and receive messages.
void openStandardStreams() noexcept;

/// A shared library that is loaded on first use, for functions that few runs need but that would slow down the start of
/// all runs. Never unloaded, so pointers into it stay valid.
class SharedLibrary {
public:
    /// \param name  as the loader of the system expects it, such as "libproj.so.25"
    /// \return CannotOpen if the library is missing, or if the system cannot load libraries
    [[nodiscard]] static Result<SharedLibrary> load(const std::string& name);

    /// Sets `function` to the function with this name.
    /// \return whether the library has it; its type is not checked
    template <typename Function>
    bool find(const char* name, Function*& function) const {
        function = reinterpret_cast<Function*>(symbol(name));
        return function != nullptr;
    }

private:
    explicit SharedLibrary(void* handle) : handle_(handle) {}
    [[nodiscard]] void* symbol(const char* name) const noexcept;
    void* handle_;
};

/// Allows this process to open `more` additional files, as far as the system permits. If that is not enough, opening a
/// file fails with CannotOpen. No effect on systems without such a limit.
void allowMoreOpenFiles(std::size_t more) noexcept;

/// Returns memory that was freed in small pieces to the system; otherwise the C library keeps it. Call it after large
/// structures of many small parts were freed, before other large structures are made. Cost: milliseconds per GB. No
/// effect on systems without such a call.
void returnFreeMemory() noexcept;

}  // namespace svt
