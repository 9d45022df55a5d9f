// Replaces machine_posix.cpp where a program knows nothing of the machine: in browsers, and as WebAssembly elsewhere.
#include <svt/core/machine.hpp>

#include <emscripten.h>

// A fact from Node.js: web/npm/bin/svt.mjs. The module of a page has no such host.
// clang-format off
EM_JS(int, svtHostHasDesktop, (), {
    const host = Module["host"];
    return host && "hasDesktop" in host ? Number(host["hasDesktop"]) : -1;
})
// clang-format on

namespace svt {

MemoryFigures memoryFigures() { return {}; }

void limitMemory(std::uint64_t, std::string_view) {}
void limitMemoryToMachine() {}
void unlimitMemory() {}
void allowMoreOpenFiles(std::size_t) noexcept {}

std::optional<int> machineCores() noexcept { return {}; }

std::optional<double> grantedCores() { return {}; }

// Emscripten's file system invents a figure.
std::optional<std::uint64_t> freeBytes(const std::filesystem::path&) { return {}; }

std::optional<bool> hasDesktop() noexcept {
    const int answer = svtHostHasDesktop();
    return answer < 0 ? std::nullopt : std::optional(answer == 1);
}

std::filesystem::path findProgram(std::string_view) { return {}; }

OwnProcessResult inOwnProcess(double, const std::function<void(const Say&)>& work) {
    OwnProcessResult result;
    work([&result](std::string_view text) { result.text += text; });
    return result;
}

Result<SharedLibrary> SharedLibrary::load(const std::string& name) {
    return Error(Code::CannotOpen, "cannot load " + name + ": not on this system");
}

void* SharedLibrary::symbol(const char*) const noexcept { return nullptr; }

}  // namespace svt
