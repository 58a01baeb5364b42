// SPDX-License-Identifier: BSD-3-Clause
/// The bed that LIGGGHTS 3.8.0 and LAMMPS (29 Sep 2021) were run on with the same law: start state and figures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "SphereBox.hpp"
#include "search/PairSprings.hpp"

namespace gimdem::test
{

/// 17,563 beads of 1.545 mm (1150 kg/m^3, 1.2e5 Pa, 0.33, restitution 0.9, friction 0.3) in a box of 90 x 8 x 500 mm
/// whose walls are of the same material, open above.
struct PeersBed
{
    static constexpr int count = 17'563;
    static constexpr double width = 0.09, depth = 0.008, height = 0.5;  ///< [m]
    static constexpr double diameter = 1.545e-3;                        ///< [m]
    static constexpr double dt = 2e-5;                                  ///< [s]

    /// Jittered simple cubic lattice, 45 x 4 to a layer, at rest: the start state of the peers' comparison. Positions
    /// have the twelve digits of the data file that the peers read.
    static std::vector<Sphere> lattice(int spheres = count)
    {
        constexpr int nx = 45, ny = 4;
        constexpr double sx = width / nx, sy = depth / ny, sz = 1.9e-3, jitter = 1.5e-4;
        std::uint64_t state = 12345;
        auto const shifted = [&](double x)
        {
            state = 6364136223846793005ULL * state + 1442695040888963407ULL;
            double const random = (static_cast<double>(state >> 11) + 0.5) * 0x1p-53;
            char digits[32];
            std::snprintf(digits, sizeof digits, "%.12g", x + jitter * (2 * random - 1));
            return std::strtod(digits, nullptr);
        };
        std::vector<Sphere> out;
        for (int n = 0; n < spheres; ++n)
        {
            double const x = shifted((n % nx + 0.5) * sx);
            double const y = shifted((n / nx % ny + 0.5) * sy);
            double const z = shifted((n / nx / ny + 0.5) * sz);
            out.push_back({{x, y, z}, diameter / 2});
        }
        return out;
    }

    static std::unique_ptr<SphereBox> make(exec::Execution execution = serial, std::string const& precision = "double")
    {
        Case settings = bead_case(0.9, 0.3);
        settings.dem.gravity = {0, 0, -9.81};
        settings.dem.skin = 0.3;
        settings.dem.precision = precision;
        return std::make_unique<SphereBox>(settings,
                                           Box{{width, depth, height}, {"left", "right", "front", "back", "bottom"}},
                                           lattice(), std::vector<int>{}, execution);
    }
};

/// Kinetic energy of translation [J].
inline double kinetic_energy(ParticleState const& p)
{
    double sum = 0;
    for (std::int64_t i = 0; i < p.count(); ++i)
        sum += p.mass(i) * p.velocity[i].xyz().squaredNorm() / 2;
    return sum;
}

/// Figures of a bed at rest, as the peers' states were evaluated.
struct BedFigures
{
    double kinetic_energy;     ///< [J]
    double twice_mean_height;  ///< 2 <z> [m]
    double coordination;       ///< contacts between particles, twice their number by particle
    double mean_overlap;       ///< of those contacts, in diameters
    double solid_fraction;     ///< centres between 20 and 80 % of the height that 99 % of the particles' tops are below
};

inline BedFigures figures_of(SphereBox const& bed)
{
    ParticleState const& p = bed.particles();
    NeighborList const& list = bed.system().neighbors();
    BedFigures f{};
    f.kinetic_energy = kinetic_energy(p);
    auto const n = static_cast<double>(p.count());
    std::int64_t contacts = 0;
    auto const first = first_of_pairs(list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        Quad const a = p.position[first[k]], b = p.position[list.second[k]];
        double const overlap = a.w + b.w - (a.xyz() - b.xyz()).norm();
        if (overlap <= 0) continue;
        ++contacts;
        f.mean_overlap += overlap / PeersBed::diameter;
    }
    f.mean_overlap /= static_cast<double>(contacts);
    f.coordination = 2 * static_cast<double>(contacts) / n;
    std::vector<double> z;
    for (Quad const& x : p.position.host())
        z.push_back(x.z);
    for (double const height : z)
        f.twice_mean_height += 2 * height / n;
    std::sort(z.begin(), z.end());
    double const top = z[static_cast<std::size_t>(0.99 * (n - 1))] + PeersBed::diameter / 2;
    auto const inside =
        std::count_if(z.begin(), z.end(), [&](double height) { return height > 0.2 * top && height < 0.8 * top; });
    f.solid_fraction = static_cast<double>(inside) * sphere_volume(PeersBed::diameter / 2) /
                       (PeersBed::width * PeersBed::depth * 0.6 * top);
    return f;
}

}  // namespace gimdem::test
