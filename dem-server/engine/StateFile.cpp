// SPDX-License-Identifier: BSD-3-Clause
#include "engine/StateFile.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "core/Error.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

namespace
{

std::span<double const> numbers(exec::Buffer<Quad> const& quads)
{
    if (quads.size() == 0) return {};
    return {&quads.host().data()->x, 4 * static_cast<std::size_t>(quads.size())};
}

template <class T>
void put(std::vector<T> const& values, exec::Buffer<T>& to)
{
    to.resize(std::ssize(values));
    std::copy(values.begin(), values.end(), to.host().begin());
}

std::span<double const> numbers(exec::Buffer<Constant3> const& vectors)
{
    if (vectors.size() == 0) return {};
    return {&vectors.host().data()->x, 3 * static_cast<std::size_t>(vectors.size())};
}

void put(std::vector<double> const& values, exec::Buffer<Constant3>& to)
{
    to.resize(std::ssize(values) / 3);
    if (!values.empty()) std::copy(values.begin(), values.end(), &to.host().data()->x);
}

void put(std::vector<double> const& values, exec::Buffer<Quad>& to)
{
    to.resize(std::ssize(values) / 4);
    if (!values.empty()) std::copy(values.begin(), values.end(), &to.host().data()->x);
}

/// A list of lists with a spring for each member.
struct Springs
{
    std::vector<std::int32_t> offsets, partner;
    std::vector<double> spring;
    bool rolls = false;           ///< whether there are rolling springs as well
    std::vector<double> rolling;  ///< of each member too, else empty

    /// Whether it has a row for each particle (or none at all: never built), and partners below `limit`.
    bool fits(std::size_t count, std::int64_t limit) const
    {
        bool const rows = offsets.empty() ? partner.empty()
                                          : offsets.size() == count + 1 && offsets.front() == 0 &&
                                                std::is_sorted(offsets.begin(), offsets.end()) &&
                                                offsets.back() == std::ssize(partner);
        return rows && spring.size() == 4 * partner.size() && rolling.size() == (rolls ? spring.size() : 0) &&
               std::all_of(partner.begin(), partner.end(), [=](std::int32_t p) { return 0 <= p && p < limit; });
    }
};

void append(Spring const& s, std::vector<double>& to)
{
    to.insert(to.end(), {s.x, s.y, s.z, 0});
}

bool has_bits(Spring const& s)
{
    constexpr Spring none{0, 0, 0};
    return std::memcmp(&s, &none, sizeof s) != 0;
}

/// The pairs of the list whose springs are not zero.
Springs stretched(NeighborList const& pairs)
{
    Springs springs;
    springs.rolls = pairs.carries_rolling;
    for (std::int64_t i = 0; i < pairs.row_offsets.size(); ++i)
    {
        springs.offsets.push_back(static_cast<std::int32_t>(springs.partner.size()));
        if (i + 1 == pairs.row_offsets.size()) break;
        for (std::int32_t k = pairs.row_offsets[i]; k < pairs.row_offsets[i + 1]; ++k)
        {
            SpringPool::Slot const slot = pairs.spring[k];
            if (slot == SpringPool::none) continue;
            SpringPool const& pool = pairs.pools[static_cast<std::size_t>(i / NeighborList::block)];
            bool const rolled = springs.rolls && has_bits(pool.rolling()[slot]);
            if (!rolled && !has_bits(pool.tangential()[slot])) continue;
            springs.partner.push_back(pairs.second[k]);
            append(pool.tangential()[slot], springs.spring);
            if (springs.rolls) append(pool.rolling()[slot], springs.rolling);
        }
    }
    return springs;
}

}  // namespace

