// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Takes the values of particles to their new order, which may name particles that had none: those get `of_new`.
template <class T>
void permute_with_new(exec::Buffer<T>& values, std::span<std::int32_t const> order, T const& of_new)
{
    std::int64_t const before = values.size(), after = std::ssize(order);
    values.resize(std::max(before, after));
    std::fill(values.host().begin() + before, values.host().end(), of_new);
    permute(values, order);
    values.resize(after);
}

}  // namespace gimdem
