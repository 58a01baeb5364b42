// SPDX-License-Identifier: BSD-3-Clause
/// Room to work in for the time of one call, in arrays that mean nothing meanwhile. What does not fit there gets memory
/// of its own, which is kept for the next time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "exec/Buffer.hpp"

namespace gimdem::exec
{

class Room
{
public:
    /// Forgets what was lent and taken before.
    void clear()
    {
        lent_.clear();
        own_used_ = 0;
    }

    /// What is in the array is lost as places in it are taken. It must keep its memory until clear().
    template <class T>
    void lend(Buffer<T>& array)
    {
        lent_.push_back(std::as_writable_bytes(array.host()));
    }

    /// Place for `count` elements, nothing in them yet.
    template <class T>
    T* take(std::int64_t count)
    {
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= line);
        std::size_t const bytes = (static_cast<std::size_t>(count) * sizeof(T) + line - 1) / line * line;
        for (std::span<std::byte>& left : lent_)
        {
            if (left.size() < bytes) continue;
            std::byte* const place = left.data();
            left = left.subspan(bytes);
            return reinterpret_cast<T*>(place);
        }
        if (own_used_ == own_.size()) own_.emplace_back();
        Buffer<std::byte>& own = own_[own_used_++];
        own.resize(static_cast<std::int64_t>(bytes));
        return reinterpret_cast<T*>(own.view().data);
    }

private:
    static constexpr std::size_t line = 64;  ///< arrays begin on one, and so do the places in them

    std::vector<std::span<std::byte>> lent_;
    std::vector<Buffer<std::byte>> own_;
    std::size_t own_used_ = 0;
};

}  // namespace gimdem::exec
