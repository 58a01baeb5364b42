// SPDX-License-Identifier: BSD-3-Clause
/// What is linear in space is largest in a corner.
#pragma once

#include "exec/Vector.hpp"

namespace gimdem
{

/// Calls visit(corner) for the eight corners of a box.
template <class Visit>
void visit_corners(Vec3 const& low, Vec3 const& high, Visit&& visit)
{
    for (int corner = 0; corner < 8; ++corner)
        visit(Vec3((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                   (corner & 4) != 0 ? high.z() : low.z()));
}

}  // namespace gimdem
