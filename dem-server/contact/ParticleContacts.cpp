// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ParticleContacts.hpp"

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
    Octet radius, inverse_mass, inverse_inertia;

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
        inverse_inertia = w.w;
    }
};

/// Forces and torques of the pairs of one block of the list, and their springs one step on: first the pairs that touch
/// are picked, then computed eight at a time.
template <class Law, bool one_material>
struct PairKernel
{
    ParticleView particles;
    std::int32_t const* first;
    std::int32_t const* second;
    std::int64_t pair_count;
    typename Law::template Constants<double> const* constants;
    std::int32_t material_count;
    double dt;
    std::uint8_t* touches;
    Quad* displacement;
    Quad* rolling_spring;  ///< null where the law has none
    PairForce* forces;
    Quad* rolling;  ///< null where nothing resists rolling

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
            double const dx = xi.x - xj.x, dy = xi.y - xj.y, dz = xi.z - xj.z;
            double const reach = xi.w + xj.w;
            bool const now = dx * dx + dy * dy + dz * dz < reach * reach;
            if (touches[k] != 0 && !now)
            {
                displacement[k] = {0, 0, 0, 0};
                if constexpr (Law::has_rolling_spring) rolling_spring[k] = {0, 0, 0, 0};
            }
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
        ContactSprings<Octet> springs{{old.x, old.y, old.z}};
        if constexpr (Law::has_rolling_spring)
        {
            auto const rolled = exec::load(rolling_spring, pairs);
            springs.rolling = {rolled.x, rolled.y, rolled.z};
        }
        ContactForce<Octet> const result = apply_law(contact, i, j, springs);
        Vector3<Octet> const turn = contact.normal.cross(result.tangential);

        store(springs.tangential, displacement, pairs);
        if constexpr (Law::has_rolling_spring) store(springs.rolling, rolling_spring, pairs);
        if constexpr (Law::rolls) store(result.rolling, rolling, pairs);
        exec::store({result.force.x, result.force.y, result.force.z, Octet::Ones()}, &forces->force, pairs, 2);
        exec::store({turn.x, turn.y, turn.z, contact.overlap}, &forces->torque, pairs, 2);
    }

    static void store(Vector3<Octet> const& from, Quad* values, std::int32_t const* place)
    {
        exec::store({from.x, from.y, from.z, Octet::Zero()}, values, place);
    }

    ContactForce<Octet> apply_law(ContactGeometry<Octet> const& contact, std::int32_t const* i, std::int32_t const* j,
                                  ContactSprings<Octet>& springs) const
    {
        if constexpr (one_material)
            return Law::template apply<Octet>(constants[0], dt, contact, springs);
        else
        {
            std::int32_t row[exec::octet];
            for (int n = 0; n < exec::octet; ++n)
                row[n] = particles.material[i[n]] * material_count + particles.material[j[n]];
            return Law::template apply<Octet>(octet_of<Law>(constants, row), dt, contact, springs);
        }
    }

    static ContactGeometry<Octet> meet(OctetOfParticles const& a, OctetOfParticles const& b)
    {
        Vector3<Octet> const between = a.position - b.position;
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
        ContactGeometry<Octet> contact{.normal = normal,
                                       .overlap = overlap,
                                       .velocity = a.velocity - b.velocity - spin.cross(normal),
                                       .radius_eff = a.radius * b.radius / reach,
                                       .mass_eff = 1 / (a.inverse_mass + b.inverse_mass)};
        if constexpr (Law::rolls)
        {
            contact.spin = a.spin - b.spin;
            contact.inverse_inertia = a.inverse_inertia + b.inverse_inertia;
        }
        if constexpr (Law::coheres) contact.per_distance = per_distance;
        return contact;
    }
};

/// Sum over the contacts of particle i: first those where it is first, then those where it is second.
template <bool rolls>
struct GatherKernel
{
    ParticleView particles;
    std::int32_t const* row_offsets;
    std::int32_t const* second_offsets;
    std::int32_t const* second_members;
    std::uint8_t const* touches;
    PairForce const* forces;
    Quad const* rolling;

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
            if constexpr (rolls) torque += rolling[k].xyz();
        }
        for (std::int32_t m = second_offsets[i]; m < second_offsets[i + 1]; ++m)
        {
            if (touches[second_members[m]] == 0) continue;
            PairForce const& pair = forces[second_members[m]];
            force -= pair.force.xyz();
            torque -= (radius - pair.torque.w / 2) * pair.torque.xyz();
            if constexpr (rolls) torque -= rolling[second_members[m]].xyz();
        }
        particles.force[i] = Quad::of(force, 0);
        particles.torque[i] = Quad::of(torque, 0);
    }
};

}  // namespace

void ParticleContacts::sum_forces(ParticleState& particles, NeighborList& list, double dt)
{
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            pair_forces_.resize(list.pair_count());
            if constexpr (Law::rolls) rolling_.resize(list.pair_count());
            if (material_count_ == 1)
                compute_pairs<Law, true>(table, particles, list, dt);
            else
                compute_pairs<Law, false>(table, particles, list, dt);
            gather<Law::rolls>(particles, list);
        });
}

template <class Law, bool one_material>
void ParticleContacts::compute_pairs(LawTable<Law> const& table, ParticleState& particles, NeighborList& list,
                                     double dt)
{
    std::int64_t const blocks = (list.pair_count() + block - 1) / block;
    exec::for_each(execution_, blocks,
                   PairKernel<Law, one_material>{
                       particles.view(), list.first.view().data, list.second.view().data, list.pair_count(),
                       table.constants.view().data, material_count_, dt, list.touches.view().data,
                       list.displacement.view().data, list.rolling_spring.view().data, pair_forces_.view().data,
                       rolling_.view().data});
}

template <bool rolls>
void ParticleContacts::gather(ParticleState& particles, NeighborList const& list)
{
    exec::for_each(
        execution_, particles.count(),
        GatherKernel<rolls>{particles.view(), list.row_offsets.view().data, list.pairs_by_second.offsets.view().data,
                            list.pairs_by_second.members.view().data, list.touches.view().data,
                            pair_forces_.view().data, rolling_.view().data});
}

}  // namespace gimdem
