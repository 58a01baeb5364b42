// SPDX-License-Identifier: BSD-3-Clause
/// Does the client apply the force that it was sent, of the time level that its schedule asks for?
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conformance/Findings.hpp"
#include "conformance/KnownSolid.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::conformance
{

/// The client reports monitors applied_force_x, _y, _z with each FluidState: the force of the particles on its fluid in
/// the step before, sum of S V [N]. It is compared with that of the known solid after this step (serial, iterated) or
/// the one before (overlapped), and, to name a mistake, with the other; each at the velocity at the end of the step
/// (implicit drag), at its beginning (explicit), or where momentum_source was computed.
class ForceCheck
{
public:
    ForceCheck(KnownSolid const& solid, coupling::Schedule schedule) : solid_(solid), schedule_(schedule) {}

    /// Of each FluidState, in their order.
    void take(coupling::FluidState const& fluid);

    void report(FindingsFile& findings) const;

private:
    using Force = std::array<double, 3>;

    static std::optional<Force> told_by(std::vector<coupling::Monitor> const& monitors);
    void compare(std::int64_t step, Force const& told, std::vector<double> const& at_end);
    double deviation(std::int64_t level, std::vector<double> const& velocity, Force const& told) const;
    double best_deviation(std::int64_t level, std::int64_t step, std::vector<double> const& at_end,
                          Force const& told) const;

    KnownSolid const& solid_;
    coupling::Schedule schedule_;
    std::vector<std::vector<double>> velocities_;  ///< at the beginning of the last steps, newest last
    int compared_ = 0;                             ///< steps
    int right_ = 0;
    int other_level_ = 0;  ///< steps that fit the other schedule
    bool silent_ = true;   ///< no monitor came
    double worst_ = 0;     ///< deviation of a right step
    std::string first_wrong_;
};

}  // namespace gimdem::conformance
