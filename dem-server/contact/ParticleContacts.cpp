// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "contact/ParticleContacts.t.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

extern template void ParticleContacts::sum_pairs<exec::Hexadecad>(ParticleState&, NeighborList&, double);

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    if (is_single_)
        sum_pairs<exec::Hexadecad>(particles, list, dt);
    else
        sum_pairs<exec::Octet>(particles, list, dt);
    require_springs(list);
    exec::for_each(execution_, particles.count(),
                   BorderKernel{particles.view(), list.view(), list.border.force.view().data});
}

}  // namespace gimdem
