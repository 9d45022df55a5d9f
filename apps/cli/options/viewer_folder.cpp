#include <apps/cli/options/viewer_folder.hpp>

#include <svt/core/file.hpp>

#include <system_error>

namespace svt::cli {

Result<std::filesystem::path> findViewerFolder(const std::filesystem::path& given) {
    std::error_code error;
    const std::filesystem::path folder =
        !given.empty() ? given : executablePath().parent_path().parent_path() / "share/svt/viewer";
    if (std::filesystem::is_regular_file(folder / "index.html", error)) return folder;
    return Error(Code::CannotOpen,
                 "no viewer is here: index.html is missing; `make viewer` builds one, --viewer names "
                 "another folder",
                 Place{folder.string(), 0, 0, {}});
}

}  // namespace svt::cli
