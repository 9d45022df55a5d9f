#include <svt/city/store/store.hpp>

#include <svt/core/file.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

namespace svt::city {
namespace {

class FolderStore : public Store {
public:
    explicit FolderStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    Result<std::string> read(const std::string& name, std::uint64_t offset, std::size_t size) const override {
        const auto file = open(name);
        const std::string_view text = file ? file->text() : std::string_view();
        const auto begin = static_cast<std::size_t>(std::min<std::uint64_t>(offset, text.size()));
        return std::string(text.substr(begin, size));
    }
    Result<std::uint64_t> size(const std::string& name) const override {
        const auto file = open(name);
        return file ? std::uint64_t{file->text().size()} : std::uint64_t{0};
    }
    std::string place(const std::string& name) const override { return (folder_ / name).string(); }

private:
    // Kept open, so that a file that is replaced meanwhile stays as it was; null where it is missing.
    const MappedFile* open(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        auto& file = files_[name];
        if (!file) {
            auto opened = MappedFile::open(folder_ / name);
            if (opened) file.emplace(std::move(*opened));
        }
        return file ? &*file : nullptr;
    }

    std::filesystem::path folder_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::optional<MappedFile>> files_;
};

}  // namespace

bool isAddress(const std::string& location) noexcept {
    return location.starts_with("http://") || location.starts_with("https://");
}

std::shared_ptr<const Store> openStore(const std::string& location) {
    if (isAddress(location)) return openHttpStore(location);
    return std::make_shared<FolderStore>(location);
}

}  // namespace svt::city
