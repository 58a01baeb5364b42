// SPDX-License-Identifier: BSD-3-Clause
#include "engine/Settling.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/Error.hpp"
#include "exec/Reduce.hpp"
#include "output/Snapshot.hpp"

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
void read_into(std::vector<T> const& values, exec::Buffer<T>& to)
{
    to.resize(static_cast<std::int64_t>(values.size()));
    std::copy(values.begin(), values.end(), to.host().begin());
}

void read_into(std::vector<double> const& values, exec::Buffer<Quad>& to)
{
    to.resize(static_cast<std::int64_t>(values.size() / 4));
    if (!values.empty()) std::copy(values.begin(), values.end(), &to.host().data()->x);
}

/// Everything that decides what a settled bed looks like.
std::string description(Case const& settings)
{
    std::string text = "settled bed 1\n";
    auto const add = [&](auto const&... values) { ((text += fmt::format("{} ", values)), ...); };
    auto const add_triple = [&](Triple const& t) { add(t[0], t[1], t[2]); };
    add(settings.dem.time_step);
    add_triple(settings.dem.gravity);
    for (MaterialSettings const& m : settings.materials)
        add(m.name, m.density, m.young_modulus, m.poisson_ratio);
    for (ContactSettings const& c : settings.contacts)
        add(c.pair[0], c.pair[1], c.restitution, c.friction);
    add(settings.walls.material);
    for (InsertionSettings const& i : settings.insertion)
    {
        add(i.material, i.diameter, i.mass, i.count, i.arrangement, i.spacing, i.jitter, i.seed, i.file.string());
        add_triple(i.box[0]);
        add_triple(i.box[1]);
        add_triple(i.velocity);
    }
    DemSettings const& laws = settings.dem;
    if (laws.contact_law != "hertz-mindlin" || laws.rolling_friction != "none" || laws.cohesion != "none")
    {
        add(laws.contact_law, laws.rolling_friction, laws.cohesion);
        for (ContactSettings const& c : settings.contacts)
            add(c.normal_stiffness, c.tangential_stiffness_ratio, c.rolling_friction, c.rolling_damping,
                c.cohesion_energy_density);
    }
    if (Domain::of(settings.domain).is_periodic())
        for (std::size_t axis = 0; axis < 3; ++axis)
            add(settings.domain.periodic[axis], settings.domain.box[0][axis], settings.domain.box[1][axis]);
    if (settings.settle) add(settings.settle->duration, settings.settle->kinetic_energy);
    return text;
}

}  // namespace

double mean_kinetic_energy(exec::Execution execution, ParticleState const& particles)
{
    if (particles.count() == 0) return 0;
    Quad const* const v = particles.velocity.view().data;
    Quad const* const w = particles.angular_velocity.view().data;
    double const sum =
        exec::sum(execution, particles.count(),
                  [=](std::int64_t i)
                  { return 0.5 * v[i].xyz().squaredNorm() / v[i].w + 0.5 * w[i].xyz().squaredNorm() / w[i].w; });
    return sum / static_cast<double>(particles.count());
}

double settle(Case const& settings, exec::Execution execution, DemSystem& system, SettlingReport const& report)
{
    constexpr int steps_between_reports = 200;
    double const dt = settings.dem.time_step;
    auto const most_steps = static_cast<std::int64_t>(std::ceil(settings.settle->duration / dt));
    system.begin_coupling_step(nullptr);
    for (std::int64_t step = 1; step <= most_steps; ++step)
    {
        system.step(dt);
        if (step % steps_between_reports != 0) continue;
        double const time = static_cast<double>(step) * dt;
        double const energy = mean_kinetic_energy(execution, system.particles());
        if (!std::isfinite(energy))
            throw UserError("the bed diverged while it settled (kinetic energy is not finite); reduce [dem] time_step");
        if (!report(time, energy)) throw UserError("interrupted while the bed settled; nothing was kept");
        // A bed that was only just let go is at rest as well: let it fall first.
        bool const has_fallen = time > 0.1 * settings.settle->duration;
        if (has_fallen && energy < settings.settle->kinetic_energy) return time;
    }
    return settings.settle->duration;
}

