#include <svt/core/check.hpp>

#include <cstdio>
#include <cstdlib>

namespace svt {
void checkFailed(const char* condition, const char* file, int line) noexcept {
    std::fprintf(stderr, "svt: internal check failed: %s (%s:%d)\n", condition, file, line);
    std::abort();
}
}  // namespace svt
