// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.t.hpp"

namespace gimdem
{

template void ParticleContacts::sum_pairs<exec::Hexadecad>(ParticleState&, NeighborList&, double);

}  // namespace gimdem
