// SPDX-License-Identifier: BSD-3-Clause
#include "transport/FramePool.hpp"

#include <mutex>
#include <utility>
#include <vector>

namespace gimdem::coupling::transport
{
namespace
{

/// Below this, the allocator's own lists are as good.
std::size_t constexpr small = 16 << 10;
/// A step sends fewer arrays than this, so that no more are on their way at a time.
std::size_t constexpr capacity = 16;

}  // namespace

struct FramePool::Store
{
    struct Block
    {
        std::unique_ptr<unsigned char[]> bytes;
        std::size_t size = 0;
        std::shared_ptr<Store> home;  ///< while the block is away
    };

    std::unique_ptr<Block> take(std::size_t size)
    {
        std::lock_guard<std::mutex> const lock(mutex);
        for (auto& block : blocks)
        {
            if (block->size != size) continue;
            std::swap(block, blocks.back());
            auto taken = std::move(blocks.back());
            blocks.pop_back();
            return taken;
        }
        return nullptr;
    }

    void put(std::unique_ptr<Block> block)
    {
        std::lock_guard<std::mutex> const lock(mutex);
        if (blocks.size() < capacity) blocks.push_back(std::move(block));
    }

    /// ZeroMQ has sent the bytes.
    static void give_back(void* /*bytes*/, void* hint)
    {
        std::unique_ptr<Block> block(static_cast<Block*>(hint));
        auto const home = std::move(block->home);
        home->put(std::move(block));
    }

    std::mutex mutex;
    std::vector<std::unique_ptr<Block>> blocks;
};

FramePool::FramePool() : store_(std::make_shared<Store>()) {}

Frame FramePool::make(std::size_t bytes) const
{
    if (bytes < small) return Frame(bytes);
    auto block = store_->take(bytes);
    if (!block)
    {
        block = std::make_unique<Store::Block>();
        block->bytes.reset(new unsigned char[bytes]);
        block->size = bytes;
    }
    block->home = store_;
    Store::Block* const away = block.release();
    return Frame(away->bytes.get(), bytes, &Store::give_back, away);
}

}  // namespace gimdem::coupling::transport
