#include <svt/core/machine.hpp>

#include <svt/core/machine/control_group.hpp>
#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace svt {
namespace {

namespace fs = std::filesystem;

// Linux as far as controlGroupLimits() reads it.
class ControlGroups : public ::testing::Test {
protected:
    void write(const std::string& file, const std::string& text) {
        fs::create_directories((folder / file).parent_path());
        test::writeText(folder / file, text);
    }
    test::TemporaryFolder folder;
};

TEST_F(ControlGroups, WithoutFilesThereIsNoLimit) {
    const ControlGroupLimits limits = controlGroupLimits(folder.path());
    EXPECT_FALSE(limits.memoryBytes || limits.cores);
}

TEST_F(ControlGroups, OfVersion2AreReadUpToTheTop) {
    write("proc/self/cgroup", "0::/user/svt\n");
    write("sys/fs/cgroup/user/svt/memory.max", "max\n");
    write("sys/fs/cgroup/user/svt/cpu.max", "150000 100000\n");
    write("sys/fs/cgroup/user/memory.max", "1000000\n");
    write("sys/fs/cgroup/user/cpu.max", "max 100000\n");
    write("sys/fs/cgroup/memory.max", "2000000\n");
    const ControlGroupLimits limits = controlGroupLimits(folder.path());
    EXPECT_EQ(limits.memoryBytes, 1000000u);
    EXPECT_EQ(limits.cores, 1.5);
}

TEST_F(ControlGroups, OfVersion1AreReadByController) {
    write("proc/self/cgroup", "12:cpu,cpuacct:/docker/1\n4:memory:/docker/1\n1:name=systemd:/docker/1\n");
    // A container sees its own group at the top, under the path that the host gives it.
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "3000000\n");
    write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "50000\n");
    write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    const ControlGroupLimits limits = controlGroupLimits(folder.path());
    EXPECT_EQ(limits.memoryBytes, 3000000u);
    EXPECT_EQ(limits.cores, 0.5);
}

TEST_F(ControlGroups, OfVersion1MayBeWithoutLimit) {
    write("proc/self/cgroup", "not a group\n2:cpu:/\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_FALSE(controlGroupLimits(folder.path()).cores);
}

TEST(Machine, TellsMemoryAndCores) {
    const MemoryFigures memory = memoryFigures();
    if (!memory.totalBytes) GTEST_SKIP() << "this system does not tell";
    EXPECT_GT(*memory.totalBytes, std::uint64_t{1} << 20);
    ASSERT_TRUE(memory.availableBytes);
    EXPECT_LE(*memory.availableBytes, *memory.totalBytes);
    EXPECT_EQ(memory.limitBytes.has_value(), !memory.limitedBy.empty());
    if (memory.limitBytes) {
        EXPECT_LT(*memory.limitBytes, *memory.totalBytes);
    }
    ASSERT_TRUE(machineCores());
    EXPECT_GE(*machineCores(), 1);
}

TEST(Machine, TellsFreeBytesOfADiskThatExists) {
    const test::TemporaryFolder folder;
    EXPECT_GT(freeBytes(folder.path()).value_or(0), 0u);
    EXPECT_FALSE(freeBytes(folder / "missing"));
}

TEST(Machine, FindsProgramsInThePath) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "a/folder");
    fs::create_directories(folder / "b");
    test::writeText(folder / "a/text", "");
    test::writeText(folder / "b/program", "#!/bin/sh\n");
    fs::permissions(folder / "b/program", fs::perms::owner_all);
    const std::string before = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
    ::setenv("PATH", ((folder / "a").string() + ":" + (folder / "b").string()).c_str(), 1);
    const fs::path program = findProgram("program"), text = findProgram("text"), other = findProgram("folder");
    ::setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(program, folder / "b/program");
    EXPECT_EQ(text, "") << "cannot be run";
    EXPECT_EQ(other, "") << "is a folder";
}

// Allocates bytes that are not optimised away. False: there is no memory.
bool canTake(std::size_t bytes) {
    try {
        std::vector<char> memory(bytes, 'x');
        volatile char last = memory[bytes - 1];
        return last == 'x';
    } catch (const std::bad_alloc&) {
        return false;
    }
}

