#pragma once
/// \file
/// The files of OpenFOAM: a header, dictionaries, and lists in ASCII or binary.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace svt::field_readers {

/// The entries of FoamFile.
struct FoamHeader {
    std::string className;  ///< such as "volScalarField"
    std::string note;       ///< free text
    bool isBinary = false;
    int labelBytes = 4;   ///< of binary lists: 4 or 8
    int scalarBytes = 8;  ///< of binary lists: 4 or 8
};

/// The values of a field at the centres of cells.
struct FoamField {
    std::vector<double>
        values;  ///< NaN: not a number. One place if uniform; the components of a place follow each other
    bool isUniform = false;
    int components = 1;  ///< 1 or 3
    std::string unit;    ///< UCUM code by the dimensions, such as "m2/s2"; "1" without
};

/// Reads a file of OpenFOAM from its beginning.
/// All functions return BadField with the line where the file ends too early or has something else.
/// Memory: that of the result, which takes at most four times that of the text.
class FoamReader {
public:
    /// \param bytes  must outlive the object
    /// \return a reader behind the header
    [[nodiscard]] static Result<FoamReader> open(std::string_view bytes, const std::filesystem::path& path);

    [[nodiscard]] const FoamHeader& header() const noexcept { return header_; }

    [[nodiscard]] Result<std::vector<std::int64_t>> labels();
    /// \param components  numbers of each entry: 1, or 3 in brackets
    [[nodiscard]] Result<std::vector<double>> scalars(int components);
    /// Lists of labels, such as the points of faces: the first entry of each list in `labels`, and one more.
    struct Lists {
        std::vector<std::int64_t> starts, labels;
    };
    [[nodiscard]] Result<Lists> lists();
    /// The dimensions and the values of a volScalarField or volVectorField.
    [[nodiscard]] Result<FoamField> field();

private:
    FoamReader(std::string_view bytes, std::filesystem::path path)
        : bytes_(bytes), rest_(bytes), path_(std::move(path)) {}

    [[nodiscard]] Error fault(std::string_view expected) const;
    void skipBlanks() noexcept;
    [[nodiscard]] bool take(char c) noexcept;
    [[nodiscard]] Result<void> expect(char c);
    [[nodiscard]] std::string_view word() noexcept;
    [[nodiscard]] Result<double> number();
    [[nodiscard]] Result<std::int64_t> label();
    [[nodiscard]] Result<std::uint64_t> count(std::uint64_t least);
    [[nodiscard]] Result<std::string_view> raw(std::uint64_t count, std::uint64_t size);
    [[nodiscard]] Result<void> readHeader();
    [[nodiscard]] Result<void> skipEntry();
    [[nodiscard]] Result<std::string> dimensions();
    [[nodiscard]] Result<void> tuple(int components, std::vector<double>& to);
    [[nodiscard]] Result<void> internalValues(FoamField& to);

    std::string_view bytes_, rest_;
    std::filesystem::path path_;
    FoamHeader header_;
};

/// The bytes of a file, or of the same name with `.gz`, unpacked.
/// \return or CannotOpen; InputTooBig beyond maxBytes; BadField for damaged compression
[[nodiscard]] Result<std::string> foamBytes(const std::filesystem::path& path, std::uint64_t maxBytes);

}  // namespace svt::field_readers
