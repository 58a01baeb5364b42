// SPDX-License-Identifier: BSD-3-Clause
/// A device for tests, made of the host: its memory is closed to the host's code outside of kernels and copies, kernels
/// run in another order each time and may hold no pointer of the host, and a copy to the host arrives with wait() and
/// no sooner. What works here does not depend on an order, and forgets no copy and no wait.
#pragma once

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>
#include <typeinfo>
#include <vector>

#include "exec/device/DeviceArray.hpp"
#include "exec/guarded/GuardedMemory.hpp"

namespace gimdem::exec
{

class GuardedDevice
{
public:
    /// `seed` decides about the orders; kernels run on `threads`.
    explicit GuardedDevice(unsigned seed = 1, int threads = 1) : random_(seed), threads_(threads) {}

    void* allocate(std::size_t bytes) { return memory_.allocate(bytes); }
    void free(void* p) { memory_.free(p); }
    void* allocate_pinned(std::size_t bytes) { return ::operator new (bytes, std::align_val_t{64}); }
    void free_pinned(void* p) { ::operator delete (p, std::align_val_t{64}); }

    void copy_in(void* device, void const* host, std::size_t bytes)
    {
        auto const opened = memory_.open(device, "copy_in");
        std::memcpy(device, host, bytes);
    }
    void copy_out(void* host, void const* device, std::size_t bytes)
    {
        auto const opened = memory_.open(device, "copy_out");
        auto const* const from = static_cast<char const*>(device);
        on_their_way_.push_back({host, {from, from + bytes}});
        std::memset(host, 0xff, bytes);
    }
    void copy(void* to, void const* from, std::size_t bytes)
    {
        auto const opened_to = memory_.open(to, "copy");
        auto const opened_from = memory_.open(from, "copy");
        std::memcpy(to, from, bytes);
    }
    void zero(void* device, std::size_t bytes)
    {
        auto const opened = memory_.open(device, "zero");
        std::memset(device, 0, bytes);
    }
    void wait() { arrive(on_their_way_.size()); }
    void mark() { marked_ = on_their_way_.size(); }
    void wait_for_mark() { arrive(marked_); }

    template <class Kernel>
    void for_each(Index count, Kernel kernel)
    {
        static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel must be a trivially copyable functor over views");
        if (count == 0) return;
        // Padding holds whatever was there. A copy, as g++ 12 also clears members that follow an array of structures.
        Kernel cleared = kernel;
#if __has_builtin(__builtin_clear_padding)
        __builtin_clear_padding(&cleared);
#endif
        auto const opened = memory_.open_for_kernel(&kernel, &cleared, sizeof kernel, typeid(Kernel).name());
        auto const [step, start] = shuffle(count);
#pragma omp parallel for schedule(static) num_threads(threads_)
        for (Index k = 0; k < count; ++k)
            kernel((step * k + start) % count);
    }

    template <class Kernel>
    void for_each_beside(Index count, Kernel const& kernel)
    {
        for_each(count, kernel);
    }
    void fork() {}
    void join() {}

    // It has no library.
    bool scan_by_library(View<std::int32_t>)
    {
        return false;
    }
    bool sort_by_library(View<std::int32_t const>, std::int32_t*, int, std::int32_t*, std::int32_t*)
    {
        return false;
    }

    std::size_t allocations() const
    {
        return memory_.allocations();
    }  ///< since the beginning

private:
    struct Arrival
    {
        void* host;
        std::vector<char> bytes;
    };
    struct Order
    {
        Index step, start;
    };

    /// k -> (step k + start) mod count takes every number once, as the step has no factor in common with the count.
    /// Counts are below 2^31, so that the product has room.
    Order shuffle(Index count)
    {
        auto const next = [this](Index below)
        {
            random_ = random_ * 6364136223846793005u + 1442695040888963407u;
            return static_cast<Index>((random_ >> 33) % static_cast<std::uint64_t>(below));
        };
        Index step = 1 + next(count);
        while (std::gcd(step, count) != 1)
            ++step;
        return {step, next(count)};
    }

    /// The first `count` copies on their way arrive.
    void arrive(std::size_t count)
    {
        for (std::size_t k = 0; k < count; ++k)
            std::memcpy(on_their_way_[k].host, on_their_way_[k].bytes.data(), on_their_way_[k].bytes.size());
        on_their_way_.erase(on_their_way_.begin(), on_their_way_.begin() + static_cast<std::ptrdiff_t>(count));
        marked_ -= std::min(marked_, count);
    }

    GuardedMemory memory_;
    std::uint64_t random_;
    int threads_;
    std::vector<Arrival> on_their_way_;
    std::size_t marked_ = 0;  ///< how many of them were asked for before the last mark
};

}  // namespace gimdem::exec
