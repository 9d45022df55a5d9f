#pragma once
/// \file
/// A call of the module: arguments in, a reply or an error out.

#include "city.hpp"
#include "font/font.hpp"
#include "session.hpp"

#include <svt/core/progress.hpp>
#include <svt/illustrate/scene.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::web {

using Json = nlohmann::json;

/// JSON text or bytes. Pixels are not copied; they are valid until the next picture.
struct Reply {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;

    Reply() = default;
    Reply(std::vector<std::byte> data) : owned(std::move(data)), bytes(owned) {}
    Reply(const std::string& text) : owned(asBytes(text).begin(), asBytes(text).end()), bytes(owned) {}
    explicit Reply(std::span<const std::byte> elsewhere) : bytes(elsewhere) {}
    Reply(Reply&&) = default;
    Reply& operator=(Reply&&) = default;

    static std::span<const std::byte> asBytes(const std::string& text) {
        return std::as_bytes(std::span(text.data(), text.size()));
    }
};

inline Result<Reply> replyOf(Result<std::string> text) {
    if (!text) return text.error();
    return Reply(*text);
}

/// Arguments of a call. They come from the page itself, so a wrong type is a programming error, not a bad user file.
class Arguments {
public:
    Arguments(const Json& values, std::span<const std::byte> bytes) : values_(values), bytes_(bytes) {}

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    [[nodiscard]] const Json& at(std::size_t n) const {
        static const Json kNone;
        return n < values_.size() ? values_[n] : kNone;
    }
    [[nodiscard]] std::string text(std::size_t n) const {
        return at(n).is_string() ? at(n).get_ref<const std::string&>() : std::string();
    }
    [[nodiscard]] double number(std::size_t n) const { return at(n).is_number() ? at(n).get<double>() : 0; }
    /// A size in pixels; values out of range stay out of range.
    [[nodiscard]] std::int32_t pixels(std::size_t n) const {
        return static_cast<std::int32_t>(std::clamp(number(n), 0.0, 1e6));
    }
    [[nodiscard]] Result<illustrate::Scene> scene(std::size_t n) const {
        return illustrate::parseScene(at(n).dump(), "scene");
    }
    /// A scene to draw.
    [[nodiscard]] Result<illustrate::Scene> picture(std::size_t n) const {
        auto parsed = scene(n);
        if (parsed && !parsed->names.empty() && !hasFont())
            return Error(Code::BadArgument, "names cannot be drawn without their font; give it first");
        return parsed;
    }

private:
    const Json& values_;
    std::span<const std::byte> bytes_;
};

/// The open volume, for calls that need one.
[[nodiscard]] Session& openSession() noexcept;

/// The city of the page, which reads its files when a call needs them.
[[nodiscard]] CityPage& openCity();
/// Bytes of the city that a call has lacked, as {needs: [[file, offset, size], ...]}: the page gives them, and repeats
/// the call. Null: none.
[[nodiscard]] Json neededBytes();

/// Runs a call by its name; each module has its own calls.
[[nodiscard]] Result<Reply> runCall(std::string_view name, const Arguments& arguments);

/// Progress that the page receives.
[[nodiscard]] Progress progressOfPage();

struct Call {
    std::string_view name;
    Result<Reply> (*run)(const Arguments& arguments);
    bool needsVolume = true;
};

/// The call of a name; null if `calls` lacks it.
[[nodiscard]] inline const Call* findCall(std::span<const Call> calls, std::string_view name) noexcept {
    for (const Call& call : calls)
        if (call.name == name) return &call;
    return nullptr;
}

/// The error of a name that no call has.
[[nodiscard]] Error unknownCall(std::string_view name);

}  // namespace svt::web
