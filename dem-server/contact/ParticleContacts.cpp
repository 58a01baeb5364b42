// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "contact/ParticleContacts.t.hpp"

namespace gimdem
{

extern template void ParticleContacts::sum_pairs<exec::Hexadecad>(ParticleState&, NeighborList&, double, BorderForce*);

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    static_assert(sizeof(BorderForce) == 2 * sizeof(Quad));
    list.spare.resize(2 * list.border.by_second.members.size());
    auto* const border = reinterpret_cast<BorderForce*>(list.spare.view().data);
    if (is_single_)
        sum_pairs<exec::Hexadecad>(particles, list, dt, border);
    else
        sum_pairs<exec::Octet>(particles, list, dt, border);
    exec::for_each(execution_, particles.count(), BorderKernel{particles.view(), list.view(), border});
}

}  // namespace gimdem
