// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

#include "contact/HertzMindlin.hpp"
#include "exec/ForEach.hpp"
#include "exec/Octet.hpp"

namespace gimdem
{

namespace
{

using exec::Octet;

constexpr int block = 256;  ///< pairs

/// Where eight particles are, and how they move.
struct OctetOfParticles
{
    Vector3<Octet> position, velocity, spin;
    Octet radius, inverse_mass;

    OctetOfParticles(ParticleView const& particles, std::int32_t const* which)
    {
        auto const x = exec::load(particles.position, which);
        auto const v = exec::load(particles.velocity, which);
        auto const w = exec::load(particles.angular_velocity, which);
        position = {x.x, x.y, x.z};
        velocity = {v.x, v.y, v.z};
        spin = {w.x, w.y, w.z};
        radius = x.w;
        inverse_mass = v.w;
    }
};

/// Constants of eight contacts of whatever materials.
ContactConstantsOf<Octet> constants_of(ContactConstants const* table, std::int32_t material_count,
                                       std::int32_t const* material, std::int32_t const* i, std::int32_t const* j)
{
    ContactConstantsOf<Octet> out;
    for (int n = 0; n < exec::octet; ++n)
    {
        ContactConstants const& pair = table[material[i[n]] * material_count + material[j[n]]];
        out.young_eff[n] = pair.young_eff;
        out.friction[n] = pair.friction;
        out.damping[n] = pair.damping;
        out.stiffness_ratio[n] = pair.stiffness_ratio;
        out.root_stiffness_ratio[n] = pair.root_stiffness_ratio;
    }
    return out;
}

/// Forces and torques of the pairs of one block of the list, and their springs one step on: first the pairs that touch
/// are picked, then computed eight at a time.
template <bool one_material, class Space>
struct PairKernel
{
    ParticleView particles;
    std::int32_t const* first;
    std::int32_t const* second;
    std::int64_t pair_count;
    ContactConstants const* constants;
    std::int32_t material_count;
    double dt;
    std::uint8_t* touches;
    Quad* displacement;
    PairForce* forces;
    Space space;

    void operator()(std::int64_t b) const
    {
        std::int32_t touching[block + exec::octet];
        int const count = pick_touching(b, touching);
        for (int n = 0; n < count; n += exec::octet)
            compute(touching + n);
    }

private:
    /// Numbers of the block's pairs that touch, padded with the last one to whole octets.
    int pick_touching(std::int64_t b, std::int32_t* touching) const
    {
        std::int64_t const begin = b * block;
        std::int64_t const end = begin + block < pair_count ? begin + block : pair_count;
        int count = 0;
        for (std::int64_t k = begin; k < end; ++k)
        {
            Quad const xi = particles.position[first[k]];
            Quad const xj = particles.position[second[k]];
            double dx = xi.x - xj.x, dy = xi.y - xj.y, dz = xi.z - xj.z;
            space.shorten(dx, dy, dz);
            double const reach = xi.w + xj.w;
            bool const now = dx * dx + dy * dy + dz * dz < reach * reach;
            if (touches[k] != 0 && !now) displacement[k] = {0, 0, 0, 0};
            touches[k] = now;
            touching[count] = static_cast<std::int32_t>(k);
            count += now;
        }
        for (int n = count; n % exec::octet != 0; ++n)
            touching[n] = touching[count - 1];
        return count;
    }

    void compute(std::int32_t const* pairs) const
    {
        std::int32_t i[exec::octet], j[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            i[n] = first[pairs[n]];
            j[n] = second[pairs[n]];
        }
        OctetOfParticles const a(particles, i), b(particles, j);
        ContactGeometry<Octet> const contact = meet(a, b);
        auto const old = exec::load(displacement, pairs);
        Vector3<Octet> spring{old.x, old.y, old.z};
        ContactForce<Octet> const result = apply_law(contact, i, j, spring);
        Vector3<Octet> const turn = contact.normal.cross(result.tangential);

        exec::store({spring.x, spring.y, spring.z, Octet::Zero()}, displacement, pairs);
        exec::store({result.force.x, result.force.y, result.force.z, Octet::Ones()}, &forces->force, pairs, 2);
        exec::store({turn.x, turn.y, turn.z, contact.overlap}, &forces->torque, pairs, 2);
    }

