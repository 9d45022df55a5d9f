#include <svt/fields/check_field.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_set>

namespace svt::fields {
namespace {

constexpr std::size_t kMaxTextBytes = 1000, kMaxUnitBytes = 60, kMaxMediumBytes = 65536;
constexpr std::size_t kMaxParameterBytes = std::size_t{1} << 20;
constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 40;

Error badField(std::string message) { return Error(Code::BadField, std::move(message)); }

bool isFieldName(std::string_view name) noexcept {
    if (name.empty() || name.size() > kMaxNameBytes || !isLetter(name[0])) return false;
    return std::all_of(name.begin(), name.end(),
                       [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-' || c == '.'; });
}

bool isUnit(std::string_view unit) noexcept {
    return !unit.empty() && unit.size() <= kMaxUnitBytes &&
           std::all_of(unit.begin(), unit.end(), [](char c) { return c > ' ' && c <= '~'; });
}

bool isText(std::string_view text, std::size_t most = kMaxTextBytes) noexcept {
    return text.size() <= most && findInvalidUtf8(text) == std::string_view::npos;
}

// Whether `text` matches a pattern in which 0 stands for any digit.
bool isLike(std::string_view text, std::string_view pattern) noexcept {
    if (text.size() != pattern.size()) return false;
    for (std::size_t c = 0; c < text.size(); ++c)
        if (pattern[c] == '0' ? !isDigit(text[c]) : text[c] != pattern[c]) return false;
    return true;
}

bool isEpoch(std::string_view text) noexcept {
    constexpr std::string_view kBegin = "0000-00-00T00:00:00";
    if (!isLike(text.substr(0, kBegin.size()), kBegin)) return false;
    text.remove_prefix(kBegin.size());
    if (!text.empty() && text[0] == '.') {
        std::size_t digits = 1;
        while (digits < text.size() && isDigit(text[digits])) ++digits;
        if (digits == 1) return false;
        text.remove_prefix(digits);
    }
    return text == "Z" || isLike(text, "+00:00") || isLike(text, "-00:00");
}

Result<void> checkTimes(const FieldHead& head) {
    if (head.times.empty() || head.times.size() > kMaxTimes)
        return badField(fmt::format("it has {} times, 1 to {} are possible", head.times.size(), kMaxTimes));
    for (std::size_t t = 0; t < head.times.size(); ++t) {
        if (!std::isfinite(head.times[t])) return badField(fmt::format("time {} is not a number", t));
        if (t > 0 && head.times[t] <= head.times[t - 1])
            return badField(
                fmt::format("time {} ({} s) is not after the one before ({} s)", t, head.times[t], head.times[t - 1]));
    }
    if (head.epoch && !isEpoch(*head.epoch))
        return badField(
            fmt::format("epoch '{}' is not a date and time with zone such as 2026-01-05T00:00:00Z", *head.epoch));
    return {};
}

Result<void> checkPoints(const FieldHead& head) {
    if (head.kind != FieldKind::Points && !head.points.empty())
        return badField(fmt::format("a field of kind '{}' has no points", nameOf(head.kind)));
    if (head.points.size() > kMaxPoints)
        return badField(fmt::format("it has {} points, {} are possible", head.points.size(), kMaxPoints));
    std::unordered_set<std::string_view> ids;
    for (std::size_t p = 0; p < head.points.size(); ++p) {
        const FieldPoint& point = head.points[p];
        if (point.id.empty() || !isText(point.id))
            return badField(fmt::format("the id of point {} is empty, too long or not UTF-8", p));
        if (!ids.insert(point.id).second) return badField(fmt::format("two points have the id '{}'", point.id));
        if (!isFinite(point.at)) return badField(fmt::format("the place of point '{}' is not a number", point.id));
    }
    return {};
}

Result<void> checkMembers(const FieldHead& head) {
    if (!isUnit(head.unit))
        return badField(
            fmt::format("unit '{}' is not a UCUM code: 1 to {} ASCII characters without blanks, such as Cel or kg/m3; "
                        "1 for a number without unit",
                        head.unit, kMaxUnitBytes));
    if (head.components != 1 && head.components != 3)
        return badField(fmt::format("it has {} components, 1 or 3 are possible", head.components));
    if (head.medium.empty() || !isText(head.medium, kMaxMediumBytes))
        return badField("medium is empty, too long or not UTF-8");
    if (!isText(head.quantity)) return badField("quantity is too long or not UTF-8");
    if (!isText(head.by)) return badField("by is too long or not UTF-8");
    if (!(head.precision >= 0 && std::isfinite(head.precision)))
        return badField(fmt::format("precision {} is not a number of at least 0", head.precision));
    if (!head.parameters.empty()) {
        const auto json = head.parameters.size() <= kMaxParameterBytes
                              ? nlohmann::json::parse(head.parameters, nullptr, false)
                              : nlohmann::json();
        if (!json.is_object())
            return badField(fmt::format("parameters are not a JSON object of at most {} bytes", kMaxParameterBytes));
    }
    return {};
}

Result<void> checkUnnamed(const FieldHead& head) {
    SVT_DO(checkMembers(head));
    SVT_DO(checkTimes(head));
    SVT_DO(checkPoints(head));
    if (head.kind == FieldKind::Grid) SVT_DO(checkLattice(head.lattice));
    return {};
}

}  // namespace

Result<void> checkLattice(const Lattice& lattice) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t size = lattice.size[axis];
        const auto& positions = lattice.positions[static_cast<std::size_t>(axis)];
        if (size < 1 || size > kMaxNodes)
            return badField(
                fmt::format("the lattice has {} nodes along axis {}, 1 to {} are possible", size, axis, kMaxNodes));
        const double first = lattice.first[axis], step = lattice.step[axis];
        if (!(step > 0 && step < kMaxPlace))
            return badField(
                fmt::format("the step {} of the lattice along axis {} is not a number above 0", step, axis));
        if (!(std::abs(first) < kMaxPlace && std::abs(first + step * size) < kMaxPlace))
            return badField(fmt::format("the lattice reaches too far along axis {}: {} and {} nodes with steps of {}",
                                        axis, first, size, step));
        if (positions.empty() != lattice.positions[0].empty())
            return badField("the lattice has positions along some axes only");
        if (positions.empty()) continue;
        if (positions.size() != static_cast<std::size_t>(size))
            return badField(
                fmt::format("the lattice has {} positions along axis {} for {} nodes", positions.size(), axis, size));
        for (std::size_t n = 0; n < positions.size(); ++n)
            if (!(std::abs(positions[n]) < kMaxPlace) || (n > 0 && positions[n] <= positions[n - 1]))
                return badField(fmt::format(
                    "position {} of the lattice along axis {} is not above the one before, or too far", n, axis));
    }
    return {};
}

Result<void> checkHead(const FieldHead& head) {
    if (!isFieldName(head.name))
        return badField(
            fmt::format("a field cannot have the name '{}': use a letter, then letters, digits, '_', '-' and '.', at "
                        "most {} bytes",
                        head.name.substr(0, kMaxNameBytes), kMaxNameBytes));
    if (auto checked = checkUnnamed(head); !checked)
        return badField(fmt::format("field '{}': {}", head.name, checked.error().message()));
    if (head.kind != FieldKind::Label && valueCount(head, 0) > kMaxValues)
        return badField(
            fmt::format("field '{}': it has {} values, {} are possible", head.name, valueCount(head, 0), kMaxValues));
    return {};
}

Result<void> checkField(const Field& field, std::size_t labelCount) {
    SVT_DO(checkHead(field.head));
    const std::uint64_t expected = valueCount(field.head, labelCount);
    if (field.values.size() != expected)
        return badField(fmt::format("field '{}' has {} values; {} times x {} components x {} places are {}",
                                    field.head.name, field.values.size(), field.head.times.size(),
                                    field.head.components, placeCount(field.head, labelCount), expected));
    for (std::size_t v = 0; v < field.values.size(); ++v)
        if (std::isinf(field.values[v]))
            return badField(
                fmt::format("field '{}': value {} is infinite; a missing value is NaN", field.head.name, v));
    return {};
}

std::uint64_t valueCount(const FieldHead& head, std::size_t labelCount) noexcept {
    // 2^60 nodes x 3 components x 2^20 times would not fit into 64 bits.
    const auto count = static_cast<double>(head.times.size()) * head.components *
                       (head.kind == FieldKind::Grid
                            ? double(head.lattice.size.x) * double(head.lattice.size.y) * double(head.lattice.size.z)
                            : 0.0);
    if (count > double(kMaxValues)) return kMaxValues + 1;
    return std::uint64_t{head.times.size()} * static_cast<std::uint64_t>(head.components) *
           placeCount(head, labelCount);
}

}  // namespace svt::fields
