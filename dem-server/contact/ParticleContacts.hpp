// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles. Each contact is computed once; then each particle sums its contacts in stored order, so
/// the result does not depend on the number of threads.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// What one pair of the list does: one line of the cache.
struct alignas(64) PairForce
{
    Quad force;   ///< on the first particle [N]; of a pair that does not touch it means nothing
    Quad torque;  ///< normal x tangential force [N], w: overlap [m]
};

class ParticleContacts
{
public:
    ParticleContacts(exec::Execution execution, Materials const& materials, Domain const& domain = {})
        : execution_(execution), constants_(materials.table()), material_count_(materials.count()), domain_(domain)
    {
    }

    /// Sets force and torque of every particle to the sum over its contacts; advances the tangential springs by dt [s].
    void sum_forces(ParticleState& particles, NeighborList& list, double dt);

private:
    void compute_pairs(ParticleState& particles, NeighborList& list, double dt);
    void gather(ParticleState& particles, NeighborList const& list);

    exec::Execution execution_;
    exec::View<ContactConstants const> constants_;
    std::int32_t material_count_;
    Domain domain_;
    exec::Buffer<PairForce> pair_forces_;
};

}  // namespace gimdem
