// The packet kernel for AVX-512.
#define SVT_KERNEL_TARGET HWY_AVX3
#if defined(__x86_64__) || defined(_M_X64)
#include <svt/render/packet/packet_kernel-inl.hpp>
#endif
