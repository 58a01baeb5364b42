// SPDX-License-Identifier: BSD-3-Clause
/// Spheres at random places of a box that do not overlap: a fluid of hard spheres, by Metropolis moves from a lattice.
///
/// Denser than inserting one after the other can (0.38): up to the lattice's own solid fraction, 0.52 in a large box.
#pragma once

#include <cstdint>
#include <vector>

#include "exec/Vector.hpp"
#include "particles/Random.hpp"

namespace gimdem::test
{

class RandomPacking
{
public:
    /// `count` spheres that lie wholly between the corners `low` and `high`. Throws UserError where they do not fit.
    RandomPacking(std::int64_t count, Vec3 const& low, Vec3 const& high, double diameter, std::uint64_t seed = 11);

    /// Tries to move each sphere `sweeps` times, by up to a quarter of the diameter along each axis.
    void shake(int sweeps);

    std::vector<Vec3> const& centres() const { return centres_; }  ///< [m]

private:
    std::int64_t site_of(Vec3 const& x) const;
    bool is_free(Vec3 const& x, std::int64_t but) const;
    void put(std::int64_t sphere);
    void take(std::int64_t sphere);

    static constexpr int site_capacity = 8;  ///< a cube of the edge d holds no more spheres of diameter d: its corners

    Vec3 low_, high_;  ///< of the centres
    double diameter_;
    RandomStream random_;
    std::vector<Vec3> centres_;
    Eigen::Vector3i size_;               ///< sites along each axis
    std::vector<std::int32_t> members_;  ///< of each site, -1 where none
};

}  // namespace gimdem::test
