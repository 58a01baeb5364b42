// SPDX-License-Identifier: BSD-3-Clause
#include "engine/Settling.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include "core/CaseText.hpp"
#include "core/Error.hpp"
#include "engine/Checkpoint.hpp"
#include "engine/StateFile.hpp"
#include "exec/Reduce.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

namespace
{

/// Everything that decides what a settled bed looks like.
std::string description(Case const& settings)
{
    // With the version of the states, so that a file of an older layout is not found and the bed is settled anew.
    std::string text = fmt::format("settled bed, layout {}\n", checkpoint_version);
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
        if (!i.sizes) continue;
        add(i.sizes->distribution, i.sizes->minimum, i.sizes->maximum, i.sizes->mean, i.sizes->deviation);
        add(case_file::to_text(i.sizes->diameters), case_file::to_text(i.sizes->mass_fractions));
    }
    DemSettings const& laws = settings.dem;
    if (laws.contact_law != "hertz-mindlin" || laws.rolling_friction != "none" || laws.cohesion != "none")
    {
        add(laws.contact_law, laws.rolling_friction, laws.cohesion);
        for (ContactSettings const& c : settings.contacts)
            add(c.normal_stiffness, c.tangential_stiffness_ratio, c.rolling_friction, c.rolling_damping,
                c.cohesion_energy_density);
    }
    // Only where they are not as ever, so that beds that settled before they were there are still known.
    if (laws.precision != "double") add(laws.precision);
    for (ContactSettings const& c : settings.contacts)
        if (c.limit_damping || !c.tangential_damping) add(c.pair[0], c.pair[1], c.limit_damping, c.tangential_damping);
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
    std::filesystem::create_directories(file.parent_path());
    output::SnapshotWriter writer(file, kind);
    writer.set("time", time);
    add_state(writer, system);
    writer.commit();
}

void read_state(std::filesystem::path const& file, std::string const& kind, DemSystem& system)
{
    output::SnapshotReader const reader(file, kind);
    auto const ids = reader.int64s("id");
    if (std::ssize(ids) != system.particles().count())
        throw UserError(fmt::format("{} holds {} particles, the case has {}; delete the file to make it anew",
                                    file.string(), ids.size(), system.particles().count()));
    take_state(reader, std::numeric_limits<int>::max(), system);
}

}  // namespace gimdem
