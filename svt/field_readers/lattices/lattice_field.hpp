#pragma once
/// \file
/// An array on a lattice as a field, whatever the format.

#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::field_readers {

/// The values of a file on a lattice.
struct LatticeArray {
    std::string name, unit;
    NodePlaces places;            ///< along the axes of the file, metres
    Frame frame;                  ///< of the file
    std::int32_t components = 1;  ///< 1 or 3
    std::vector<float> values;    ///< x fastest, then y and z; the components of a place follow each other
    std::vector<double> times{0};
    std::string by;
    std::string place;                 ///< how the file states its frame; empty: not at all
    std::string quantity, medium;      ///< that the file states, as those of svt do; empty: not at all
    std::optional<std::string> epoch;  ///< as FieldHead::epoch
};

/// The number of places of an array.
[[nodiscard]] std::uint64_t placesOf(const NodePlaces& places) noexcept;

/// FieldReadOptions::at counts as the origin of the file's coordinates, and replaces the origin that a file states. The medium is that of the file, else `all`, unless another is asked for.
/// \return the field, or BadArgument where the file's axes are not those of the grid, or units do not fit
[[nodiscard]] Result<fields::Field> fieldOfArray(LatticeArray array, const Reading& reading, Assumptions assumptions);

/// How whole numbers and floats are stored.
struct SampleType {
    char kind = 'f';  ///< f: float, i: signed, u: unsigned
    int bytes = 4;
    bool isSwapped = false;
};

/// Appends the samples as numbers of another type. \param bytes  a whole number of samples
void appendSamples(std::string_view bytes, const SampleType& type, std::vector<float>& to);
void appendSamples(std::string_view bytes, const SampleType& type, std::vector<double>& to);

}  // namespace svt::field_readers
