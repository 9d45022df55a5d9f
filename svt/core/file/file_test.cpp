#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <string>
#include <svt/core/file.hpp>
#include <svt/core/file/temporary_file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <thread>
#include <vector>

namespace svt {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::TemporaryFolder;
using test::writeText;

bool mentions(const Error& error, std::string_view words) { return error.toString().find(words) != std::string::npos; }

TEST(FileBytes, ShowsTheBytesOfTheFile) {
    const TemporaryFolder folder;
    writeText(folder / "a", std::string("one\0two", 7));
    auto file = FileBytes::read(folder / "a");
    ASSERT_TRUE(file) << file.error().toString();
    EXPECT_EQ(file->text(), std::string_view("one\0two", 7));
    EXPECT_EQ(file->bytes().size(), 7u);
}

TEST(FileBytes, MovingKeepsTheBytes) {
    const TemporaryFolder folder;
    writeText(folder / "a", "first");
    writeText(folder / "b", "second");
    auto a = FileBytes::read(folder / "a");
    auto b = FileBytes::read(folder / "b");
    ASSERT_TRUE(a && b);
    FileBytes moved = std::move(*a);
    EXPECT_EQ(moved.text(), "first");
    moved = std::move(*b);
    EXPECT_EQ(moved.text(), "second");
}

TEST(FileBytes, KeepsItsBytesWhereTheFileIsShortened) {
    const TemporaryFolder folder;
    const std::string text(1 << 20, 'x');
    writeText(folder / "a", text);
    const auto file = FileBytes::read(folder / "a");
    ASSERT_TRUE(file);
    fs::resize_file(folder / "a", 0);
    EXPECT_EQ(file->text(), text);
}

TEST(FileBytes, ASizeThatChangesWhileItIsReadIsAnErrorAndNoSignal) {
    const TemporaryFolder folder;
    const std::string text(4 << 20, 'x');
    writeText(folder / "a", text);
    std::atomic<bool> isDone{false};
    std::thread writer([&] {
        while (!isDone)
            for (const std::size_t size : {std::size_t{100}, text.size()}) fs::resize_file(folder / "a", size);
    });
    for (int i = 0; i < 200; ++i) {
        const auto file = FileBytes::read(folder / "a");
        if (file)
            EXPECT_TRUE(file->bytes().size() == 100 || file->bytes().size() == text.size());
        else
            EXPECT_TRUE(mentions(file.error(), "E101 CannotOpen") && mentions(file.error(), "changed while"))
                << file.error().toString();
    }
    isDone = true;
    writer.join();
}

TEST(FileBytes, MapsAsItReads) {
    const TemporaryFolder folder;
    writeText(folder / "a", "text");
    writeText(folder / "empty", "");
    auto file = FileBytes::map(folder / "a");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->text(), "text");
    auto read = FileBytes::read(folder / "empty");
    ASSERT_TRUE(read);
    std::swap(*file, *read);
    EXPECT_EQ(read->text(), "text");
    EXPECT_TRUE(file->bytes().empty());
    EXPECT_EQ(FileBytes::map(folder / "a", 3).error().code(), Code::InputTooBig);
    EXPECT_EQ(FileBytes::map(folder / "b").error().code(), Code::CannotOpen);
}

TEST(PartFile, ReadsPartsAsFarAsTheFileGoes) {
    const TemporaryFolder folder;
    writeText(folder / "a", "0123456789");
    auto opened = PartFile::open(folder / "a");
    ASSERT_TRUE(opened);
    const PartFile file = std::move(*opened);
    EXPECT_EQ(file.size(), 10u);
    EXPECT_EQ(*file.read(3, 4), "3456");
    EXPECT_EQ(*file.read(8, 4), "89");
    EXPECT_EQ(*file.read(10, 1), "");
    EXPECT_EQ(*file.read(~std::uint64_t{0}, 1), "");
    fs::resize_file(folder / "a", 5);
    EXPECT_EQ(*file.read(3, 4), "34") << "what is cut off is missing";
    EXPECT_FALSE(PartFile::open(folder / "b"));
    EXPECT_FALSE(PartFile::open(folder.path()));
}

