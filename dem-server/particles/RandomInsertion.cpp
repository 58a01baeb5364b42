// SPDX-License-Identifier: BSD-3-Clause
#include "particles/RandomInsertion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/Error.hpp"
#include "particles/OverlapGrid.hpp"
#include "particles/SizeDistribution.hpp"

namespace gimdem
{

namespace
{

Vec3 corner(InsertionSettings const& settings, std::size_t which)
{
    return {settings.box[which][0], settings.box[which][1], settings.box[which][2]};
}

/// Radii of `count` spheres or, where that is 0, of so many that their mass is nearest to `mass`, theory.md (D.64).
std::vector<double> draw_radii(InsertionSettings const& settings, double density, RandomStream& random)
{
    SizeDistribution const sizes(settings.diameter, settings.sizes);
    std::vector<double> radii;
    double mass = 0;
    while (true)
    {
        if (settings.count > 0 && std::ssize(radii) == settings.count) return radii;
        double const radius = sizes.draw(random) / 2;
        double const its_mass = density * sphere_volume(radius);
        if (settings.count == 0 && mass + its_mass / 2 > settings.mass) return radii;
        radii.push_back(radius);
        mass += its_mass;
    }
}

[[noreturn]] void fail_full(InsertionSettings const& settings, std::vector<SphereSeed> const& placed,
                            std::size_t wanted)
{
    double solid = 0;
    for (SphereSeed const& seed : placed)
        solid += sphere_volume(seed.radius);
    throw UserError(fmt::format(
        "[[insertion]] found room for {} of {} random particles only: the box is {:.3g} % solid and no "
        "place without overlap was found in {} tries; enlarge the box, ask for less, or use a lattice",
        placed.size(), wanted, 100 * solid / (corner(settings, 1) - corner(settings, 0)).prod(), most_attempts));
}

}  // namespace

std::vector<SphereSeed> random_spheres_in_box(InsertionSettings const& settings, double density,
                                              ParticleState const& present)
{
    RandomStream random(settings.seed);
    auto radii = draw_radii(settings, density, random);
    std::sort(radii.begin(), radii.end(), std::greater<>());
    if (radii.empty()) return {};
    Vec3 const low = corner(settings, 0), high = corner(settings, 1);
    if (!((high - low).minCoeff() >= 2 * radii.front()))
        throw UserError(
            fmt::format("[[insertion]] box is thinner ({:.6g} m) than its largest particle ({:.6g} m); widen the box",
                        (high - low).minCoeff(), 2 * radii.front()));

    double largest = radii.front();
    for (Quad const& x : present.position.host())
        largest = std::max(largest, x.w);
    OverlapGrid grid(low, high, largest);
    for (Quad const& x : present.position.host())
        grid.add(x.xyz(), x.w);

    Vec3 const velocity(settings.velocity[0], settings.velocity[1], settings.velocity[2]);
    std::vector<SphereSeed> seeds;
    for (double const radius : radii)
        for (int attempt = 1;; ++attempt)
        {
            Vec3 x;
            for (int axis = 0; axis < 3; ++axis)
                x[axis] = random.between(low[axis] + radius, high[axis] - radius);
            if (attempt > most_attempts) fail_full(settings, seeds, radii.size());
            if (grid.overlaps(x, radius)) continue;
            grid.add(x, radius);
            seeds.push_back({x, radius, velocity});
            break;
        }
    return seeds;
}

}  // namespace gimdem
