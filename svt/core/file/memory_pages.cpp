#include <svt/core/machine.hpp>

#include <svt/core/file/mappings.hpp>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

#if defined(__linux__)
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace svt {
namespace {

struct Mappings {
    std::mutex mutex;
    std::vector<std::span<const std::byte>> ranges;
};

// Never destroyed: files may be unmapped after the end of main().
Mappings& mappings() {
    static auto* const all = new Mappings;
    return *all;
}

}  // namespace

void rememberMapping(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const std::lock_guard guard(mappings().mutex);
    mappings().ranges.push_back(bytes);
}

void forgetMapping(std::span<const std::byte> bytes) noexcept {
    const std::lock_guard guard(mappings().mutex);
    std::erase_if(mappings().ranges, [&](const auto& range) { return range.data() == bytes.data(); });
}

void returnFreeMemory() noexcept {
#if defined(__GLIBC__)
    ::malloc_trim(0);
#endif
}

void forgetMappedBytes([[maybe_unused]] std::span<const std::byte> bytes) noexcept {
#if defined(__linux__)
    const auto address = [](const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at); };
    const auto begin = address(bytes.data()), end = begin + bytes.size();
    const std::lock_guard guard(mappings().mutex);
    const bool isMapped = std::any_of(mappings().ranges.begin(), mappings().ranges.end(), [&](const auto& range) {
        return address(range.data()) <= begin && end <= address(range.data()) + range.size();
    });
    if (!isMapped) return;
    // Whole pages within.
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
    if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
#endif
}

}  // namespace svt
