#include <svt/field_readers/lattices/lattice_field.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace svt::field_readers {
namespace {

// Vectors with the components in the file's order at each place become one component after the other.
void splitComponents(std::size_t places, std::size_t components, std::vector<float>& values) {
    if (components == 1) return;
    std::vector<float> split;
    split.reserve(values.size());
    for (std::size_t begin = 0; begin < values.size(); begin += places * components)
        for (std::size_t c = 0; c < components; ++c)
            for (std::size_t p = 0; p < places; ++p) split.push_back(values[begin + p * components + c]);
    values = std::move(split);
}

template <class Stored, class Number>
void appendNumbers(std::string_view bytes, std::endian order, std::vector<Number>& to) {
    const auto* at = reinterpret_cast<const std::byte*>(bytes.data());
    for (std::size_t n = 0; n + sizeof(Stored) <= bytes.size(); n += sizeof(Stored))
        to.push_back(static_cast<Number>(loadBytes<Stored>(at + n, order)));
}

template <class Number>
void appendAs(std::string_view bytes, const SampleType& type, std::vector<Number>& to) {
    const std::endian order = type.isSwapped ? std::endian::big : std::endian::little;
    to.reserve(to.size() + bytes.size() / static_cast<std::size_t>(type.bytes));
    if (type.kind == 'f') {
        type.bytes == 8 ? appendNumbers<double>(bytes, order, to) : appendNumbers<float>(bytes, order, to);
        return;
    }
    const bool isSigned = type.kind == 'i';
    switch (type.bytes) {
        case 1:
            isSigned ? appendNumbers<std::int8_t>(bytes, order, to) : appendNumbers<std::uint8_t>(bytes, order, to);
            break;
        case 2:
            isSigned ? appendNumbers<std::int16_t>(bytes, order, to) : appendNumbers<std::uint16_t>(bytes, order, to);
            break;
        case 4:
            isSigned ? appendNumbers<std::int32_t>(bytes, order, to) : appendNumbers<std::uint32_t>(bytes, order, to);
            break;
        default:
            isSigned ? appendNumbers<std::int64_t>(bytes, order, to) : appendNumbers<std::uint64_t>(bytes, order, to);
    }
}

}  // namespace

std::uint64_t placesOf(const NodePlaces& places) noexcept {
    return std::uint64_t(places[0].size()) * std::uint64_t(places[1].size()) * std::uint64_t(places[2].size());
}

void appendSamples(std::string_view bytes, const SampleType& type, std::vector<float>& to) {
    appendAs(bytes, type, to);
}
void appendSamples(std::string_view bytes, const SampleType& type, std::vector<double>& to) {
    appendAs(bytes, type, to);
}

Result<fields::Field> fieldOfArray(LatticeArray array, const Reading& reading, Assumptions assumptions) {
    if (reading.options.at) {
        array.frame.origin = (array.place.empty() ? array.frame.origin : Vec3d{}) + *reading.options.at;
        assumptions.add("place", fmt::format("origin of the file's coordinates at ({}, {}, {}), given",
                                             reading.options.at->x, reading.options.at->y, reading.options.at->z));
    } else {
        assumptions.add("place",
                        array.place.empty() ? "coordinates of the file taken as world coordinates" : array.place);
    }
    fields::Field field;
    fields::FieldHead& head = field.head;
    head.name = fieldName(array.name, fieldName(reading.path.stem().string(), "field"));
    head.quantity = array.quantity.empty() ? lowerAscii(array.name) : array.quantity;
    head.medium = !reading.options.medium.empty() ? reading.options.medium
                  : !array.medium.empty()         ? array.medium
                                                  : "all";
    head.epoch = std::move(array.epoch);
    head.by = array.by;
    head.components = array.components;
    head.times = std::move(array.times);
    SVT_TRY(placed, placeLattice(array.places, array.frame, reading.volume.grid));
    field.values = std::move(array.values);
    const Vec3i size{static_cast<std::int32_t>(array.places[0].size()),
                     static_cast<std::int32_t>(array.places[1].size()),
                     static_cast<std::int32_t>(array.places[2].size())};
    if (array.components > 1 && !placed->isSame())
        return Error(
            Code::BadArgument,
            fmt::format("'{}' has vectors along axes that are not those of the grid in this order; save the file "
                        "along the axes of the volume",
                        array.name),
            {reading.path.string(), 0, 0, {}});
    splitComponents(static_cast<std::size_t>(placesOf(array.places)), static_cast<std::size_t>(array.components),
                    field.values);
    reorder(*placed, size, field.values);
    head.lattice = std::move(placed->lattice);
    std::uint64_t notFinite = 0;
    for (float& value : field.values)
        if (std::isinf(value)) {
            value = std::numeric_limits<float>::quiet_NaN();
            ++notFinite;
        }
    if (notFinite > 0)
        reading.warn(Code::BadField,
                     fmt::format("'{}': {} values are infinite; they count as missing", head.name, notFinite));
    SVT_DO(setUnit(field, array.unit, reading, assumptions));
    setPrecision(field, reading, assumptions);
    head.parameters = assumptions.json();
    return field;
}

}  // namespace svt::field_readers
