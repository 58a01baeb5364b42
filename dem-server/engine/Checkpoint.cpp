// SPDX-License-Identifier: BSD-3-Clause
#include "engine/Checkpoint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/Error.hpp"
#include "engine/ReferenceFile.hpp"
#include "engine/StateFile.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

namespace
{

constexpr char const* kind = "checkpoint";

/// Hash of all that decides how the particles of a case move, files of positions and of walls included.
std::string case_hash(Case const& settings)
{
    std::string text = settings.identity;
    auto const append = [&](std::filesystem::path const& file)
    {
        std::ifstream in(settings.file.parent_path() / file, std::ios::binary);
        text.append(std::istreambuf_iterator<char>(in), {});
    };
    for (InsertionSettings const& insertion : settings.insertion)
        if (insertion.arrangement == "file") append(insertion.file);
    for (WallItemSettings const& wall : settings.wall)
        if (!wall.file.empty()) append(wall.file);
    return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

void add_inlets(output::SnapshotWriter& writer, std::vector<Inlet> const& inlets)
{
    std::vector<std::int64_t> counts;
    std::vector<double> masses;
    for (Inlet const& inlet : inlets)
    {
        InletState const& s = inlet.state();
        counts.insert(counts.end(), {static_cast<std::int64_t>(s.random), s.lots, s.inserted});
        masses.insert(masses.end(), {s.mass, s.next_diameter});
    }
    writer.add("inlet_counts", counts, 3);
    writer.add("inlet_masses", masses, 2);
}

std::vector<InletState> inlets_of(output::SnapshotReader const& reader)
{
    auto const counts = reader.int64s("inlet_counts");
    auto const masses = reader.doubles("inlet_masses");
    std::vector<InletState> states(std::min(counts.size() / 3, masses.size() / 2));
    for (std::size_t i = 0; i < states.size(); ++i)
        states[i] = {static_cast<std::uint64_t>(counts[3 * i]), counts[3 * i + 1], counts[3 * i + 2], masses[2 * i],
                     masses[2 * i + 1]};
    return states;
}

void add_removed(output::SnapshotWriter& writer, RemovedByCause const& removed)
{
    std::vector<std::int64_t> counts;
    std::vector<double> masses;
    std::string causes;
    for (auto const& [cause, of_cause] : removed)
    {
        counts.push_back(of_cause.count);
        masses.push_back(of_cause.mass);
        causes += cause + '\n';
    }
    writer.add("removed_counts", counts);
    writer.add("removed_masses", masses);
    writer.set("removed_causes", causes);
}

RemovedByCause removed_of(output::SnapshotReader const& reader)
{
    auto const counts = reader.int64s("removed_counts");
    auto const masses = reader.doubles("removed_masses");
    std::string const causes = reader.text("removed_causes");
    RemovedByCause removed;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < std::min(counts.size(), masses.size()); ++k)
    {
        std::size_t const end = causes.find('\n', begin);
        removed[causes.substr(begin, end - begin)] = {counts[k], masses[k]};
        begin = end + 1;
    }
    return removed;
}

void check_case(output::SnapshotReader const& reader, Case const& settings, std::size_t inlets,
                std::filesystem::path const& file)
{
    auto const version = reader.integer("checkpoint_version");
    if (version != checkpoint_version)
        throw UserError(
            fmt::format("checkpoint {} has version {} (this program reads version {}); restart with the program that "
                        "wrote it, or run the case from its start",
                        file.string(), version, checkpoint_version));
    if (reader.text("case") != case_hash(settings) || inlets_of(reader).size() != inlets)
        throw UserError(
            fmt::format("checkpoint {} belongs to another case: \"{}\" (settings that decide how the particles move "
                        "differ from those of {}); undo the change of the case, or run it from its start",
                        file.string(), reader.text("title"), settings.file.string()));
}

}  // namespace

void write_checkpoint(std::filesystem::path const& file, Case const& settings, RunPoint const& point,
                      std::vector<Inlet> const& inlets, DemSystem const& system, WeightReuse const* reuse)
{
    std::filesystem::create_directories(file.parent_path());
    output::SnapshotWriter writer(file, kind);
    writer.set("checkpoint_version", checkpoint_version);
    writer.set("case", case_hash(settings));
    writer.set("title", settings.title);
    writer.set("step", point.step);
    writer.set("time", point.time);
    writer.set("next_id", system.next_id());
    add_inlets(writer, inlets);
    add_removed(writer, system.removed());
    add_state(writer, system);
    if (reuse != nullptr) add_reference(writer, reuse->reference());
    writer.commit();
}

RunPoint read_checkpoint(std::filesystem::path const& file, Case const& settings, std::vector<Inlet>& inlets,
                         DemSystem& system, WeightReuse* reuse)
{
    output::SnapshotReader const reader(file, kind);
    check_case(reader, settings, inlets.size(), file);
    RunPoint const point{reader.integer("step"), reader.number("time")};
    auto const next_id = reader.integer("next_id");
    auto const states = inlets_of(reader);
    auto removed = removed_of(reader);
    auto reference = reuse == nullptr ? WeightReference{} : reference_of(reader);
    take_state(reader, static_cast<int>(settings.materials.size()), system);
    system.set_next_id(next_id);
    system.removed() = std::move(removed);
    if (reuse != nullptr) reuse->restore(std::move(reference));
    for (std::size_t i = 0; i < inlets.size(); ++i)
        inlets[i].restore(states[i]);
    return point;
}

void require_time_left(std::filesystem::path const& file, RunPoint const& point, double until)
{
    if (point.time < until * (1 - 1e-9)) return;
    throw UserError(
        fmt::format("checkpoint {} is at {:.6g} s, the run ends at {:.6g} s (nothing is left to do); give a later end "
                    "with --until",
                    file.string(), point.time, until));
}

std::filesystem::path checkpoint_file(std::filesystem::path const& folder, RunPoint const& point)
{
    return folder / "checkpoints" / fmt::format("step_{:09}_at_{:.9g}.h5", point.step, point.time);
}

void keep_newest_checkpoints(std::filesystem::path const& folder)
{
    std::vector<std::filesystem::path> files;
    for (auto const& entry : std::filesystem::directory_iterator(folder / "checkpoints"))
        if (entry.path().extension() == ".h5") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (std::size_t k = 0; k + 3 < files.size(); ++k)
        std::filesystem::remove(files[k]);
}

}  // namespace gimdem
