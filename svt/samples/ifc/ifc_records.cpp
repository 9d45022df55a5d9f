#include <svt/samples/ifc/ifc_records.hpp>

#include <svt/samples/parts/random.hpp>

#include <array>
#include <cmath>

namespace svt::samples {
namespace {

std::string trimmed(std::string text) {
    while (text.back() == '0') text.pop_back();
    return text == "-0." ? "0." : text;
}

}  // namespace

std::string stepNumber(double value, int decimals) {
    return trimmed(fixedText(std::llround(value * std::pow(10.0, decimals)), decimals));
}

std::string stepRatio(std::int64_t numerator, std::int64_t denominator) {
    constexpr std::int64_t kScale = 1'000'000;
    if (denominator < 0) {
        numerator = -numerator;
        denominator = -denominator;
    }
    const std::int64_t whole = numerator / denominator, rest = numerator % denominator;
    const std::int64_t twice = 2 * rest * kScale;
    const std::int64_t part = (twice + (twice < 0 ? -denominator : denominator)) / (2 * denominator);
    return trimmed(fixedText(whole * kScale + part, 6));
}

std::string stepText(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string stepValue(std::span<const int> records) {
    std::string text;
    for (const int record : records) text += (text.empty() ? "" : ",") + stepValue(record);
    return "(" + text + ")";
}

std::string globalId(std::string_view key) {
    constexpr std::string_view kDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    const std::array<std::uint64_t, 2> bits{mixBits(fnvHash(key)), mixBits(fnvHash(key, kFnvBasis ^ kHashFactor))};
    std::string id;
    // 128 bits: two in the first digit, six in each of the others.
    for (int digit = 0; digit < 22; ++digit) {
        const int low = 126 - 6 * digit;
        std::uint64_t value = 0;
        for (int bit = 5; bit >= 0; --bit) {
            const int at = low + bit;
            value = value << 1 | (at < 128 ? bits[std::size_t(at / 64)] >> (at % 64) & 1 : 0);
        }
        id += kDigits[std::size_t(value)];
    }
    return id;
}

int IfcRecords::addText(std::string_view type, const std::string& values) {
    out_ << "#" << ++last_ << "=" << type << "(" << values << ");\n";
    return last_;
}

int IfcRecords::sharedText(std::string_view type, const std::string& values) {
    const auto [it, isNew] = shared_.try_emplace(std::string(type) + "(" + values, 0);
    if (isNew) it->second = addText(type, values);
    return it->second;
}

int IfcRecords::point(Vec3d p) { return add("IFCCARTESIANPOINT", "(" + stepValues(p.x, p.y, p.z) + ")"); }

int IfcRecords::point2(const std::string& x, const std::string& y) {
    return add("IFCCARTESIANPOINT", "(" + stepValues(x, y) + ")");
}

int IfcRecords::direction(Vec3d d) {
    return shared("IFCDIRECTION",
                  "(" + stepValues(stepNumber(d.x, 12), stepNumber(d.y, 12), stepNumber(d.z, 12)) + ")");
}

int IfcRecords::axes(const Frame& frame) {
    const int origin = point(frame.origin), z = direction(frame.z), x = direction(frame.x);
    return add("IFCAXIS2PLACEMENT3D", origin, z, x);
}

int IfcRecords::placement(int above, const Frame& frame) {
    const int place = axes(frame);
    return add("IFCLOCALPLACEMENT", above, place);
}

}  // namespace svt::samples
