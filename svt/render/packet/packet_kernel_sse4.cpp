// The packet kernel for SSE4.1.
#define SVT_KERNEL_TARGET HWY_SSE4
#if defined(__x86_64__) || defined(_M_X64)
#include <svt/render/packet/packet_kernel-inl.hpp>
#endif
