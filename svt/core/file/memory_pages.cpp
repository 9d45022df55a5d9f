#include <svt/core/machine.hpp>

#if defined(__linux__)
#include <malloc.h>
#endif

namespace svt {

void returnFreeMemory() noexcept {
#if defined(__GLIBC__)
    ::malloc_trim(0);
#endif
}

}  // namespace svt
