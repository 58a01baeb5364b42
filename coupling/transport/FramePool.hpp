// SPDX-License-Identifier: BSD-3-Clause
/// Memory for large frames that are sent again and again.
#pragma once

#include <cstddef>
#include <memory>

#include "transport/Frames.hpp"

namespace gimdem::coupling::transport
{

/// Hands out frames whose bytes come back here once they are sent. Fresh memory would cost a page fault every 4 KiB,
/// about a third of an exchange. Copies of a pool share its memory; any thread.
class FramePool
{
public:
    FramePool();

    /// A frame of so many bytes, not initialised.
    Frame make(std::size_t bytes) const;

private:
    struct Store;
    std::shared_ptr<Store> store_;
};

}  // namespace gimdem::coupling::transport
