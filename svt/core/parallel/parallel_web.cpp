// Replaces parallel_tbb.cpp in builds for WebAssembly. The same object files become a module with threads and one
// without, but std::thread exists only in a module that is linked with threads. So this source uses only POSIX calls,
// which exist in both. Without threads, pthread_create() fails, and the caller does all the work.
//
// A browser starts threads late, when the main thread of the page is idle again. So no thread waits for a helper to
// start: each running thread takes ranges, and the caller waits only for the ranges in progress.
#include <svt/core/parallel.hpp>

#include <emscripten/threading.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <new>

namespace svt {
namespace {

using Body = std::function<void(std::size_t, std::size_t)>;

constexpr int kMaxThreads = 8;

struct Loop {
    const Body& body;
    std::size_t count, grain, ranges;
    std::atomic<std::size_t> next{0};
    std::atomic<bool> hasFailed{false};
    int helpers;      // that may still join
    int working = 0;  // helpers that have joined and not left
};

thread_local bool isInLoop = false;

void work(Loop& loop) noexcept {
    isInLoop = true;
    try {
        for (std::size_t range = loop.next++; range < loop.ranges && !loop.hasFailed; range = loop.next++)
            loop.body(range * loop.grain, std::min(loop.count, (range + 1) * loop.grain));
    } catch (...) {  // no memory: the only exception that leaves the library
        loop.hasFailed = true;
    }
    isInLoop = false;
}

class Helpers {
public:
    // Waits for loops that need help, and never returns.
    [[noreturn]] void help() {
        pthread_mutex_lock(&mutex_);
        while (true) {
            while (loop_ == nullptr || loop_->helpers == 0) pthread_cond_wait(&begins_, &mutex_);
            Loop& loop = *loop_;
            --loop.helpers;
            ++loop.working;
            pthread_mutex_unlock(&mutex_);
            work(loop);
            pthread_mutex_lock(&mutex_);
            if (--loop.working == 0) pthread_cond_signal(&ends_);
        }
    }

    void run(Loop& loop) {
        start();
        pthread_mutex_lock(&mutex_);
        loop_ = &loop;
        pthread_mutex_unlock(&mutex_);
        if (loop.helpers > 0) pthread_cond_broadcast(&begins_);
        work(loop);
        pthread_mutex_lock(&mutex_);
        loop_ = nullptr;
        while (loop.working > 0) pthread_cond_wait(&ends_, &mutex_);
        pthread_mutex_unlock(&mutex_);
    }

    void start() {
        if (isStarted_) return;
        isStarted_ = true;
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
        for (int n = 1; n < hardwareThreads(); ++n) {
            pthread_t thread;
            const auto begin = [](void* helpers) -> void* { static_cast<Helpers*>(helpers)->help(); };
            if (pthread_create(&thread, &attributes, begin, this) != 0) break;
        }
        pthread_attr_destroy(&attributes);
    }

private:
    pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
    pthread_cond_t begins_ = PTHREAD_COND_INITIALIZER, ends_ = PTHREAD_COND_INITIALIZER;
    Loop* loop_ = nullptr;
    bool isStarted_ = false;
};

Helpers& helpers() {
    static Helpers one;
    return one;
}

}  // namespace

void parallelFor(std::size_t count, std::size_t grain, int threads, const Body& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t ranges = (count + grain - 1) / grain;
    const int wanted = threads > 0 ? std::min(threads, hardwareThreads()) : hardwareThreads();
    if (ranges == 1 || wanted == 1 || isInLoop) {
        body(0, count);
        return;
    }
    Loop loop{.body = body, .count = count, .grain = grain, .ranges = ranges, .helpers = wanted - 1};
    helpers().run(loop);
    if (loop.hasFailed) throw std::bad_alloc();
}

int hardwareThreads() noexcept {
    static const int cores =
        emscripten_has_threading_support() ? std::clamp(emscripten_num_logical_cores(), 1, kMaxThreads) : 1;
    return cores;
}

}  // namespace svt
