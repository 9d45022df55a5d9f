#pragma once
/// \file
/// A property table of EXT_structural_metadata: columns of strings and numbers in a binary buffer, one row per
/// component.

#include <svt/volume/label_table.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::writers {

/// The binary buffer of a glTF: pieces that each begin at a multiple of 8 bytes, with their buffer views.
class GltfBuffer {
public:
    using Json = nlohmann::ordered_json;

    /// \param isCompressed  views that addVertices() and addIndices() add have the form of EXT_meshopt_compression
    explicit GltfBuffer(bool isCompressed = false) : isCompressed_(isCompressed) {}

    /// \param stride  bytes from vertex to vertex; 0: no vertices
    /// \param target  of OpenGL; 0: none
    /// \return the number of the buffer view
    std::size_t add(std::span<const std::byte> bytes, int stride = 0, int target = 0);

    /// \param bytes  as they are when decoded
    /// \param each   bytes of a vertex, a multiple of 4, or of an index, 2 or 4
    std::size_t addVertices(std::span<const std::byte> bytes, std::size_t each, int target);
    /// Indices of vertices, or any numbers that mostly grow in equal steps.
    std::size_t addIndices(std::span<const std::uint32_t> indices, std::size_t each, int target);

    /// Bytes of the decoded views; 0: nothing is compressed. They are a second buffer, which no file has.
    [[nodiscard]] std::size_t decodedBytes() const noexcept { return decoded_; }
    [[nodiscard]] const Json& views() const noexcept { return views_; }
    [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

private:
    std::size_t addCompressed(const std::string& packed, const char* mode, std::size_t count, std::size_t each,
                              int target);

    Json views_ = Json::array();
    std::string bytes_;
    std::size_t decoded_ = 0;
    bool isCompressed_ = false;
};

/// The attributes of a label as a JSON object, for a column: single values as texts, several values as arrays. Empty
/// without attributes.
[[nodiscard]] std::string attributesText(const volume::Label& label);

/// Columns of a table of one class.
class PropertyTable {
public:
    using Json = nlohmann::ordered_json;

    PropertyTable(GltfBuffer& buffer, std::size_t rows) : buffer_(buffer), rows_(rows) {}

    /// \param description  empty: none
    void strings(const char* name, std::string_view description, const std::vector<std::string>& values);
    /// The column "name", unless each name is empty or the id.
    void namesBesideIds(const std::vector<std::string>& names, const std::vector<std::string>& ids);
    /// Texts that repeat, as an enumeration: each text once in the schema, and its number in each row.
    void names(const char* name, std::string_view description, const std::vector<std::string>& values);
    /// The column of attributesText(). Readers that know defaults see {} for an empty text.
    void attributes(const std::vector<std::string>& values);
    /// As 32-bit floats, which hold seven digits.
    void numbers(const char* name, std::string_view description, const std::vector<double>& values);
    /// Numbers of which 0 means that the value is unknown (`noData`).
    void knownNumbers(const char* name, std::string_view description, const std::vector<double>& values);

    /// The extension: schema with the class `name`, and the table.
    [[nodiscard]] Json extension(const char* name) const;

private:
    // In the smallest type that holds them, of two or four bytes.
    void addOffsets(const std::vector<std::uint32_t>& offsets, Json& column);
    // \return the view and the type
    std::pair<std::size_t, const char*> addSmall(const std::vector<std::uint32_t>& values);

    GltfBuffer& buffer_;
    std::size_t rows_;
    Json class_ = Json::object(), table_ = Json::object(), enums_ = Json::object();
};

}  // namespace svt::writers
