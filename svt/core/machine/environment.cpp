#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <cstdlib>

namespace svt {
namespace {

namespace fs = std::filesystem;

// The path in an environment variable, as the command writes paths; empty if it is not absolute.
fs::path absolutePathIn(const char* name) {
    const char* value = std::getenv(name);
    if (value == nullptr) return {};
    fs::path path = userPath(value);
    const std::string text = path.string();
    const bool hasDrive = text.size() > 2 && text[1] == ':' && text[2] == '/';  // Windows, under Node.js
    return path.is_absolute() || hasDrive ? path : fs::path();
}

}  // namespace

fs::path settingsFolder() {
    if (fs::path given = absolutePathIn("XDG_CONFIG_HOME"); !given.empty()) return given;
    if (fs::path ofWindows = absolutePathIn("APPDATA"); !ofWindows.empty()) return ofWindows;
    const fs::path home = absolutePathIn("HOME");
    return home.empty() ? home : home / ".config";
}

bool isInEnvironment(const char* name) noexcept {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
}

}  // namespace svt
