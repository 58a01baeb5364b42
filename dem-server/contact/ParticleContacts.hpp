// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles. Each contact is computed once, and each particle's sum has one order, whatever the number
/// of threads (PairKernel).
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "contact/PairKernel.hpp"
#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

class ParticleContacts
{
public:
    /// `one_size`: all particles have one radius and one density.
    ParticleContacts(exec::Execution execution, Materials const& materials, bool one_size, Domain const& domain = {})
        : execution_(execution),
          model_(materials),
          material_count_(materials.count()),
          one_size_(one_size),
          is_single_(materials.laws().precision == "mixed"),
          domain_(domain)
    {
    }

    /// To be told anew whenever particles come or go.
    void set_one_size(bool one_size) { one_size_ = one_size; }

    /// True where the list must carry rolling springs.
    bool has_rolling_springs() const { return model_.has_rolling_spring(); }

    /// Sets force and torque of every particle to the sum over its contacts; advances the tangential springs by dt [s].
    void sum_forces(ParticleState& particles, NeighborList& list, double dt);

private:
    /// The sum over the pairs of each block, by a law in Real: exec::Octet or exec::Hexadecad.
    template <class Real>
    void sum_pairs(ParticleState& particles, NeighborList& list, double dt);

    exec::Execution execution_;
    ContactModel model_;
    std::int32_t material_count_;
    bool one_size_;
    bool is_single_;  ///< the laws are computed in single precision
    Domain domain_;
};

}  // namespace gimdem