TEST(PartFile, WhatIsCutOffIsAnErrorWhereAllIsAskedFor) {
    const TemporaryFolder folder;
    writeText(folder / "a", "0123456789");
    const auto file = PartFile::open(folder / "a");
    ASSERT_TRUE(file);
    EXPECT_EQ(*file->readAll(3, 4), "3456");
    EXPECT_EQ(*file->readAll(8, 4), "89") << "the file never had more";
    EXPECT_EQ(*file->readAll(10, 1), "");
    EXPECT_EQ(*file->readAll(~std::uint64_t{0}, 1), "");
    fs::resize_file(folder / "a", 5);
    EXPECT_EQ(*file->readAll(1, 4), "1234");
    for (const std::uint64_t offset : {3, 5, 9}) {
        const auto cut = file->readAll(offset, 4);
        ASSERT_FALSE(cut) << offset;
        EXPECT_EQ(cut.error().code(), Code::CannotOpen);
        EXPECT_EQ(cut.error().where().file, (folder / "a").string());
        EXPECT_TRUE(mentions(cut.error(), "shortened")) << cut.error().toString();
    }
}

TEST(PartFile, SeesChangesInPlaceAndNoReplacement) {
    const TemporaryFolder folder;
    using std::chrono::hours;
    const auto change = [&](const std::string& text, int after) {
        writeText(folder / "a", text);
        fs::last_write_time(folder / "a", fs::file_time_type::clock::now() + hours(after));
    };
    for (const std::string text : {"", "012345678", "9876543210", "01234567890"}) {
        change("0123456789", 0);
        const auto file = PartFile::open(folder / "a");
        ASSERT_TRUE(file);
        EXPECT_TRUE(file->checkUnchanged());
        change(text, 1);
        const auto changed = file->checkUnchanged();
        ASSERT_FALSE(changed) << text;
        EXPECT_EQ(changed.error().code(), Code::CannotOpen);
        EXPECT_EQ(changed.error().where().file, (folder / "a").string());
    }
    const auto file = PartFile::open(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(writeFileAtomically(folder / "a", "second"));
    EXPECT_TRUE(file->checkUnchanged());
}

TEST(PartFile, KeepsAFileThatIsReplaced) {
    const TemporaryFolder folder;
    writeText(folder / "a", "first");
    const auto file = PartFile::open(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(writeFileAtomically(folder / "a", "second"));
    EXPECT_EQ(*file->read(0, 10), "first");
}

TEST(FileBytes, EmptyFileIsAnEmptySpan) {
    const TemporaryFolder folder;
    writeText(folder / "empty", "");
    auto file = FileBytes::read(folder / "empty");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->bytes().empty());
}

TEST(FileBytes, SaysWhyItCannotOpen) {
    const TemporaryFolder folder;
    writeText(folder / "file", "x");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const struct {
        fs::path path;
        const char* reason;
    } cases[] = {
        {folder / "absent", "does not exist"},
        {folder.path(), "is a folder"},
        {folder / "file" / "below", "is a file, not a folder"},
        {folder / "pipe", "pipe or device"},
        {"/dev/zero", "pipe or device"},
    };
    for (const auto& c : cases) {
        auto file = FileBytes::read(c.path);
        ASSERT_FALSE(file) << c.path;
        EXPECT_EQ(file.error().code(), Code::CannotOpen);
        EXPECT_EQ(file.error().where().file, c.path.string());
        EXPECT_TRUE(mentions(file.error(), c.reason)) << file.error().toString();
    }
}

TEST(FileBytes, SaysThatPermissionIsMissing) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const TemporaryFolder folder;
    writeText(folder / "secret", "x");
    fs::permissions(folder / "secret", fs::perms::none);
    auto file = FileBytes::read(folder / "secret");
    ASSERT_FALSE(file);
    EXPECT_TRUE(mentions(file.error(), "no permission")) << file.error().toString();
}

