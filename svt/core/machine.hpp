#pragma once
/// \file
/// What the operating system tells of the machine and of this process's share of it, work in a process of its own, and
/// libraries that are loaded when they are first needed.
/// Where a system does not tell (a browser, Node.js), a value is empty.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace svt {

/// Whether a sanitizer of the compiler watches this build. It takes address space and time of its own.
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
    std::string limitedBy;  ///< "control group", "ulimit -v", "ulimit -d" or what limitMemory() was told; empty: none
};
[[nodiscard]] MemoryFigures memoryFigures();

/// Memory that this process may take: its limit, or else all of the machine.
struct MemoryGrant {
    std::uint64_t bytes = 0;
    std::string text;  ///< "the 24.0 GB that the machine has", "the 300 MB that --memory grants"
};
/// \return what is granted; empty where a system does not tell
[[nodiscard]] std::optional<MemoryGrant> memoryGrant();

/// From now on allocations fail (std::bad_alloc) that would take the data of this process beyond `bytes`. Files of
/// FileBytes::map() do not count. Where a sanitizer watches, which takes address space of its own, only memoryFigures() reports it.
/// \param by  what set the limit, for MemoryFigures::limitedBy
void limitMemory(std::uint64_t bytes, std::string_view by);

/// The same at what the machine or a control group has, with swap space and what the stacks of threads may take: past it
/// the system would end this process without a word, or another one. Does nothing under a limit that is there, and where
/// a sanitizer watches, which takes address space of its own.
void limitMemoryToMachine();

/// Takes a limit of limitMemoryToMachine() back, for code of others that reserves much more than it uses (OpenGL
/// drivers).
void unlimitMemory();

/// "512 MB", "24.0 GB".
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

/// How many cores the machine has. See hardwareThreads() for how many of them this process may use.
[[nodiscard]] std::optional<int> machineCores() noexcept;

/// How many cores' worth of time the control group (a container) grants this process, such as 1.5; empty: no limit.
[[nodiscard]] std::optional<double> grantedCores();

/// Bytes that this user may still write on the disk of `folder`.
[[nodiscard]] std::optional<std::uint64_t> freeBytes(const std::filesystem::path& folder);

/// Whether there is a desktop that windows can be opened on.
[[nodiscard]] std::optional<bool> hasDesktop() noexcept;

/// The file that is run when a program is started by `name`; empty: there is none in PATH.
[[nodiscard]] std::filesystem::path findProgram(std::string_view name);

/// How work in a process of its own ended.
struct OwnProcessResult {
    std::string text;   ///< what it said, and what was written to stderr meanwhile; at most 64 KiB
    std::string fault;  ///< why it did not come to its end, such as "ended by signal 11"; empty: it did
};
/// Hands a text to the process that waits.
using Say = std::function<void(std::string_view)>;

/// Does `work` in a copy of this process and waits for it, so that a crash or an endless loop in code of others (a
/// graphics driver) ends the copy alone. What was said before stays. Nothing is written to stdout.
/// Requires that this process has not started threads: the copy has but the calling one, so parallelFor() there would
/// wait for the others forever. On systems without processes the work is done in this one.
/// \param seconds  after this time the copy is ended
[[nodiscard]] OwnProcessResult inOwnProcess(double seconds, const std::function<void(const Say&)>& work);

/// For programs, at their start: HUP, INT, TERM and PIPE remove and end what is unfinished, and then end this process
/// as they do by default. Signals that are ignored stay so. Writing beyond the file size limit (XFSZ) becomes an error of
/// the write. No effect on systems without signals.
void cleanUpOnSignals();

/// Ends a child process and its group: SIGTERM, so that it can clean up, and SIGKILL after 5 s. Waits for its end.
/// \return its status as waitpid() has it
int endProcess(int process) noexcept;

/// For programs, at their start: opens /dev/null for each of stdin, stdout and stderr that is closed. Else the first
/// files that are opened would take their numbers, and receive messages.
void openStandardStreams() noexcept;

/// A shared library that is loaded when it is first needed, for what few runs need and all would pay for at their start.
/// Stays loaded until the process ends: what others keep of it stays valid.
class SharedLibrary {
public:
    /// \param name  as the system's loader knows it, such as "libproj.so.25"
    /// \return CannotOpen where there is none, or a system loads none
    [[nodiscard]] static Result<SharedLibrary> load(const std::string& name);

    /// Sets `function` to the function of that name.
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

/// Memory that was freed in small pieces goes back to the system, where the C library keeps it otherwise. After large
/// structures of many small parts were freed, before other large ones are made. Cost: milliseconds for each GB.
/// No effect on systems without such a call.
void returnFreeMemory() noexcept;

}  // namespace svt
