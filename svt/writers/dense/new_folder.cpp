#include <svt/writers/dense/new_folder.hpp>

#include <fmt/format.h>

#include <fstream>
#include <system_error>
#include <utility>

namespace svt::writers {
namespace fs = std::filesystem;

namespace {

// Not while a signal removes the folder above.
void makeFolders(const fs::path& folder) {
    static_cast<void>(Unfinished::path([&] {
        std::error_code ignored;  // writing the file will fail
        fs::create_directories(folder, ignored);
        return fs::path();
    }));
}

}  // namespace

NewFolder::NewFolder(fs::path place) : place_(std::move(place)), folder_(place_) { folder_ += ".part"; }

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (isMade_) fs::remove_all(folder_, ignored);
}

Result<void> NewFolder::create() {
    std::error_code failed;
    if (fs::exists(place_, failed))
        return at(Code::WouldDestroy,
                  "the folder is there already, and a folder is never replaced; remove it, or give another name");
    if (fs::exists(folder_, failed))
        return at(Code::WouldDestroy,
                  fmt::format("'{}' is there, as of a command that was ended or is at work; remove it",
                              folder_.filename().string()));
    unfinished_ = Unfinished::path([&] {
        isMade_ = fs::create_directories(folder_, failed);
        return isMade_ ? folder_ : fs::path();
    });
    if (!isMade_) return at(Code::CannotWrite, "the folder cannot be made: " + failed.message());
    return {};
}

Result<void> NewFolder::write(const std::string& name, std::string_view text) {
    makeFolders((folder_ / name).parent_path());
    return put(name, text, false);
}

Result<void> NewFolder::append(const std::string& name, std::string_view text) { return put(name, text, true); }

Result<void> NewFolder::put(const std::string& name, std::string_view text, bool isAdded) {
    std::error_code failed;
    std::ofstream stream(folder_ / name, isAdded ? std::ios::binary | std::ios::app : std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (stream) {
        size_ += text.size();
        return {};
    }
    const fs::space_info space = fs::space(folder_, failed);
    if (!failed && space.available < text.size() + (1u << 20))
        return at(Code::DiskFull, "no space is left for the folder");
    return at(Code::CannotWrite, fmt::format("'{}' cannot be written", name));
}

Result<std::uint64_t> NewFolder::commit() {
    std::error_code failed;
    fs::rename(folder_, place_, failed);
    if (failed) return at(Code::CannotWrite, "the folder cannot take its place: " + failed.message());
    isMade_ = false;
    unfinished_.forget();
    return size_;
}

Error NewFolder::at(Code code, std::string message) const {
    return Error(code, std::move(message), Place{place_.string(), 0, 0, {}});
}

}  // namespace svt::writers
