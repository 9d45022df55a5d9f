#pragma once
/// \file
/// Image files beside a model.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace svt::readers::textures {

inline constexpr std::uint64_t kMaxImageBytes = std::uint64_t{64} << 20;

/// Reads files in the folder of a model and in the folders below it, and nothing else: no other folders, also by links
/// or "..", no devices, no network.
class ImageFiles {
public:
    /// \param folder  of the model; empty: no file is read
    explicit ImageFiles(const std::filesystem::path& folder);

    /// \param name  as the model names the file: relative, with '/' or '\'; "%20" is a blank where no file has that name
    /// \return the bytes; BadImage if the name leads out of the folder or to the network; CannotOpen if the file is
    ///         missing or unreadable; InputTooBig beyond kMaxImageBytes
    [[nodiscard]] Result<FileBytes> read(std::string_view name) const;

    /// The world file beside an image: "roof.jgw" or "roof.wld" beside "roof.jpg".
    [[nodiscard]] std::optional<WorldPlace> worldPlace(std::string_view name) const;

private:
    [[nodiscard]] Result<std::filesystem::path> pathOf(std::string_view name) const;

    std::filesystem::path folder_;  // canonical
};

}  // namespace svt::readers::textures
