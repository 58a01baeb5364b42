// SPDX-License-Identifier: BSD-3-Clause
/// The box of a run without a fluid: who has left it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/Case.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem
{

/// Removes particles that left the box: through an open side as soon as the centre is beyond it, through a wall once it
/// is beyond by a radius. A periodic axis has no sides: the search for neighbours moves those beyond it to the other
/// end.
class DomainBounds
{
public:
    explicit DomainBounds(DomainSettings const& domain);

    /// Throws UserError for a particle that starts beyond a side, or deeper in a wall than 1 % of its diameter.
    void check_start(ParticleState const& particles) const;

    /// Returns how many particles were removed; they are counted as "through SIDE".
    std::int64_t remove_leavers(DemSystem& system) const;

private:
    double beyond(Quad const& x, std::size_t side) const;  ///< of the centre [m]; negative: within
    std::int32_t side_left(Quad const& x) const;           ///< -1: none

    std::array<Triple, 2> box_;
    std::array<bool, 3> periodic_;
    std::array<bool, 6> open_{};
    std::vector<std::string> causes_;
};

}  // namespace gimdem
