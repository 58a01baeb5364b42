// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "contact/HertzMindlin.hpp"
#include "exec/ForEach.hpp"

namespace gimdem
{

namespace
{

/// Force and torque of pair k, and its spring one step on.
struct PairKernel
{
    ParticleView particles;
    std::int32_t const* first;
    std::int32_t const* second;
    ContactConstants const* constants;
    std::int32_t material_count;
    double dt;
    Quad* displacement;
    PairForce* forces;

    GIMDEM_HD void operator()(std::int64_t k) const
    {
        std::int32_t const i = first[k];
        std::int32_t const j = second[k];
        Quad const xi = particles.position[i];
        Quad const xj = particles.position[j];
        Vec3 const between = xi.xyz() - xj.xyz();
        double const reach = xi.w + xj.w;
        double const distance2 = between.squaredNorm();
        if (!(distance2 < reach * reach))
        {
            displacement[k] = {0, 0, 0, 0};
            forces[k].force.w = 0;
            return;
        }
        double const distance = std::sqrt(distance2);
        // Two centres in one place have no normal; any direction parts them.
        Vec3 const normal = distance > 0 ? Vec3(between / distance) : Vec3(0, 0, 1);
        double const overlap = reach - distance;

        Quad const vi = particles.velocity[i];
        Quad const vj = particles.velocity[j];
        Vec3 const spin = (xi.w - overlap / 2) * particles.angular_velocity[i].xyz() +
                          (xj.w - overlap / 2) * particles.angular_velocity[j].xyz();
        ContactGeometry const contact{.normal = normal,
                                      .overlap = overlap,
                                      .velocity = vi.xyz() - vj.xyz() - spin.cross(normal),
                                      .radius_eff = xi.w * xj.w / reach,
                                      .mass_eff = 1 / (vi.w + vj.w)};
        HertzMindlin const law{constants[particles.material[i] * material_count + particles.material[j]], dt};
        Vec3 spring = displacement[k].xyz();
        ContactForce const result = law(contact, spring);

        displacement[k] = Quad::of(spring, 0);
        forces[k] = {Quad::of(result.force, 1), Quad::of(normal.cross(result.tangential), overlap)};
    }
};

/// Sum over the contacts of particle i: first those where it is first, then those where it is second.
struct GatherKernel
{
    ParticleView particles;
    std::int32_t const* row_offsets;
    std::int32_t const* second_offsets;
    std::int32_t const* second_members;
    PairForce const* forces;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        double const radius = particles.position[i].w;
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
        for (std::int32_t k = row_offsets[i]; k < row_offsets[i + 1]; ++k)
        {
            PairForce const& pair = forces[k];
            if (pair.force.w == 0) continue;
            force += pair.force.xyz();
            torque -= (radius - pair.torque.w / 2) * pair.torque.xyz();
        }
        for (std::int32_t m = second_offsets[i]; m < second_offsets[i + 1]; ++m)
        {
            PairForce const& pair = forces[second_members[m]];
            if (pair.force.w == 0) continue;
            force -= pair.force.xyz();
            torque -= (radius - pair.torque.w / 2) * pair.torque.xyz();
        }
        particles.force[i] = Quad::of(force, 0);
        particles.torque[i] = Quad::of(torque, 0);
    }
};

}  // namespace

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    compute_pairs(particles, list, dt);
    gather(particles, list);
}

void ParticleContacts::compute_pairs(ParticleState& particles, NeighborList& list, double dt)
{
    pair_forces_.resize(list.pair_count());
    exec::for_each(execution_, list.pair_count(),
                   PairKernel{particles.view(), list.first.view().data, list.second.view().data, constants_.data,
                              material_count_, dt, list.displacement.view().data, pair_forces_.view().data});
}

void ParticleContacts::gather(ParticleState& particles, NeighborList const& list)
{
    exec::for_each(
        execution_, particles.count(),
        GatherKernel{particles.view(), list.row_offsets.view().data, list.pairs_by_second.offsets.view().data,
                     list.pairs_by_second.members.view().data, pair_forces_.view().data});
}

}  // namespace gimdem
