#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#ifndef __EMSCRIPTEN__
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#endif

namespace svt {

namespace fs = std::filesystem;

#ifdef __EMSCRIPTEN__

Unfinished Unfinished::path(const std::function<fs::path()>& make) {
    static_cast<void>(make());
    return {};
}
Unfinished Unfinished::process(const std::function<int()>& start) {
    static_cast<void>(start());
    return {};
}
void Unfinished::forget() noexcept {}
void cleanUpOnSignals() {}
int endProcess(int /*process*/) noexcept { return 0; }
void openStandardStreams() noexcept {}

#else

namespace {

struct Item {
    fs::path path;    // empty: a process
    int process = 0;  // 0: a path
};

// The unfinished paths and processes, and the thread that waits for a signal:
//
//     signal --> onSignal() --byte--> pipe --> watch(): lock, clean up, end
//
// The thread takes the mutex and never releases it, so that no other thread adds an item until the process ends.
struct Registry {
    std::mutex mutex;
    std::map<std::uint64_t, Item> items;
    std::array<int, 2> pipe{-1, -1};
    std::atomic<int> wake{-1};           // end of the pipe that signals write to; -1: no thread waits
    std::atomic<bool> isWatched{false};  // the thread has started, and holds no lock of the allocator
};

constexpr auto kTimeToEnd = std::chrono::seconds(5);

std::atomic<bool> isOn{false};
std::atomic<std::uint64_t> lastId{0};
std::atomic<Registry*> registry{nullptr};  // never destroyed, since signals may come at any time

// \return whether a thread cleans up; else the signal ends the process when its handler returns
bool wakeWatch(int signal) {
    const auto byte = static_cast<unsigned char>(signal);
    const int to = registry.load()->wake.load();
    if (to >= 0 && ::write(to, &byte, 1) == 1) return true;
    ::signal(signal, SIG_DFL);
    ::raise(signal);
    return false;
}

void onSignal(int signal) {
    const int error = errno;
    wakeWatch(signal);
    errno = error;
}

void onPipe(int signal, siginfo_t* info, void* /*context*/) {
    const int error = errno;
    const bool isOfThisThread = info->si_pid == ::getpid();
    // Otherwise the thread would continue with an error after its write, and exit before the signal ends the process.
    if (wakeWatch(signal) && isOfThisThread)
        for (;;) ::pause();
    errno = error;
}

void install(int signal) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) return;
    struct sigaction action {};
    action.sa_flags = SA_RESTART;
    if (signal == SIGPIPE) {
        action.sa_flags |= SA_SIGINFO;
        action.sa_sigaction = onPipe;
    } else {
        action.sa_handler = onSignal;
    }
    ::sigaction(signal, &action, nullptr);
}

void removePath(const fs::path& path) noexcept {
    // Other threads may still write into a folder.
    constexpr int kAttempts = 1000;
    std::error_code ignored;
    for (int attempt = 0; attempt < kAttempts && fs::symlink_status(path, ignored).type() != fs::file_type::not_found;
         ++attempt)
        fs::remove_all(path, ignored);
}

void watch(Registry& watched) {
    watched.isWatched = true;
    watched.isWatched.notify_all();
    unsigned char signal = 0;
    while (::read(watched.pipe[0], &signal, 1) < 0 && errno == EINTR) {
    }
    const std::lock_guard lock(watched.mutex);
    for (const auto& [id, item] : watched.items)
        if (item.process > 0) ::kill(item.process, SIGTERM);  // all at once, before each is waited for
    for (const auto& [id, item] : watched.items)
        if (item.process > 0) static_cast<void>(endProcess(item.process));
    for (auto item = watched.items.rbegin(); item != watched.items.rend(); ++item)
        if (item->second.process == 0) removePath(item->second.path);
    sigset_t one;
    ::sigemptyset(&one);
    ::sigaddset(&one, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    // Repeated in case another thread has just set a handler.
    for (;;) {
        ::signal(signal, SIG_DFL);
        ::kill(::getpid(), signal);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

// Requires the lock. The caller starts the thread before it creates anything, so a signal waits for the lock. Without a
// thread a signal ends the process at once, as it does by default.
void startWatching(Registry& own) noexcept {
    // The usual 8 MB would count against a limit of memory.
    constexpr std::size_t kStackBytes = std::size_t{512} << 10;
    if (own.wake >= 0 || (own.pipe[0] < 0 && ::pipe2(own.pipe.data(), O_CLOEXEC) != 0)) return;
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return;
    ::pthread_attr_setstacksize(&attributes, kStackBytes);
    ::pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    pthread_t thread{};
    const auto run = [](void* watched) -> void* {
        watch(*static_cast<Registry*>(watched));
        return nullptr;
    };
    if (::pthread_create(&thread, &attributes, run, &own) == 0) {
        own.wake = own.pipe[1];
        // A starting thread holds locks of the allocator. A copy of the process made meanwhile would never release
        // them.
        own.isWatched.wait(false);
    }
    ::pthread_attr_destroy(&attributes);
}

// A copy of the process has neither the thread nor a claim to the files of its parent, and its mutex may be locked.
void beginCopy() {
    for (const int end : registry.load()->pipe)
        if (end >= 0) ::close(end);
    registry = new Registry;
}

// Requires the lock.
std::uint64_t add(Registry& to, Item item) {
    const std::uint64_t id = ++lastId;
    to.items.emplace(id, std::move(item));
    return id;
}

}  // namespace

Unfinished Unfinished::path(const std::function<fs::path()>& make) {
    if (!isOn) {
        static_cast<void>(make());
        return {};
    }
    Registry& own = *registry;
    const std::lock_guard lock(own.mutex);
    startWatching(own);
    fs::path path = make();
    if (path.empty()) return {};
    std::error_code ignored;
    return Unfinished(add(own, {fs::absolute(path, ignored), 0}));
}

Unfinished Unfinished::process(const std::function<int()>& start) {
    if (!isOn) {
        static_cast<void>(start());
        return {};
    }
    Registry& own = *registry;
    const std::lock_guard lock(own.mutex);
    startWatching(own);
    const int process = start();
    return process > 0 ? Unfinished(add(own, {{}, process})) : Unfinished();
}

void Unfinished::forget() noexcept {
    if (id_ == 0) return;
    Registry& own = *registry;
    const std::lock_guard lock(own.mutex);
    own.items.erase(std::exchange(id_, 0));
}

void cleanUpOnSignals() {
    if (isOn) return;
    registry = new Registry;
    ::pthread_atfork(nullptr, nullptr, beginCopy);
    isOn = true;
    ::signal(SIGXFSZ, SIG_IGN);
    for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) install(signal);
}

int endProcess(int process) noexcept {
    ::kill(-process, SIGTERM);
    ::kill(process, SIGTERM);
    int status = SIGTERM;  // where another thread has waited for it
    const auto end = std::chrono::steady_clock::now() + kTimeToEnd;
    while (::waitpid(process, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() >= end) {
            ::kill(process, SIGKILL);
            ::waitpid(process, &status, 0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(-process, SIGKILL);  // its descendants
    return status;
}

void openStandardStreams() noexcept {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) {
            // The lowest number that is free: those below are open.
            if (::open("/dev/null", O_RDWR) < 0) return;
        }
}

#endif

}  // namespace svt
