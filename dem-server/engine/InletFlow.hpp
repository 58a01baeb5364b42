// SPDX-License-Identifier: BSD-3-Clause
/// From inlets into a system.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/DemSystem.hpp"
#include "particles/Inlet.hpp"

namespace gimdem
{

/// The inlets of a case, at their start.
inline std::vector<Inlet> make_inlets(Case const& settings, Materials const& materials)
{
    std::vector<Inlet> inlets;
    for (InletSettings const& inlet : settings.inlets)
        inlets.emplace_back(inlet, materials, Domain::of(settings.domain));
    return inlets;
}

/// Inserts what is due at `time` [s]; returns how many particles came.
inline std::int64_t insert_from(std::vector<Inlet>& inlets, double time, DemSystem& system)
{
    std::int64_t count = 0;
    for (Inlet& inlet : inlets)
    {
        if (!inlet.is_due(time)) continue;
        ParticleState more;
        append(inlet.take(time, system.particles()), inlet.material(), inlet.density(), 0, more);
        count += more.count();
        system.insert(more);
    }
    return count;
}

}  // namespace gimdem
