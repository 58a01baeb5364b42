// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "exec/ForEach.hpp"

namespace gimdem
{

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    border_.resize(list.border.by_second.members.size());
    auto const compute = [&]<bool one_material, bool one_size>()
    {
        exec::for_each_uneven(execution_, list.block_count(),
                              PairKernel<one_material, one_size>{particles.view(), list.view(), constants_.data,
                                                                 material_count_, dt, border_.view().data});
    };
    if (material_count_ > 1)
        compute.operator()<false, false>();
    else if (one_size_)
        compute.operator()<true, true>();
    else
        compute.operator()<true, false>();
    exec::for_each(execution_, particles.count(), BorderKernel{particles.view(), list.view(), border_.view().data});
}

}  // namespace gimdem
