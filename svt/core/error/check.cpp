#include <svt/core/check.hpp>

#include <cstdio>
#include <cstdlib>

namespace svt {

void checkFailed(const char* condition, const std::string& values, const char* file, int line) noexcept {
    std::fprintf(stderr, "svt: internal check failed: %s%s%s%s (%s:%d)\n", condition, values.empty() ? "" : " [",
                 values.c_str(), values.empty() ? "" : "]", file, line);
    std::abort();
}

}  // namespace svt