void add_state(output::SnapshotWriter& writer, DemSystem const& system)
{
    ParticleState const& p = system.particles();
    Springs const pairs = stretched(system.neighbors());
    WallPairs const& walls = system.walls().pairs();
    writer.add("position", numbers(p.position), 4);
    writer.add("velocity", numbers(p.velocity), 4);
    writer.add("angular_velocity", numbers(p.angular_velocity), 4);
    writer.add("force", numbers(p.force), 4);
    writer.add("torque", numbers(p.torque), 4);
    Vec3 const wall_force = system.walls().total_force();
    writer.add("wall_force", std::span(wall_force.data(), 3), 3);
    writer.add("material", p.material.host());
    writer.add("id", p.id.host());
    writer.add("listed_at", numbers(system.neighbors().built_at), 3);
    writer.add("pair_offsets", pairs.offsets);
    writer.add("pair_second", pairs.partner);
    writer.add("pair_spring", pairs.spring, 4);
    if (pairs.rolls)
    {
        writer.add("pair_rolling_spring", pairs.rolling, 4);
        writer.add("wall_rolling_spring", numbers(walls.rolling_spring), 4);
    }
    std::array const wall_times{system.walls().time(), system.walls().built_time()};
    writer.add("wall_times", wall_times, 2);
    writer.add("wall_offsets", walls.offsets.host());
    writer.add("wall_plane", walls.plane.host());
    writer.add("wall_spring", numbers(walls.displacement), 4);
}

void take_state(output::SnapshotReader const& reader, int materials, DemSystem& system)
{
    auto const ids = reader.int64s("id");
    std::size_t const n = ids.size();
    bool fits = true;
    auto const quads = [&](char const* name)
    {
        auto values = reader.doubles(name);
        fits &= values.size() == 4 * n;
        return values;
    };
    auto const position = quads("position"), velocity = quads("velocity"), spin = quads("angular_velocity"),
               force = quads("force"), torque = quads("torque");
    auto const listed_at = reader.doubles("listed_at");
    fits &= listed_at.size() == 3 * n;
    auto const wall_force = reader.doubles("wall_force"), wall_times = reader.doubles("wall_times");
    auto const material = reader.int32s("material");
    bool const rolls = system.neighbors().carries_rolling;
    auto const springs = [&](char const* offsets, char const* partner, char const* spring, char const* rolling)
    {
        return Springs{reader.int32s(offsets), reader.int32s(partner), reader.doubles(spring), rolls,
                       rolls ? reader.doubles(rolling) : std::vector<double>{}};
    };
    Springs const of_pairs = springs("pair_offsets", "pair_second", "pair_spring", "pair_rolling_spring");
    Springs const of_walls = springs("wall_offsets", "wall_plane", "wall_spring", "wall_rolling_spring");
    fits = fits && material.size() == n && wall_force.size() == 3 && wall_times.size() == 2 &&
           of_pairs.fits(n, std::ssize(ids)) && of_walls.fits(n, system.walls().plane_count()) &&
           std::all_of(material.begin(), material.end(), [=](std::int32_t m) { return 0 <= m && m < materials; });
    if (!fits)
        throw UserError(
            "the state's arrays do not fit each other or the case (another case wrote it); nothing was "
            "taken from it");

    ParticleState& p = system.particles();
    put(position, p.position);
    put(velocity, p.velocity);
    put(spin, p.angular_velocity);
    put(force, p.force);
    put(torque, p.torque);
    put(material, p.material);
    put(ids, p.id);
    NeighborList& pairs = system.neighbors();
    put(listed_at, pairs.built_at);
    put(of_pairs.offsets, pairs.row_offsets);
    put(of_pairs.partner, pairs.second);
    SpringsOfPairs springs_of_pairs;
    put(of_pairs.spring, springs_of_pairs.tangential);
    put(of_pairs.rolling, springs_of_pairs.rolling);
    put_springs(springs_of_pairs, pairs);
    WallPairs& walls = system.walls().pairs();
    put(of_walls.offsets, walls.offsets);
    put(of_walls.partner, walls.plane);
    put(of_walls.spring, walls.displacement);
    put(of_walls.rolling, walls.rolling_spring);
    // The list is that of the walls where they were then.
    system.walls().move_to(wall_times[1]);
    system.resume({wall_force[0], wall_force[1], wall_force[2]});
    system.walls().move_to(wall_times[0]);
}

}  // namespace gimdem
