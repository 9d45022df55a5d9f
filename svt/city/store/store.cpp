#include <svt/city/store/store.hpp>

#include <svt/core/file.hpp>
#include <svt/http/http_client.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace svt::city {
namespace {

class FolderStore : public Store {
public:
    explicit FolderStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    Result<std::string> read(const std::string& name, std::uint64_t offset, std::size_t size) const override {
        SVT_TRY(file, open(name));
        return *file != nullptr ? (*file)->read(offset, size) : Result<std::string>(std::string());
    }
    Result<std::uint64_t> size(const std::string& name) const override {
        SVT_TRY(file, open(name));
        return *file != nullptr ? (*file)->size() : std::uint64_t{0};
    }
    bool isLocal() const noexcept override { return true; }
    std::string place(const std::string& name) const override { return (folder_ / name).string(); }

private:
    using Open = std::shared_ptr<const PartFile>;
    static constexpr std::size_t kMostOpen = 256;  // of 1024 that most systems grant a process

    // Kept open, so that a file that is replaced meanwhile stays as it was; null where it is missing.
    Result<Open> open(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        if (const auto found = files_.find(name); found != files_.end()) return found->second;
        const std::filesystem::path path = folder_ / name;
        std::error_code failed;
        if (!std::filesystem::exists(path, failed)) return Open();
        SVT_TRY(opened, PartFile::open(path));
        const std::string which = fmt::format("{} {}", fileIdentity(path), opened->size());
        if (seen_.emplace(name, which).first->second != which)
            return Error(Code::BadCity, "the file was replaced while it was read; open the city again",
                         {path.string(), 0, 0, {}});
        if (files_.size() == kMostOpen) files_.clear();
        return files_.emplace(name, std::make_shared<const PartFile>(std::move(*opened))).first->second;
    }

    std::filesystem::path folder_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, Open> files_;
    mutable std::map<std::string, std::string> seen_;  // file and size when it was first opened
};

}  // namespace

std::shared_ptr<const Store> openStore(const std::string& location) {
    if (http::isAddress(location)) return openHttpStore(location);
    return std::make_shared<FolderStore>(location);
}

}  // namespace svt::city
