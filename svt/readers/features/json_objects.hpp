#pragma once
/// \file
/// A CityJSON document as CityJSONFeatures: each object without parent, with all objects below it and the vertices that
/// they use.

#include <svt/core/result.hpp>
#include <svt/readers/feature_file.hpp>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace svt::readers::features {

/// The header of a CityJSONSeq, as a line: the members of a document except for objects, vertices and textures.
/// \param object  a CityJSON object
[[nodiscard]] Result<std::string> headOf(std::string_view object, const std::string& fileName);

class JsonObjects {
public:
    /// \param text  a CityJSON document; must outlive the object
    /// Memory: about 100 bytes per object, half a byte per vertex.
    [[nodiscard]] static Result<JsonObjects> open(std::string_view text, const std::string& fileName);

    /// Objects without parent (or whose parents are missing), in the order of the text.
    [[nodiscard]] std::size_t count() const noexcept { return tops_.size(); }
    [[nodiscard]] FeatureSpan spanOf(std::size_t top) const noexcept;
    /// Number of the feature that begins at an offset; count() if none does.
    [[nodiscard]] std::size_t findAt(std::uint64_t begin) const noexcept;
    /// A feature as a line of CityJSONSeq.
    [[nodiscard]] std::string line(std::size_t top) const;

private:
    struct Object {
        std::uint64_t keyBegin = 0, begin = 0, end = 0;
        std::string_view key;
        std::vector<std::uint32_t> children;
        bool hasParent = false;
    };
    using Numbers = std::unordered_map<std::uint64_t, std::uint32_t>;

    void connect();
    void appendObject(const Object& object, Numbers& numbers, std::string& to) const;
    void appendBoundaries(std::string_view boundaries, Numbers& numbers, std::string& to) const;
    [[nodiscard]] std::string_view vertex(std::uint64_t number) const;

    std::string_view text_;
    std::vector<Object> objects_;
    std::vector<std::uint32_t> tops_;
    std::vector<std::uint64_t> vertexMarks_;  // offset of each 16th vertex
    std::uint64_t vertexCount_ = 0;
};

}  // namespace svt::readers::features
