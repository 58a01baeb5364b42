// SPDX-License-Identifier: BSD-3-Clause
/// Reductions whose result does not depend on the number of threads: fixed blocks are reduced in order, then the
/// blocks' results in order.
#pragma once

#include <algorithm>
#include <vector>

#include "exec/ForEach.hpp"

namespace gimdem::exec
{

/// Reduce value(i), i = 0..count-1, with combine(a, b), starting every block from `identity`.
template <class T, class Value, class Combine>
T reduce(Execution const& execution, Index count, T identity, Value value, Combine combine)
{
    constexpr Index block = 1024;
    Index const blocks = (count + block - 1) / block;
    std::vector<T> partial(static_cast<std::size_t>(blocks), identity);
    T* const out = partial.data();
    for_each(execution, blocks,
             [=](Index b)
             {
                 T sum = identity;
                 Index const end = std::min(count, (b + 1) * block);
                 for (Index i = b * block; i < end; ++i)
                     sum = combine(sum, value(i));
                 out[b] = sum;
             });
    T total = identity;
    for (T const& part : partial)
        total = combine(total, part);
    return total;
}

template <class Value>
double sum(Execution const& execution, Index count, Value value)
{
    return reduce(execution, count, 0.0, value, [](double a, double b) { return a + b; });
}

template <class Value>
double maximum(Execution const& execution, Index count, double identity, Value value)
{
    return reduce(execution, count, identity, value, [](double a, double b) { return a > b ? a : b; });
}

}  // namespace gimdem::exec
