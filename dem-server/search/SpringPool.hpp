// SPDX-License-Identifier: BSD-3-Clause
/// The springs of the pairs of one block that touch. A pair has a slot here while it touches and none otherwise; which
/// slot it is has no influence on any result.
#pragma once

#include <cstdint>
#include <cstring>
#include <new>

#include "exec/Buffer.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// Three numbers, without the fourth of a Quad: most of the memory of a bed is springs.
using Spring = Constant3;

class SpringPool
{
public:
    using Slot = std::uint16_t;
    static constexpr Slot none = 0xffff;

    /// Slots 0 ... count - 1 are taken, what is in them is to be set; all others are free.
    void reset(std::int64_t count, bool rolls)
    {
        rolls_ = rolls;
        resize(count);
        free_ = none;
        is_short_ = false;
    }

    /// A slot with springs at rest. None where memory has run out or the block has as many contacts as slots have
    /// numbers: is_short() tells.
    Slot take() noexcept
    {
        Slot const slot = free_ != none ? next_free() : next_new();
        if (slot == none) return none;
        tangential_[slot] = {0, 0, 0};
        if (rolls_) rolling_[slot] = {0, 0, 0};
        return slot;
    }

    /// The pair touches no more.
    void give_back(Slot slot)
    {
        std::memcpy(&tangential_[slot], &free_, sizeof free_);
        free_ = slot;
    }

    bool is_short() const { return is_short_; }

    // Of each slot. Behind the last one a spring may be read, but means nothing: kernels load four numbers for three.
    Spring* tangential() { return tangential_.view().data; }              ///< [m]
    Spring* rolling() { return rolling_.view().data; }                    ///< torque on the first [N m]
    Spring const* tangential() const { return tangential_.view().data; }  ///< [m]
    Spring const* rolling() const { return rolling_.view().data; }        ///< [N m]

private:
    void resize(std::int64_t count)
    {
        tangential_.resize(count + 1);
        rolling_.resize(rolls_ ? count + 1 : 0);
        count_ = count;
    }

    Slot next_free()
    {
        Slot const slot = free_;
        std::memcpy(&free_, &tangential_[slot], sizeof free_);
        return slot;
    }

    Slot next_new() noexcept
    {
        is_short_ |= count_ >= none;
        if (is_short_) return none;
        try
        {
            resize(count_ + 1);
        }
        catch (std::bad_alloc const&)
        {
            is_short_ = true;
            return none;
        }
        return static_cast<Slot>(count_ - 1);
    }

    exec::Buffer<Spring> tangential_, rolling_;
    std::int64_t count_ = 0;  ///< slots that are taken or were
    Slot free_ = none;        ///< the last one given back, which holds the number of the one before, and so on
    bool rolls_ = false, is_short_ = false;
};

}  // namespace gimdem
