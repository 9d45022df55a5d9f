// The packet kernel for the instructions that every machine of the architecture has.
#define SVT_KERNEL_TARGET HWY_STATIC_TARGET
#include <svt/render/packet/packet_kernel-inl.hpp>
