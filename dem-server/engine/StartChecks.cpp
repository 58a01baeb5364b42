// SPDX-License-Identifier: BSD-3-Clause
#include "engine/StartChecks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "contact/LinearSpringDashpot.hpp"
#include "core/Error.hpp"
#include "particles/SizeDistribution.hpp"
#include "search/NeighborList.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

double shortest_rayleigh_time(Materials const& materials, ParticleState const& particles)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (std::int64_t p = 0; p < particles.count(); ++p)
        shortest = std::min(shortest, materials.rayleigh_time(particles.material[p], particles.position[p].w));
    return shortest;
}

double shortest_linear_contact(Case const& settings, Materials const& materials, ParticleState const& particles)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<double> lightest(static_cast<std::size_t>(materials.count()), none);
    for (std::int64_t p = 0; p < particles.count(); ++p)
    {
        double& mass = lightest[static_cast<std::size_t>(particles.material[p])];
        mass = std::min(mass, 1 / particles.velocity[p].w);
    }
    for (InletSettings const& inlet : settings.inlets)
    {
        int const material = materials.number_of(inlet.material);
        double const radius = SizeDistribution(inlet.diameter, inlet.sizes).smallest() / 2;
        double& mass = lightest[static_cast<std::size_t>(material)];
        mass = std::min(mass, materials[material].density * sphere_volume(radius));
    }
    double shortest = none;
    auto const meet = [&](int a, int b, double inverse_mass)
    {
        ContactSettings const* pair = materials.contact(a, b);
        if (pair != nullptr && inverse_mass > 0)
            shortest = std::min(shortest, LinearSpringDashpot::duration(pair->normal_stiffness, 1 / inverse_mass));
    };
    std::vector<int> wall_materials{materials.number_of(settings.walls.material)};
    for (WallItemSettings const& wall : settings.wall)
        if (!wall.material.empty()) wall_materials.push_back(materials.number_of(wall.material));
    for (int a = 0; a < materials.count(); ++a)
    {
        double const mass_a = lightest[static_cast<std::size_t>(a)];
        if (mass_a == none) continue;
        for (int const wall : wall_materials)
            meet(a, wall, 1 / mass_a);
        for (int b = 0; b <= a; ++b)
            if (lightest[static_cast<std::size_t>(b)] != none)
                meet(a, b, 1 / mass_a + 1 / lightest[static_cast<std::size_t>(b)]);
    }
    return shortest;
}

namespace
{

/// The time that a step must resolve, and the largest share of it.
struct StepLimit
{
    char const* name;
    double time;  ///< [s]
    double share;
    char const* otherwise;  ///< what goes wrong beyond
    char const* advice;     ///< beside a smaller step
};

StepLimit limit_of(Case const& settings, Materials const& materials, ParticleState const& particles)
{
    if (settings.dem.contact_law == LinearSpringDashpot::name)
        return {"shortest contact", shortest_linear_contact(settings, materials, particles), contact_share_limit,
                "the restitution is wrong", "better 2 to 5 % of the contact, or a smaller normal_stiffness"};
    double rayleigh = shortest_rayleigh_time(materials, particles);
    for (InletSettings const& inlet : settings.inlets)
        rayleigh =
            std::min(rayleigh, materials.rayleigh_time(materials.number_of(inlet.material),
                                                       SizeDistribution(inlet.diameter, inlet.sizes).smallest() / 2));
    return {"Rayleigh time", rayleigh, rayleigh_share_limit, "energy is made", "or a smaller young_modulus"};
}

}  // namespace

void check_time_step(Case const& settings, Materials const& materials, ParticleState const& particles)
{
    StepLimit const limit = limit_of(settings, materials, particles);
    double const share = settings.dem.time_step / limit.time;
    if (share <= limit.share) return;
    throw UserError(
        fmt::format("[dem] time_step = {:.6g} s is {:.3g} % of the {}, {:.6g} s (above {:.0f} % the contacts are not "
                    "resolved and {}); use at most {:.3g} s, {}",
                    settings.dem.time_step, 100 * share, limit.name, limit.time, 100 * limit.share, limit.otherwise,
                    limit.share * limit.time, limit.advice));
}

void check_overlaps(exec::Execution execution, ParticleState const& particles, Domain const& domain)
{
    ParticleState sorted = particles;
    NeighborList list;
    NeighborSearch(execution, 0, domain).build(sorted, list);
    PeriodicSpace const space = domain.space();
    auto const first = first_of_pairs(list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        Quad const a = sorted.position[first[k]];
        Quad const b = sorted.position[list.second[k]];
        Vec3 between = a.xyz() - b.xyz();
        space.shorten(between.x(), between.y(), between.z());
        double const overlap = a.w + b.w - between.norm();
        if (overlap <= 0.01 * 2 * std::min(a.w, b.w)) continue;
        throw UserError(
            fmt::format("particles {} and {} overlap by {:.3g} m at ({:.6g}, {:.6g}, {:.6g}) m from the start "
                        "(they would fly apart); increase [[insertion]] spacing, reduce jitter or correct the "
                        "file",
                        sorted.id[first[k]], sorted.id[list.second[k]], overlap, a.x, a.y, a.z));
    }
}

void refuse_periodic_coupled_run(Case const& settings)
{
    if (!Domain::of(settings.domain).is_periodic()) return;
    throw UserError(
        "[domain] periodic is set in a coupled run (the client's mesh has no periodic patches that the "
        "particles could pass through); remove [domain], or run the particles alone");
}

}  // namespace gimdem
