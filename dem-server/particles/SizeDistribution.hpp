// SPDX-License-Identifier: BSD-3-Clause
/// Diameters of particles that are not all alike.
#pragma once

#include <optional>
#include <vector>

#include "core/Case.hpp"
#include "particles/Random.hpp"

namespace gimdem
{

/// A distribution of diameters by number, theory.md (D.60)-(D.63). Each diameter takes one random number.
class SizeDistribution
{
public:
    /// One diameter [m], or what `sizes` says. Throws UserError where a bell curve has nearly no weight between the
    /// smallest and the largest diameter.
    SizeDistribution(double diameter, std::optional<SizeSettings> const& sizes);

    double draw(RandomStream& random) const;  ///< [m]

    double smallest() const { return smallest_; }  ///< [m]
    double largest() const { return largest_; }    ///< [m]

private:
    /// Share of diameters below d before truncation: the normal distribution's, of d or of its logarithm.
    double share_below(double d) const;
    double draw_discrete(double u) const;
    double draw_bell(double u) const;

    SizeSettings settings_;
    double smallest_, largest_;
    double centre_ = 0, width_ = 1;  ///< of the bell curve, (D.62): of d [m] or of ln(d / m)
    std::vector<double> up_to_;      ///< discrete: share by number of this size and those before it
};

}  // namespace gimdem
