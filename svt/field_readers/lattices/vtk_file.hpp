#pragma once
/// \file
/// XML files of VTK with image data or a rectilinear grid.

#include <svt/core/result.hpp>
#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/lattices/lattice_field.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::field_readers {

/// An array of a VTK file.
struct VtkArray {
    std::string name;
    bool isCell = false;
    std::int32_t components = 1;
    SampleType type;
    std::string format;        ///< ascii, binary, appended
    std::uint64_t offset = 0;  ///< of appended samples
    std::string_view text;     ///< of samples in the XML
};

/// Facts about all arrays of a VTK file, from its field data.
struct VtkFacts {
    std::string unit, quantity, medium;  ///< of files of svt; empty: not stated
    std::optional<std::string> epoch;
    std::optional<double> time;  ///< TimeValue, seconds
};

/// A VTK file, opened: its lattice and the list of its arrays.
class VtkFile {
public:
    /// \return the file, or CannotOpen, InputTooBig, or BadField with the fault
    [[nodiscard]] static Result<VtkFile> open(const std::filesystem::path& path, std::uint64_t maxBytes);

    VtkFile(VtkFile&&) noexcept;
    VtkFile& operator=(VtkFile&&) noexcept;
    VtkFile(const VtkFile&) = delete;
    VtkFile& operator=(const VtkFile&) = delete;
    ~VtkFile();

    [[nodiscard]] const std::vector<VtkArray>& arrays() const noexcept;
    /// The places of the values of points or cells, along the axes of the file.
    [[nodiscard]] const NodePlaces& places(bool isCell) const noexcept;
    [[nodiscard]] const Frame& frame() const noexcept;
    [[nodiscard]] const VtkFacts& facts() const noexcept;
    /// Appends the values of an array.
    /// \return nothing, or BadField where they are damaged or not as many as the lattice has places
    [[nodiscard]] Result<void> read(const VtkArray& array, std::vector<float>& to) const;

private:
    struct State;
    template <class Number>
    [[nodiscard]] Result<void> readAs(const VtkArray& array, std::vector<Number>& to) const;
    explicit VtkFile(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Decodes base64 with padding, in one or several joined texts, ignoring blanks.
/// \return false for other characters
[[nodiscard]] bool decodeBase64(std::string_view text, std::string& to);

}  // namespace svt::field_readers
