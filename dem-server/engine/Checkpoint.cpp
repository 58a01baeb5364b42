// SPDX-License-Identifier: BSD-3-Clause
#include "engine/Checkpoint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/Error.hpp"
#include "engine/ReferenceFile.hpp"
#include "engine/StateFile.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

namespace
{

constexpr char const* kind = "checkpoint";
constexpr std::string_view name_begin = "step_";

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

/// Oldest first.
std::vector<std::filesystem::path> checkpoints_in(std::filesystem::path const& folder)
{
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder / "checkpoints")) return files;
    for (auto const& entry : std::filesystem::directory_iterator(folder / "checkpoints"))
        if (entry.path().extension() == ".h5") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The number in the name of a checkpoint; -1: it is not named as one.
std::int64_t step_of(std::filesystem::path const& file)
{
    std::string const name = file.filename().string();
    if (!name.starts_with(name_begin)) return -1;
    char const* const digits = name.data() + name_begin.size();
    std::int64_t step = -1;
    std::from_chars(digits, name.data() + name.size(), step);
    return step;
}

}  // namespace

void write_checkpoint(std::filesystem::path const& file, Case const& settings, RunPoint const& point,
                      std::vector<Inlet> const& inlets, DemSystem const& system, WeightReuse const* reuse,
                      MappedState const* mapped)
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
    if (mapped != nullptr) add_mapped(writer, *mapped);
    writer.commit();
}

RunPoint read_checkpoint(std::filesystem::path const& file, Case const& settings, std::vector<Inlet>& inlets,
                         DemSystem& system, WeightReuse* reuse, MappedState* mapped)
{
    output::SnapshotReader const reader(file, kind);
    check_case(reader, settings, inlets.size(), file);
    RunPoint const point{reader.integer("step"), reader.number("time")};
    auto const next_id = reader.integer("next_id");
    auto const states = inlets_of(reader);
    auto removed = removed_of(reader);
    auto reference = reuse == nullptr ? WeightReference{} : reference_of(reader);
    MappedState on_mesh = mapped_of(reader);
    take_state(reader, static_cast<int>(settings.materials.size()), system);
    system.set_next_id(next_id);
    system.removed() = std::move(removed);
    if (reuse != nullptr) reuse->restore(std::move(reference));
    if (mapped != nullptr) *mapped = std::move(on_mesh);
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
    return folder / "checkpoints" / fmt::format("{}{:09}_at_{:.9g}.h5", name_begin, point.step, point.time);
}

std::optional<std::filesystem::path> find_checkpoint(std::filesystem::path const& folder, std::int64_t step)
{
    for (auto const& file : checkpoints_in(folder))
        if (step_of(file) == step) return file;
    return std::nullopt;
}

void keep_newest_checkpoints(std::filesystem::path const& folder, std::int64_t complete_step)
{
    auto const files = checkpoints_in(folder);
    for (std::size_t k = 0; k + 3 < files.size(); ++k)
        if (step_of(files[k]) < complete_step) std::filesystem::remove(files[k]);
}

}  // namespace gimdem
