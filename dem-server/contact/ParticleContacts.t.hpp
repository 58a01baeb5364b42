// SPDX-License-Identifier: BSD-3-Clause
/// Body of ParticleContacts::sum_pairs, for the files that make it for one precision each.
#pragma once

#include "contact/ParticleContacts.hpp"
#include "exec/ForEach.hpp"

namespace gimdem
{

template <class Real>
void ParticleContacts::sum_pairs(ParticleState& particles, NeighborList& list, double dt)
{
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            auto const compute = [&]<bool one_material, bool one_size>(auto space)
            {
                exec::for_each_uneven(
                    execution_, list.block_count(),
                    PairKernel<Law, one_material, one_size, decltype(space), Real>{
                        particles.view(), list.view(), table.constants.view().data, material_count_, dt, space});
            };
            // Periodic scenes are few: one kernel serves them all.
            if (domain_.is_periodic())
                compute.template operator()<false, false>(domain_.space());
            else if (material_count_ > 1)
                compute.template operator()<false, false>(OpenSpace{});
            else if (Law::is_plain && one_size_)
                compute.template operator()<true, Law::is_plain>(OpenSpace{});
            else
                compute.template operator()<true, false>(OpenSpace{});
        });
}

}  // namespace gimdem
