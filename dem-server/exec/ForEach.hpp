// SPDX-License-Identifier: BSD-3-Clause
/// Launch a kernel over an index range. A kernel is a trivially copyable functor over views, operator()(index); calls
/// with different indices must not write the same place, so that any order and any thread count give the same bits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "exec/Execution.hpp"

namespace gimdem::exec
{

using Index = std::int64_t;

template <class Kernel>
void for_each(Execution const& execution, Index count, Kernel kernel)
{
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel must be a trivially copyable functor over views");
    if (execution.backend == Backend::serial || execution.threads == 1)
    {
        for (Index i = 0; i < count; ++i)
            kernel(i);
        return;
    }
#pragma omp parallel for schedule(static) num_threads(execution.threads)
    for (Index i = 0; i < count; ++i)
        kernel(i);
}

/// The same for calls that differ much in work: threads take some as they become free.
template <class Kernel>
void for_each_uneven(Execution const& execution, Index count, Kernel kernel)
{
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel must be a trivially copyable functor over views");
    if (execution.backend == Backend::serial || execution.threads == 1) return for_each(execution, count, kernel);
    Index const some = std::max<Index>(1, count / (16 * execution.threads));
#pragma omp parallel for schedule(dynamic, some) num_threads(execution.threads)
    for (Index i = 0; i < count; ++i)
        kernel(i);
}

}  // namespace gimdem::exec
