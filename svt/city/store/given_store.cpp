#include <svt/city/city_bytes.hpp>
#include <svt/city/store/store.hpp>

#include <fmt/format.h>

#include <map>
#include <set>

namespace svt::city {

struct CityBytes::Held : Store {
    Result<std::string> read(const std::string& name, std::uint64_t offset, std::size_t size) const override {
        if (size == 0 || name == "packs.bin") return std::string();
        const Range range{name, offset, size};
        if (const auto found = bytes.find(range); found != bytes.end()) return found->second;
        if (const auto found = refused.find(range); found != refused.end())
            return Error(Code::CannotOpen, found->second, {name, 0, 0, {}});
        wanted.insert(range);
        return Error(Code::CannotOpen, fmt::format("bytes {} to {} are not here yet", offset, offset + size - 1),
                     {name, 0, 0, {}});
    }
    Result<std::uint64_t> size(const std::string& name) const override {
        const auto found = sizes.find(name);
        return found == sizes.end() ? std::uint64_t{0} : found->second;
    }
    std::string place(const std::string& name) const override { return name; }

    std::map<Range, std::string> bytes, refused;
    std::map<std::string, std::uint64_t> sizes;
    mutable std::set<Range> wanted;
};

CityBytes::CityBytes() : held_(std::make_shared<Held>()) {}

std::shared_ptr<const Store> CityBytes::store() const { return held_; }

std::vector<CityBytes::Range> CityBytes::wanted() {
    std::vector<Range> ranges(held_->wanted.begin(), held_->wanted.end());
    held_->wanted.clear();
    return ranges;
}

bool CityBytes::isWanting() const noexcept { return !held_->wanted.empty(); }

void CityBytes::give(const Range& range, std::string bytes, std::uint64_t total) {
    held_->sizes[range.name] = total;
    held_->bytes[range] = std::move(bytes);
}

void CityBytes::refuse(const Range& range, std::string message) { held_->refused[range] = std::move(message); }

void CityBytes::forget() {
    held_->refused.clear();
    std::erase_if(held_->bytes, [](const auto& kept) {
        return kept.first.name.starts_with("packs/") || kept.first.name == "words.bin";
    });
}

}  // namespace svt::city
