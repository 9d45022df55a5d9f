#include <svt/readers/textures/image_files.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/gml/gml_numbers.hpp>
#include <svt/readers/gml/percent_decoded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

namespace svt::readers::textures {
namespace {

using std::string_view;
namespace fs = std::filesystem;

constexpr std::uint64_t kMaxWorldBytes = 4096;

// The path that a name means, or nothing if it is absolute or an address.
std::optional<fs::path> relativePath(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.find("://") != std::string::npos || name.starts_with('/') || name.starts_with("data:")) return {};
    if (name.find('\0') != std::string::npos || (name.size() > 1 && name[1] == ':')) return {};
    return fs::path(name).lexically_normal();
}

bool isBelow(const fs::path& path, const fs::path& folder) {
    const auto [inFolder, inPath] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return inFolder == folder.end() && inPath != path.end();
}

}  // namespace

ImageFiles::ImageFiles(const fs::path& folder) {
    std::error_code error;
    if (!folder.empty()) folder_ = fs::canonical(folder, error);
    if (error) folder_.clear();
}

Result<fs::path> ImageFiles::pathOf(string_view name) const {
    if (folder_.empty()) return Error(Code::CannotOpen, "the model is not a file in a folder");
    const std::string text(withoutBlanks(name));
    if (text.empty()) return Error(Code::BadImage, "the model does not name its file");
    const std::string decoded = gml::percentDecoded(text);
    for (const std::string& candidate : {text, decoded}) {
        const auto relative = relativePath(candidate);
        if (!relative)
            return Error(Code::BadImage,
                         "it is not named by a path relative to the model; only files beside the model are read");
        std::error_code error;
        const fs::path path = fs::canonical(folder_ / *relative, error);
        if (error) continue;
        if (!isBelow(path, folder_))
            return Error(Code::BadImage, "it lies outside the folder of the model; only files in this folder are read");
        return path;
    }
    return Error(Code::CannotOpen, "the file is missing");
}

Result<FileBytes> ImageFiles::read(string_view name) const {
    SVT_TRY(path, pathOf(name));
    return FileBytes::read(*path, kMaxImageBytes);
}

std::optional<WorldPlace> ImageFiles::worldPlace(string_view name) const {
    const std::size_t dot = name.rfind('.');
    if (dot == string_view::npos || name.size() < dot + 4) return std::nullopt;
    const std::string stem(name.substr(0, dot + 1));
    const string_view ending = name.substr(dot + 1);
    // The first and the last letter of the ending and a w: jgw of jpg.
    for (const std::string& candidate :
         {stem + ending.front() + ending.back() + "w", stem + std::string(ending) + "w", stem + "wld"}) {
        const auto path = pathOf(candidate);
        if (!path) continue;
        const auto file = FileBytes::read(*path, kMaxWorldBytes);
        if (!file) continue;
        std::vector<double> n;
        if (!gml::parseNumbers(file->text(), n).empty() || n.size() != 6) continue;
        return WorldPlace{n[0], n[2], n[1], n[3], n[4], n[5]};
    }
    return std::nullopt;
}

}  // namespace svt::readers::textures
