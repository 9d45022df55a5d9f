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
                 "the viewer's page is missing: this folder has no index.html; `make viewer` builds it, --viewer names "
                 "another folder",
                 Place{folder.string(), 0, 0, {}});
}

}  // namespace svt::cli
