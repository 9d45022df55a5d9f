#include <svt/core/machine.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace svt {
namespace {

TEST(MemoryPages, MemoryInUseKeepsItsBytes) {
    const std::vector<std::byte> bytes(8 << 20, std::byte{7});
    returnFreeMemory();
    EXPECT_EQ(bytes, std::vector<std::byte>(8 << 20, std::byte{7}));
}

}  // namespace
}  // namespace svt