    ContactForce<Octet> apply_law(ContactGeometry<Octet> const& contact, std::int32_t const* i, std::int32_t const* j,
                                  Vector3<Octet>& spring) const
    {
        if constexpr (one_material)
            return HertzMindlin<Octet>{constants[0], dt}(contact, spring);
        else
            return HertzMindlin<Octet, ContactConstantsOf<Octet>>{
                constants_of(constants, material_count, particles.material, i, j), dt}(contact, spring);
    }

    ContactGeometry<Octet> meet(OctetOfParticles const& a, OctetOfParticles const& b) const
    {
        Vector3<Octet> between = a.position - b.position;
        space.shorten(between.x, between.y, between.z);
        Octet const reach = a.radius + b.radius;
        Octet const distance = between.dot(between).sqrt();
        // Two centres in one place have no normal; any direction parts them.
        auto const apart = exec::greater(distance, Octet::Zero());
        Octet const one = Octet::Ones();
        Octet const per_distance = one / exec::choose(apart, distance, one);
        Vector3<Octet> normal = per_distance * between;
        normal.z = exec::choose(apart, normal.z, one);
        Octet const overlap = reach - distance;
        Vector3<Octet> const spin = Octet(a.radius - overlap / 2) * a.spin + Octet(b.radius - overlap / 2) * b.spin;
        return {.normal = normal,
                .overlap = overlap,
                .velocity = a.velocity - b.velocity - spin.cross(normal),
                .radius_eff = a.radius * b.radius / reach,
                .mass_eff = 1 / (a.inverse_mass + b.inverse_mass)};
    }
};

/// Sum over the contacts of particle i: first those where it is first, then those where it is second.
struct GatherKernel
{
    ParticleView particles;
    std::int32_t const* row_offsets;
    std::int32_t const* second_offsets;
    std::int32_t const* second_members;
    std::uint8_t const* touches;
    PairForce const* forces;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        double const radius = particles.position[i].w;
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
        for (std::int32_t k = row_offsets[i]; k < row_offsets[i + 1]; ++k)
        {
            if (touches[k] == 0) continue;
            PairForce const& pair = forces[k];
            force += pair.force.xyz();
            torque -= (radius - pair.torque.w / 2) * pair.torque.xyz();
        }
        for (std::int32_t m = second_offsets[i]; m < second_offsets[i + 1]; ++m)
        {
            if (touches[second_members[m]] == 0) continue;
            PairForce const& pair = forces[second_members[m]];
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
    std::int64_t const blocks = (list.pair_count() + block - 1) / block;
    auto const compute = [&]<bool one_material>(auto space)
    {
        exec::for_each(execution_, blocks,
                       PairKernel<one_material, decltype(space)>{
                           particles.view(), list.first.view().data, list.second.view().data, list.pair_count(),
                           constants_.data, material_count_, dt, list.touches.view().data,
                           list.displacement.view().data, pair_forces_.view().data, space});
    };
    in_space_of(domain_,
                [&](auto space)
                {
                    if (material_count_ == 1)
                        compute.template operator()<true>(space);
                    else
                        compute.template operator()<false>(space);
                });
}

void ParticleContacts::gather(ParticleState& particles, NeighborList const& list)
{
    exec::for_each(
        execution_, particles.count(),
        GatherKernel{particles.view(), list.row_offsets.view().data, list.pairs_by_second.offsets.view().data,
                     list.pairs_by_second.members.view().data, list.touches.view().data, pair_forces_.view().data});
}

}  // namespace gimdem