TEST(AtomicFile, WritesIntoAPipeThatHasNoNameOfItsOwn) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    // What /dev/stdout is where the output goes to another program.
    const fs::path path = "/proc/self/fd/" + std::to_string(ends[1]);
    const auto written = writeFileAtomically(path, std::string_view("through"));
    ::close(ends[1]);
    ASSERT_TRUE(written) << written.error().toString();
    char buffer[16];
    EXPECT_EQ(std::string(buffer, static_cast<std::size_t>(::read(ends[0], buffer, sizeof buffer))), "through");
    ::close(ends[0]);
}

TEST(AtomicFile, OldFileStaysUntilCommit) {
    const TemporaryFolder folder;
    writeText(folder / "a", "old");
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file) << file.error().toString();
    ASSERT_TRUE(file->write("ne"));
    ASSERT_TRUE(file->write("w"));
    EXPECT_EQ(readText(folder / "a"), "old");
    auto size = file->commit();
    ASSERT_TRUE(size);
    EXPECT_EQ(*size, 3u);
    EXPECT_EQ(readText(folder / "a"), "new");
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, WithoutCommitNothingIsLeft) {
    const TemporaryFolder folder;
    writeText(folder / "a", "old");
    {
        auto file = AtomicFile::create(folder / "a");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->write(std::string(1 << 20, 'x')));
        EXPECT_EQ(folder.count(), 2);
    }
    EXPECT_EQ(readText(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, SmallAndLargePiecesStayInOrder) {
    const TemporaryFolder folder;
    std::string expected;
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    for (std::size_t size : {1ul, 0ul, 255ul * 1024, 2000ul, 300ul * 1024, 7ul, 256ul * 1024, 5ul}) {
        const std::string piece(size, static_cast<char>('a' + expected.size() % 26));
        ASSERT_TRUE(file->write(piece));
        expected += piece;
    }
    ASSERT_TRUE(file->writeZeros(10000));
    expected += std::string(10000, '\0');
    EXPECT_EQ(file->size(), expected.size());
    ASSERT_TRUE(file->commit());
    EXPECT_TRUE(readText(folder / "a") == expected);
}

TEST(AtomicFile, KeepsThePermissionsAndTheLink) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    writeText(folder / "sub" / "real", "old");
    fs::permissions(folder / "sub" / "real", fs::perms(0640));
    fs::create_symlink("sub/real", folder / "link");
    auto size = writeFileAtomically(folder / "link", "new");
    ASSERT_TRUE(size) << size.error().toString();
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(readText(folder / "sub" / "real"), "new");
    EXPECT_EQ(fs::status(folder / "sub" / "real").permissions(), fs::perms(0640));
}

TEST(AtomicFile, LinksInACircleAreRefused) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    auto file = AtomicFile::create(folder / "a");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code(), Code::CannotWrite);
}

TEST(AtomicFile, LongestFileNameCanBeWritten) {
    const TemporaryFolder folder;
    EXPECT_TRUE(writeFileAtomically(folder / std::string(255, 'n'), "x"));
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
    const TemporaryFolder folder;
    writeText(folder / "file", "x");
    const struct {
        fs::path path;
        const char* reason;
    } cases[] = {
        {folder / "absent" / "file", "does not exist; create it"},
        {folder.path(), "is a folder"},
        {folder / "file" / "below", "is a file, not a folder"},
        {folder / std::string(300, 'n'), "name is too long"},
        {"", "is empty"},
    };
    for (const auto& c : cases) {
        auto file = AtomicFile::create(c.path);
        ASSERT_FALSE(file) << c.path;
        EXPECT_EQ(file.error().code(), Code::CannotWrite);
        EXPECT_TRUE(mentions(file.error(), c.reason)) << file.error().toString();
    }
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, ALinkIntoAMissingFolderIsToldAsSuch) {
    const TemporaryFolder folder;
    fs::create_symlink("absent/file", folder / "link");
    auto file = AtomicFile::create(folder / "link");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code(), Code::CannotWrite);
    EXPECT_TRUE(mentions(file.error(), "this is a link to " + (folder / "absent/file").string()))
        << file.error().toString();
    EXPECT_TRUE(mentions(file.error(), "does not exist; create it")) << file.error().toString();
}

