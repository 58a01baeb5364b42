// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "exec/ForEach.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    BorderForce* const border = list.border.force.view().data;
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            auto const compute = [&]<bool one_material, bool one_size>(auto space)
            {
                exec::for_each_uneven(execution_, list.block_count(),
                                      PairKernel<Law, one_material, one_size, decltype(space)>{
                                          particles.view(), list.view(), table.constants.view().data, material_count_,
                                          dt, border, space});
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
    require_springs(list);
    exec::for_each(execution_, particles.count(), BorderKernel{particles.view(), list.view(), border});
}

}  // namespace gimdem