std::filesystem::path settled_bed_file(Case const& settings, WallGeometry const& walls, PolyMesh const& mesh)
{
    std::string text = description(settings);
    for (InsertionSettings const& insertion : settings.insertion)
        if (insertion.arrangement == "file")
        {
            std::ifstream in(settings.file.parent_path() / insertion.file, std::ios::binary);
            text.append(std::istreambuf_iterator<char>(in), {});
        }
    text += walls.description();
    // Rounded, so that meshes of the same vessel share a bed.
    auto const add_rounded = [&](double value) { text += fmt::format("{} ", std::round(value * 1e8) + 0.0); };
    for (int axis = 0; axis < 3; ++axis)
    {
        add_rounded(mesh.low()[axis]);
        add_rounded(mesh.high()[axis]);
    }
    return settings.file.parent_path() / "settled" / fmt::format("{:016x}.h5", XXH3_64bits(text.data(), text.size()));
}

void write_state(std::filesystem::path const& file, std::string const& kind, DemSystem const& system, double time)
{
    ParticleState const& p = system.particles();
    NeighborList const& pairs = system.neighbors();
    WallPairs const& walls = system.walls().pairs();
    std::filesystem::create_directories(file.parent_path());
    output::SnapshotWriter writer(file, kind);
    writer.set("time", time);
    writer.set("wall_time", system.walls().time());
    writer.add("position", numbers(p.position), 4);
    writer.add("velocity", numbers(p.velocity), 4);
    writer.add("angular_velocity", numbers(p.angular_velocity), 4);
    writer.add("material", p.material.host());
    writer.add("id", p.id.host());
    writer.add("pair_offsets", pairs.row_offsets.host());
    writer.add("pair_second", pairs.second.host());
    writer.add("pair_spring", numbers(pairs.displacement), 4);
    if (pairs.carries_rolling)
    {
        writer.add("pair_rolling_spring", numbers(pairs.rolling_spring), 4);
        writer.add("wall_rolling_spring", numbers(walls.rolling_spring), 4);
    }
    writer.add("wall_offsets", walls.offsets.host());
    writer.add("wall_plane", walls.plane.host());
    writer.add("wall_spring", numbers(walls.displacement), 4);
    writer.commit();
}

void read_state(std::filesystem::path const& file, std::string const& kind, DemSystem& system)
{
    output::SnapshotReader const reader(file, kind);
    auto const ids = reader.int64s("id");
    ParticleState& p = system.particles();
    if (static_cast<std::int64_t>(ids.size()) != p.count())
        throw UserError(fmt::format("{} holds {} particles, the case has {}; delete the file to make it anew",
                                    file.string(), ids.size(), p.count()));
    read_into(reader.doubles("position"), p.position);
    read_into(reader.doubles("velocity"), p.velocity);
    read_into(reader.doubles("angular_velocity"), p.angular_velocity);
    read_into(reader.int32s("material"), p.material);
    read_into(ids, p.id);

    NeighborList& pairs = system.neighbors();
    read_into(reader.int32s("pair_offsets"), pairs.row_offsets);
    read_into(reader.int32s("pair_second"), pairs.second);
    read_into(reader.doubles("pair_spring"), pairs.displacement);
    pairs.built_at.resize(0);  // stale: the next step builds a list and carries the springs over
    system.walls().move_to(reader.has("wall_time") ? reader.number("wall_time") : 0);
    WallPairs& walls = system.walls().pairs();
    read_into(reader.int32s("wall_offsets"), walls.offsets);
    read_into(reader.int32s("wall_plane"), walls.plane);
    read_into(reader.doubles("wall_spring"), walls.displacement);
    if (pairs.carries_rolling)
    {
        read_into(reader.doubles("pair_rolling_spring"), pairs.rolling_spring);
        read_into(reader.doubles("wall_rolling_spring"), walls.rolling_spring);
    }
    system.prepare();
}

}  // namespace gimdem
