// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SpatialOrder.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace gimdem
{

namespace
{

/// The bits of three numbers from 0 to 1023 by turns.
std::uint32_t interleaved(Vec3 const& at)
{
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        auto const number = static_cast<std::uint32_t>(std::clamp(at[axis], 0.0, 1023.0));
        for (int bit = 0; bit < 10; ++bit)
            key |= (number >> bit & 1u) << (3 * bit + axis);
    }
    return key;
}

}  // namespace

exec::Buffer<std::int32_t> spatial_order(PolyMesh const& mesh)
{
    double const per_length = 1023 / (mesh.high() - mesh.low()).maxCoeff();
    std::vector<std::uint32_t> key;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        key.push_back(interleaved((mesh.centroid(c) - mesh.low()) * per_length));
    exec::Buffer<std::int32_t> order(mesh.cell_count());
    std::iota(order.host().begin(), order.host().end(), 0);
    std::ranges::stable_sort(order.host(), {}, [&](std::int32_t c) { return key[static_cast<std::size_t>(c)]; });
    return order;
}

}  // namespace gimdem