TEST(AtomicFile, AFolderThatTakesNoFilesIsNotCalledMissing) {
    if (!fs::exists("/proc/self")) GTEST_SKIP() << "there is no /proc";
    auto file = AtomicFile::create("/proc/file");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code(), Code::CannotWrite);
    EXPECT_FALSE(mentions(file.error(), "does not exist")) << file.error().toString();
}

TEST(FileIdentity, IsThatOfTheFileByEveryPath) {
    const TemporaryFolder folder;
    writeText(folder / "a", "x");
    writeText(folder / "b", "x");
    fs::create_hard_link(folder / "a", folder / "hard");
    fs::create_symlink("a", folder / "soft");
    fs::create_symlink("absent", folder / "dangling");
    EXPECT_EQ(fileIdentity(folder / "hard"), fileIdentity(folder / "a"));
    EXPECT_EQ(fileIdentity(folder / "soft"), fileIdentity(folder / "a"));
    EXPECT_EQ(fileIdentity(folder / "dangling"), fileIdentity(folder / "." / "absent"));
    EXPECT_NE(fileIdentity(folder / "b"), fileIdentity(folder / "a"));
    EXPECT_NE(fileIdentity(folder / "absent"), fileIdentity(folder / "missing"));
    EXPECT_EQ(fileIdentity("/dev/null"), "");
}

TEST(CheckWritable, ChangesNothing) {
    const TemporaryFolder folder;
    writeText(folder / "a", "old");
    EXPECT_TRUE(checkWritable(folder / "a"));
    EXPECT_TRUE(checkWritable(folder / "new"));
    EXPECT_TRUE(checkWritable("/dev/null"));
    EXPECT_EQ(readText(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 1);
    const auto missing = checkWritable(folder / "absent" / "a");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code(), Code::CannotWrite);
}

TEST(CheckWritable, DoesNotOpenAPipe) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    // Without a reader, opening it would wait for ever.
    EXPECT_TRUE(checkWritable(folder / "pipe"));
}

TEST(CheckNoStream, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_symlink("pipe", folder / "link");
    writeText(folder / "file", "");
    for (const fs::path& path : {folder / "file", folder / "absent", folder.path()}) EXPECT_TRUE(checkNoStream(path));
    for (const fs::path& path : {folder / "pipe", folder / "link", fs::path("/dev/null")}) {
        const auto refused = checkNoStream(path);
        ASSERT_FALSE(refused) << path;
        EXPECT_EQ(refused.error().code(), Code::CannotWrite);
        EXPECT_EQ(refused.error().where().file, path);
    }
}

TEST(WithoutLinks, LeadsToTheEnd) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("c/d", folder / "b");
    fs::create_symlink("circle", folder / "circle");
    EXPECT_EQ(withoutLinks(folder / "a"), folder / "c/d");
    EXPECT_EQ(withoutLinks(folder / "plain"), folder / "plain");
    EXPECT_EQ(withoutLinks(folder / "circle"), fs::path());
}

TEST(Leftovers, OfAKilledProcessGoWithTheNextWrite) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        auto file = AtomicFile::create(folder / "a");
        if (!file || !file->write(std::string(1 << 20, 'x'))) ::_exit(1);
        ::raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_EQ(folder.count(), 1) << "the killed writer has left nothing";
    ASSERT_TRUE(writeFileAtomically(folder / "b", "new"));
    EXPECT_EQ(folder.count(), 1);
    EXPECT_EQ(readText(folder / "b"), "new");
}

