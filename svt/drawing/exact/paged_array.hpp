#pragma once
/// \file
/// Values by number, of which a drawing needs a small part: one of 150 storeys reads the points of one.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace svt::drawing {

/// An array whose pages take memory when they are first written.
template <class T>
class PagedArray {
public:
    explicit PagedArray(std::size_t size) : pages_((size + kPageSize - 1) / kPageSize) {}

    /// The value, T() at first.
    [[nodiscard]] T& at(std::size_t n) {
        std::unique_ptr<Page>& page = pages_[n / kPageSize];
        if (page == nullptr) page = std::make_unique<Page>();
        return (*page)[n % kPageSize];
    }
    /// A value of a page that at() has visited.
    [[nodiscard]] const T& operator[](std::size_t n) const noexcept { return (*pages_[n / kPageSize])[n % kPageSize]; }

    /// Calls `body(value)` for all values of the pages that at() has visited.
    template <class Body>
    void forVisited(const Body& body) {
        for (std::unique_ptr<Page>& page : pages_)
            if (page != nullptr)
                for (T& value : *page) body(value);
    }

private:
    static constexpr std::size_t kPageSize = 128;
    using Page = std::array<T, kPageSize>;
    std::vector<std::unique_ptr<Page>> pages_;
};

}  // namespace svt::drawing
