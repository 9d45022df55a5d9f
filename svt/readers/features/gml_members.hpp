#pragma once
/// \file
/// Cuts a CityGML text into the children of its root, without reading into them.

#include <svt/readers/feature_file.hpp>
#include <svt/readers/features/text_stream.hpp>

#include <string>

namespace svt::readers::features {

class GmlMembers {
public:
    explicit GmlMembers(std::string fileName) : fileName_(std::move(fileName)) {}

    /// Reads the prolog and the root's start tag.
    Result<void> begin(TextStream& stream);
    /// The next member with features; other children of the root go to the head (envelope, names) or are left out.
    Result<bool> next(TextStream& stream, FeatureText& feature);
    /// The member that begins at the stream's window.
    Result<FeatureText> memberHere(TextStream& stream);

    /// A document of these members.
    [[nodiscard]] std::string document(std::span<const std::string_view> members) const;
    /// Lines before the first member of such a document.
    [[nodiscard]] std::uint64_t linesBefore() const noexcept { return lines_; }

private:
    Result<std::size_t> skipBlanks(TextStream& stream, std::size_t at);
    Result<std::size_t> endOfElement(TextStream& stream, std::size_t at);
    Result<std::size_t> endOfTag(TextStream& stream, std::size_t at, bool& isEmpty);
    Result<std::size_t> find(TextStream& stream, std::string_view what, std::size_t from);
    Result<bool> has(TextStream& stream, std::size_t at, std::string_view text);
    [[nodiscard]] Error cutOff(std::uint64_t offset) const;
    void countHead();

    std::string fileName_, head_, rootName_;
    std::uint64_t lines_ = 0;
    bool isEnd_ = false, hasFeatures_ = false;
};

}  // namespace svt::readers::features
