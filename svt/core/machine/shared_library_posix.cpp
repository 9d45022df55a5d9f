#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <dlfcn.h>

namespace svt {

Result<SharedLibrary> SharedLibrary::load(const std::string& name) {
    if (void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
    const char* reason = dlerror();
    return Error(Code::CannotOpen, fmt::format("cannot load {}: {}", name, reason ? reason : "no reason given"));
}

void* SharedLibrary::symbol(const char* name) const noexcept { return dlsym(handle_, name); }

}  // namespace svt
