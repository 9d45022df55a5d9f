#include <svt/core/file.hpp>

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#ifdef __EMSCRIPTEN__
#include <emscripten.h>

// Facts about the system from Node.js: web/npm/lib/host.mjs. The module of a page has no such host.
// clang-format off
EM_JS(int, svtHostIsErrorTerminal, (), { return Module["host"] && Module["host"]["isErrorTerminal"] ? 1 : 0; })
EM_JS(int, svtHostIsOutputTerminal, (), { return Module["host"] && Module["host"]["isOutputTerminal"] ? 1 : 0; })
EM_JS(int, svtHostIsWindows, (), { return Module["host"] && Module["host"]["isWindows"] ? 1 : 0; })
EM_JS(char*, svtHostProgram, (), {
    const text = new TextEncoder().encode((Module["host"] && Module["host"]["program"]) || "");
    const at = _malloc(text.length + 1);
    HEAPU8.set(text, at);
    HEAPU8[at + text.length] = 0;
    return at;
})
// clang-format on
#endif

namespace svt {

namespace fs = std::filesystem;

#ifdef __EMSCRIPTEN__

bool isErrorTerminal() noexcept { return svtHostIsErrorTerminal() != 0; }
bool isOutputTerminal() noexcept { return svtHostIsOutputTerminal() != 0; }

fs::path executablePath() {
    char* text = svtHostProgram();
    fs::path path(text);
    std::free(text);
    return path;
}

fs::path userPath(std::string text) {
    if (svtHostIsWindows() != 0) std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

#else

bool isErrorTerminal() noexcept { return ::isatty(STDERR_FILENO) != 0; }
bool isOutputTerminal() noexcept { return ::isatty(STDOUT_FILENO) != 0; }

fs::path executablePath() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

fs::path userPath(std::string text) { return text; }

#endif

PrivateFolder::PrivateFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "svt-XXXXXX").string();
    if (error) return;
    unfinished_ = Unfinished::path([&] {
        if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
        return path_;
    });
}

PrivateFolder::PrivateFolder(PrivateFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), unfinished_(std::move(other.unfinished_)) {}

PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace svt