// Sets an environment variable while it lives.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
    }
    ~Environment() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(Machine, SettingsAreInTheFolderOfTheUser) {
    const Environment home("HOME", "/home/user"), windows("APPDATA", nullptr);
    {
        const Environment settings("XDG_CONFIG_HOME", "/settings");
        EXPECT_EQ(settingsFolder(), "/settings");
    }
    for (const char* invalid : {static_cast<const char*>(nullptr), "", "relative"}) {
        const Environment settings("XDG_CONFIG_HOME", invalid);
        EXPECT_EQ(settingsFolder(), "/home/user/.config");
        const Environment noHome("HOME", nullptr);
        EXPECT_EQ(settingsFolder(), "");
    }
    const Environment settings("XDG_CONFIG_HOME", nullptr), drive("APPDATA", "C:/Users/a/AppData");
    EXPECT_EQ(settingsFolder(), "C:/Users/a/AppData");
}

TEST(Machine, EmptyVariablesAreNotInTheEnvironment) {
    const Environment empty("SVT_TEST_EMPTY", ""), full("SVT_TEST_FULL", "0"), none("SVT_TEST_NONE", nullptr);
    EXPECT_FALSE(isInEnvironment("SVT_TEST_EMPTY"));
    EXPECT_TRUE(isInEnvironment("SVT_TEST_FULL"));
    EXPECT_FALSE(isInEnvironment("SVT_TEST_NONE"));
}

TEST(LimitMemory, AllocationsBeyondItFailAndThoseBelowDoNot) {
    const auto result = inOwnProcess(600, [](const Say& say) {
        constexpr std::size_t kMb = 1'000'000;
        say(canTake(900 * kMb) ? "before " : "none ");
        limitMemory(600 * kMb, "--memory");
        const MemoryFigures figures = memoryFigures();
        say(figures.limitBytes == 600 * kMb && figures.limitedBy == "--memory" ? "told " : "untold ");
        const auto grant = memoryGrant();
        say(grant && grant->text == "the 600 MB that --memory grants" ? "granted " : "not granted ");
        say(canTake(200 * kMb) ? "little " : "too little ");
        say(canTake(900 * kMb) ? "too much" : "no more");
    });
    if (result.text.find("none") == 0) GTEST_SKIP() << "this machine grants less than 900 MB";
    EXPECT_EQ(result.fault, "");
    EXPECT_EQ(result.text, std::string("before told granted little ") + (kIsSanitized ? "too much" : "no more"));
}

TEST(AllowMoreOpenFiles, RaisesTheLimitAsFarAsTheSystemAllows) {
    const auto result = inOwnProcess(600, [](const Say& say) {
        const rlimit before{64, 200};
        if (::setrlimit(RLIMIT_NOFILE, &before) != 0) return;
        for (const std::size_t more : {std::size_t{0}, std::size_t{100}, std::size_t{37}, ~std::size_t{0}}) {
            allowMoreOpenFiles(more);
            rlimit now{};
            ::getrlimit(RLIMIT_NOFILE, &now);
            say(std::to_string(now.rlim_cur) + " ");
        }
    });
    EXPECT_EQ(result.fault, "");
    EXPECT_EQ(result.text, "64 164 200 200 ");
}

TEST(InOwnProcess, TellsWhatWasSaidAndWrittenToStderr) {
    const auto result = inOwnProcess(600, [](const Say& say) {
        say("one\n");
        std::fputs("two\n", stderr);
        std::fputs("not this", stdout);
        std::fflush(stdout);
    });
    EXPECT_EQ(result.text, "one\ntwo\n");
    EXPECT_EQ(result.fault, "");
}

TEST(InOwnProcess, ACrashEndsTheCopyAlone) {
    const auto result = inOwnProcess(600, [](const Say& say) {
        say("before");
        std::raise(SIGKILL);
        say("after");
    });
    EXPECT_EQ(result.text, "before");
    EXPECT_EQ(result.fault, "ended by signal 9");
}

TEST(InOwnProcess, WhatHangsIsEnded) {
    const auto hang = [](double seconds) {
        return inOwnProcess(seconds, [](const Say& say) {
            say("before");
            std::this_thread::sleep_for(std::chrono::hours(24));
        });
    };
    auto result = hang(0.2);
    EXPECT_EQ(result.fault, "no answer within 0.2 s");
    // A busy machine may not come to the first word in that time.
    if (result.text.empty()) result = hang(60);
    EXPECT_EQ(result.text, "before");
}

TEST(InOwnProcess, ExceptionsDoNotLeave) {
    const auto result = inOwnProcess(600, [](const Say&) { throw std::runtime_error("x"); });
    EXPECT_EQ(result.fault, "ended with code 1");
}

TEST(InOwnProcess, TextIsBounded) {
    const auto result = inOwnProcess(600, [](const Say& say) { say(std::string(1 << 20, 'x')); });
    EXPECT_EQ(result.text.size(), std::size_t{64} * 1024);
    EXPECT_EQ(result.fault, "");
}

}  // namespace
}  // namespace svt
