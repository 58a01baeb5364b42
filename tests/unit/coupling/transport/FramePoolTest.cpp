// SPDX-License-Identifier: BSD-3-Clause
#include "transport/FramePool.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <optional>
#include <vector>

namespace gimdem::coupling::transport
{
namespace
{

std::size_t constexpr large = std::size_t{64} << 20;  // malloc maps blocks above 32 MiB one by one; nobody touches them

TEST(FramePool, GivesABlockAgainToFramesOfItsSizeAlone)
{
    FramePool const pool;
    std::optional<Frame> first = pool.make(large);
    void const* const block = first->data();
    first.reset();

    Frame const smaller = pool.make(large / 2);
    EXPECT_EQ(smaller.size(), large / 2);
    EXPECT_NE(smaller.data(), block);
    Frame const again = pool.make(large);
    EXPECT_EQ(again.size(), large);
    EXPECT_EQ(again.data(), block);
}

TEST(FramePool, KeepsSixteenBlocksAtMost)
{
    FramePool const pool;
    auto const before = ::mallinfo2().hblks;
    std::vector<Frame> frames;
    for (int k = 0; k < 20; ++k)
        frames.push_back(pool.make(large));
    frames.clear();

    EXPECT_LE(::mallinfo2().hblks - before, 16u);
}

TEST(FramePool, MayEndBeforeItsFrames)
{
    std::optional<FramePool> pool(std::in_place);
    Frame const frame = pool->make(large);
    pool.reset();
    EXPECT_EQ(frame.size(), large);
}

}  // namespace
}  // namespace gimdem::coupling::transport
