// SPDX-License-Identifier: BSD-3-Clause
/// Reductions on a device, in an order that depends on the number of values alone: each entry takes `fan` of the ones
/// before, until one is left.
#pragma once

#include "exec/device/DeviceArray.hpp"

namespace gimdem::exec
{

namespace detail
{

inline constexpr Index reduce_fan = 32;

/// values(i) for i in a run of `fan`, combined. A Combine has identity() and operator()(a, b).
template <class T, class Values, class Combine>
struct FanIn
{
    Values values;
    Combine combine;
    Index count;
    T* to;

    GIMDEM_HD void operator()(Index b) const
    {
        Index const end = (b + 1) * reduce_fan < count ? (b + 1) * reduce_fan : count;
        T sum = combine.identity();
        for (Index i = b * reduce_fan; i < end; ++i)
            sum = combine(sum, values(i));
        to[b] = sum;
    }
};

template <class T>
struct Stored
{
    T const* values;
    GIMDEM_HD T operator()(Index i) const { return values[i]; }
};

}  // namespace detail

/// Reduces values of one type on one device; keeps what it needs for the next time.
template <class Device, class T>
class DeviceReduce
{
public:
    explicit DeviceReduce(Device& device) : device_(device), result_(device) {}

    /// combine of values(i), i = 0..count-1; waits for it. Both are functors that kernels can hold.
    template <class Values, class Combine>
    T operator()(Index count, Values const& values, Combine const& combine)
    {
        using namespace detail;
        if (count == 0) return combine.identity();
        Index n = (count + reduce_fan - 1) / reduce_fan;
        from_.resize(device_, n);
        device_.for_each(n, FanIn<T, Values, Combine>{values, combine, count, from_.data()});
        while (n > 1)
        {
            Index const left = (n + reduce_fan - 1) / reduce_fan;
            to_.resize(device_, left);
            device_.for_each(left, FanIn<T, Stored<T>, Combine>{{from_.data()}, combine, n, to_.data()});
            swap(from_, to_);
            n = left;
        }
        return result_.read(from_.data());
    }

private:
    Device& device_;
    DeviceArray<Device, T> from_, to_;
    DeviceScalar<Device, T> result_;
};

}  // namespace gimdem::exec