TEST(Leftovers, OfALivingWriterAndFilesOfOthersStay) {
    const TemporaryFolder folder;
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    const char* const others[] = {".svt-1-2.tmp", ".svt-1-2-3.tmp.txt", ".svt-x-2-3.tmp", ".svt-1-2-3-4.tmp",
                                  ".svt-.tmp"};
    for (const char* name : others) writeText(folder / name, "mine");
    fs::create_symlink("a", folder / ".svt-1-2-3.tmp");
    fs::create_directory(folder / ".svt-4-5-6.tmp");
    EXPECT_EQ(removeLeftovers(folder.path()), 0u);
    ASSERT_TRUE(file->write("kept"));
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(readText(folder / "a"), "kept");
    for (const char* name : others) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(Leftovers, AreRemovedBesideManyWritersOfWhichNoneIsLost) {
    const TemporaryFolder folder;
    constexpr int kWriters = 4, kFiles = 100;
    std::atomic<bool> isDone{false};
    std::atomic<int> failures{0};
    std::vector<std::thread> threads;
    for (int w = 0; w < kWriters; ++w)
        threads.emplace_back([&, w] {
            for (int f = 0; f < kFiles; ++f) {
                const std::string name = std::to_string(w) + "_" + std::to_string(f);
                if (!writeFileAtomically(folder / name, name)) ++failures;
            }
        });
    std::vector<std::thread> cleaners;
    for (int c = 0; c < 2; ++c)
        cleaners.emplace_back([&] {
            while (!isDone) removeLeftovers(folder.path());
        });
    for (std::thread& thread : threads) thread.join();
    isDone = true;
    for (std::thread& thread : cleaners) thread.join();
    EXPECT_EQ(failures, 0);
    EXPECT_EQ(folder.count(), kWriters * kFiles);
    for (int w = 0; w < kWriters; ++w)
        for (int f = 0; f < kFiles; ++f) {
            const std::string name = std::to_string(w) + "_" + std::to_string(f);
            ASSERT_EQ(readText(folder / name), name);
        }
}

TEST(AtomicFile, WriteProtectedFileAndFolderAreRespected) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
    const TemporaryFolder folder;
    writeText(folder / "file", "x");
    fs::permissions(folder / "file", fs::perms(0444));
    EXPECT_FALSE(AtomicFile::create(folder / "file"));
    fs::permissions(folder.path(), fs::perms(0555));
    EXPECT_FALSE(AtomicFile::create(folder / "other"));
    fs::permissions(folder.path(), fs::perms(0755));
}

TEST(AtomicFile, FullDeviceIsDiskFull) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    auto size = writeFileAtomically("/dev/full", "x");
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().code(), Code::DiskFull);
    EXPECT_TRUE(mentions(size.error(), "no space")) << size.error().toString();
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, DeviceIsWrittenNotReplaced) {
    auto size = writeFileAtomically("/dev/null", "x");
    ASSERT_TRUE(size) << size.error().toString();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// Limits the size of files that this process may write, for one scope.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        oldHandler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        isSet_ = ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, oldHandler_);
    }
    [[nodiscard]] bool isSet() const noexcept { return isSet_; }

private:
    rlimit old_{};
    void (*oldHandler_)(int) = nullptr;
    bool isSet_ = false;
};

TEST(AtomicFile, FailureInTheMiddleKeepsTheOldFile) {
    const TemporaryFolder folder;
    writeText(folder / "a", "old");
    const FileSizeLimit limit(512 * 1024);
    if (!limit.isSet()) GTEST_SKIP() << "the size of files cannot be limited here";
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(std::string(400 * 1024, 'x')));
    auto second = file->write(std::string(400 * 1024, 'x'));
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code(), Code::CannotWrite);
    EXPECT_TRUE(mentions(second.error(), "size limit")) << second.error().toString();
    EXPECT_FALSE(file->write("more"));
    EXPECT_FALSE(file->commit());
    EXPECT_EQ(readText(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, FullDiskKeepsTheOldFile) {
    const TemporaryFolder folder;
    if (::unshare(CLONE_NEWNS) != 0 || ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=256k") != 0)
        GTEST_SKIP() << "a small file system cannot be mounted without the rights for it";
    writeText(folder / "a", "old");
    auto size = writeFileAtomically(folder / "a", std::string(1 << 20, 'x'));
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().code(), Code::DiskFull);
    EXPECT_EQ(readText(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 1);
    ::umount(folder.path().c_str());
}

}  // namespace
}  // namespace svt
