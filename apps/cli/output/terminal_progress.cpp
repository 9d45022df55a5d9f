#include <apps/cli/output/terminal_progress.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#ifndef __EMSCRIPTEN__
#include <condition_variable>
#include <thread>
#endif

namespace svt::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFirstSeconds = 1;
constexpr auto kInterval = std::chrono::milliseconds(200);

std::atomic<bool>* interruptTarget = nullptr;
void (*formerHandler)(int) = SIG_DFL;

void onInterrupt(int) {
    if (interruptTarget != nullptr) interruptTarget->store(true);
    std::signal(SIGINT, formerHandler);  // a second Ctrl-C ends the program
}

// Handles Ctrl-C, unless the process ignores it as a background job of a shell.
void takeInterrupts() {
    formerHandler = std::signal(SIGINT, SIG_IGN);
    if (formerHandler != SIG_IGN) std::signal(SIGINT, onInterrupt);
}

double secondsSince(Clock::time_point time) { return std::chrono::duration<double>(Clock::now() - time).count(); }

std::string durationText(double seconds) {
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

// Calls a function every kInterval until it is destroyed. WebAssembly has no threads; there, reports draw the line.
#ifndef __EMSCRIPTEN__
class Ticker {
public:
    explicit Ticker(std::function<void()> tick)
        : thread_([this, tick = std::move(tick)] {
              std::unique_lock lock(mutex_);
              while (!end_.wait_for(lock, kInterval, [this] { return isEnded_; })) tick();
          }) {}
    ~Ticker() {
        {
            const std::lock_guard lock(mutex_);
            isEnded_ = true;
        }
        end_.notify_all();
        thread_.join();
    }

private:
    std::mutex mutex_;
    std::condition_variable end_;
    bool isEnded_ = false;
    std::thread thread_;  // last, because it uses the others
};
constexpr bool hasTicker = true;
#else
struct Ticker {
    explicit Ticker(const std::function<void()>& /*tick*/) {}
};
constexpr bool hasTicker = false;
#endif

}  // namespace

class TerminalProgress::Line {
public:
    explicit Line(const std::atomic<bool>& isCancelled) : isCancelled_(isCancelled) { current = this; }

    ~Line() {
        ticker_.reset();
        current = nullptr;
        erase();
    }

    void report(std::string_view stage, double fraction) {
        const std::lock_guard lock(mutex_);
        if (stage != stage_) {
            stage_ = stage;
            stageStart_ = Clock::now();
        }
        fraction_ = (part_ + std::clamp(fraction, 0.0, 1.0)) / parts_;
        if (!hasTicker && Clock::now() - drawn_ >= kInterval) draw();
    }

    void beginPart(int index, int count) {
        const std::lock_guard lock(mutex_);
        part_ = index;
        parts_ = count;
    }

    void hide() {
        const std::lock_guard lock(mutex_);
        erase();
    }

    static Line* current;

private:
    void draw() {
        constexpr int kWidth = 24;
        constexpr double kLeastShare = 0.01, kLeastSeconds = 1;
        if (secondsSince(start_) < kFirstSeconds) return;
        drawn_ = Clock::now();
        const double seconds = secondsSince(stageStart_);
        std::string text = fmt::format("{:<9} ", isCancelled_ ? "stopping" : stage_);
        if (fraction_ > 0) {
            const int full = static_cast<int>(fraction_ * kWidth);
            text += fmt::format("[{:#<{}}{:{}}] {:3.0f} %  ", "", full, "", kWidth - full, fraction_ * 100);
        }
        text += durationText(seconds);
        if (fraction_ >= kLeastShare && fraction_ < 1 && seconds >= kLeastSeconds)
            text += fmt::format(", {} left", durationText(seconds * (1 - fraction_) / fraction_));
        std::fputs(fmt::format("\r{:<{}}", text, width_).c_str(), stderr);  // never throws, as fmt::print() does
        std::fflush(stderr);
        width_ = text.size();
    }

    void erase() {
        if (width_ == 0) return;
        std::fputs(fmt::format("\r{:{}}\r", "", width_).c_str(), stderr);
        std::fflush(stderr);
        width_ = 0;
    }

    const std::atomic<bool>& isCancelled_;
    std::mutex mutex_;
    std::string stage_ = "read";
    double fraction_ = 0;
    int part_ = 0, parts_ = 1;
    Clock::time_point start_ = Clock::now(), stageStart_ = start_, drawn_ = start_;
    std::size_t width_ = 0;  // of the text on the terminal
    std::optional<Ticker> ticker_{std::in_place, [this] {
                                      const std::lock_guard lock(mutex_);
                                      draw();
                                  }};
};

TerminalProgress::Line* TerminalProgress::Line::current = nullptr;

TerminalProgress::TerminalProgress() {
    interruptTarget = &progress_.cancel;
    takeInterrupts();
    if (!isErrorTerminal() || isQuiet()) return;
    line_ = std::make_unique<Line>(progress_.cancel);
    progress_.report = [this](std::string_view stage, double fraction) { line_->report(stage, fraction); };
}

TerminalProgress::~TerminalProgress() {
    std::signal(SIGINT, formerHandler);
    interruptTarget = nullptr;
}

void TerminalProgress::beginPart(int index, int count) {
    if (line_) line_->beginPart(index, count);
}

void TerminalProgress::hide() {
    if (Line::current != nullptr) Line::current->hide();
}

}  // namespace svt::cli
