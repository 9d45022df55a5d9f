#pragma once
/// \file
/// Little-endian numbers in byte strings, read with every bound checked.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace svt::city {

/// Appends a number.
template <class T>
void put(std::string& to, T value) {
    static_assert(std::is_arithmetic_v<T> && std::endian::native == std::endian::little);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    to.append(bytes, sizeof(T));
}

/// Takes numbers off the front of a text. After a number that is not there all are 0, and isGood() is false.
class Taker {
public:
    explicit Taker(std::string_view text) : rest_(text) {}

    template <class T>
    T take() {
        T value{};
        if (rest_.size() < sizeof(T)) {
            isGood_ = false;
            rest_ = {};
            return value;
        }
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        return value;
    }
    std::string_view text(std::size_t size) {
        if (rest_.size() < size) {
            isGood_ = false;
            size = rest_.size();
        }
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    [[nodiscard]] std::size_t left() const noexcept { return rest_.size(); }
    [[nodiscard]] bool isGood() const noexcept { return isGood_; }

private:
    std::string_view rest_;
    bool isGood_ = true;
};

}  // namespace svt::city
