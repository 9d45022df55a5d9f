#pragma once
/// \file
/// Text output that is identical on every machine: integers only, no locale.

#include <svt/samples/sample.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::samples {

/// Buffers text and passes it on in parts of about 64 KB. After the sink has refused a part, text is discarded.
class TextSink {
public:
    explicit TextSink(const SampleSink& sink) : sink_(sink) {}

    TextSink& operator<<(std::string_view text) {
        buffer_ += text;
        if (buffer_.size() >= kPartBytes) flush();
        return *this;
    }
    TextSink& operator<<(std::int64_t value);
    TextSink& operator<<(int value) { return *this << std::int64_t{value}; }

    /// `value` * 10^-decimals with exactly that many decimals: fixed(-1500, 3) is "-1.500".
    TextSink& fixed(std::int64_t value, int decimals);

    void flush();
    [[nodiscard]] bool hasFailed() const { return hasFailed_; }

private:
    static constexpr std::size_t kPartBytes = std::size_t{1} << 16;
    const SampleSink& sink_;
    std::string buffer_;
    bool hasFailed_ = false;
};

/// `value` * 10^-decimals with exactly that many decimals.
[[nodiscard]] std::string fixedText(std::int64_t value, int decimals);
/// A number with up to six decimals and no trailing zeros.
[[nodiscard]] std::string decimalText(double value);

}  // namespace svt::samples
