// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles. Each contact is computed once; then each particle sums its contacts in stored order, so
/// the result does not depend on the number of threads.
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
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
    ParticleContacts(exec::Execution execution, Materials const& materials)
        : execution_(execution), model_(materials), material_count_(materials.count())
    {
    }

    /// True where the list must carry rolling springs.
    bool has_rolling_springs() const { return model_.has_rolling_spring(); }

    /// Sets force and torque of every particle to the sum over its contacts; advances the tangential springs by dt [s].
    void sum_forces(ParticleState& particles, NeighborList& list, double dt);

private:
    template <class Law, bool one_material>
    void compute_pairs(LawTable<Law> const& table, ParticleState& particles, NeighborList& list, double dt);
    template <bool rolls>
    void gather(ParticleState& particles, NeighborList const& list);

    exec::Execution execution_;
    ContactModel model_;
    std::int32_t material_count_;
    exec::Buffer<PairForce> pair_forces_;
    exec::Buffer<Quad> rolling_;  ///< torque of rolling friction on the first particle [N m]; empty where there is none
};

}  // namespace gimdem
