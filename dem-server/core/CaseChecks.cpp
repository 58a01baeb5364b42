// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseChecks.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/CaseReader.hpp"
#include "core/CaseText.hpp"
#include "core/Error.hpp"
#include "core/NearestKey.hpp"

namespace gimdem::case_file
{

bool Document::has(std::string const& path) const
{
    return static_cast<bool>(root.at_path(path));
}

std::string Document::at(std::string path) const
{
    while (!path.empty() && !has(path))
        path.resize(path.find_last_of('.') == std::string::npos ? 0 : path.find_last_of('.'));
    return path.empty() ? file : locate(file, root.at_path(path).node());
}

namespace
{

std::string entry(std::string const& list, std::size_t index, std::string const& key)
{
    return list + '[' + std::to_string(index) + "]." + key;
}

void check_grid(RunSettings const& run, Document const& document)
{
    if (run.grid.empty() && run.grids.empty()) return;
    if (std::find(run.grids.begin(), run.grids.end(), run.grid) != run.grids.end()) return;
    if (run.grid.empty())
        throw UserError(
            document.at("run.grids") +
            ": \"grid\" is missing in [run] (which of grids to use); add e.g. grid = " + to_text(run.grids.front()));
    throw UserError(document.at("run.grid") + ": grid \"" + run.grid +
                    "\" in [run] is not on offer (it is not in grids); " + suggest_key(run.grid, run.grids));
}

std::vector<std::string> material_names(Case const& input)
{
    std::vector<std::string> names;
    for (auto const& material : input.materials)
        names.push_back(material.name);
    return names;
}

void check_material_names(Case const& input, Document const& document)
{
    std::set<std::string> seen;
    for (std::size_t i = 0; i < input.materials.size(); ++i)
        if (!seen.insert(input.materials[i].name).second)
            throw UserError(document.at(entry("materials", i, "name")) + ": material \"" + input.materials[i].name +
                            "\" is defined twice (a name stands for one material); rename or remove one");
}

void check_material_exists(std::string const& name, std::string const& path, Case const& input,
                           Document const& document)
{
    auto const names = material_names(input);
    if (std::find(names.begin(), names.end(), name) == names.end())
        throw UserError(document.at(path) + ": material \"" + name +
                        "\" is not defined (no [[materials]] has this name); " + suggest_key(name, names));
}

using Pair = std::array<std::string, 2>;

Pair sorted(Pair pair)
{
    if (pair[1] < pair[0]) std::swap(pair[0], pair[1]);
    return pair;
}

void check_contacts(Case const& input, Document const& document)
{
    std::set<Pair> seen;
    for (std::size_t i = 0; i < input.contacts.size(); ++i)
    {
        auto const& pair = input.contacts[i].pair;
        for (auto const& name : pair)
            check_material_exists(name, entry("contacts", i, "pair"), input, document);
        if (!seen.insert(sorted(pair)).second)
            throw UserError(document.at(entry("contacts", i, "pair")) + ": the pair " + to_text(pair) +
                            " is given twice (the order of the two does not matter); remove one");
    }
}

/// Materials of particles touch each other and the walls.
void check_pairs_in_use(Case const& input, Document const& document)
{
    std::set<Pair> given;
    for (auto const& contact : input.contacts)
        given.insert(sorted(contact.pair));
    auto const require = [&](std::string const& a, std::string const& b)
    {
        Pair const pair = sorted({a, b});
        if (!given.contains(pair))
            throw UserError(document.file + ": no [[contacts]] for the materials \"" + pair[0] + "\" and \"" + pair[1] +
                            "\" (particles of one can touch the other); add [[contacts]] with pair = " + to_text(pair) +
                            ", restitution = 0.9, friction = 0.3");
    };
    for (auto const& first : input.insertion)
    {
        require(first.material, input.walls.material);
        for (auto const& second : input.insertion)
            require(first.material, second.material);
    }
}

/// Settings of one [[insertion]], with the messages for those that are missing or have no effect.
class InsertionCheck
{
public:
    InsertionCheck(InsertionSettings const& insertion, std::size_t index, Document const& document)
        : insertion_(insertion), index_(index), document_(document)
    {
    }

    void check_lattice() const
    {
        require("diameter", "size of the particles [m]", "1.545e-3");
        require("box", "where the lattice is [m]", "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]");
        require("spacing", "distance of neighbours on the lattice [m]", "1.65e-3");
        refuse("file");
        check_amount();
        check_box();
        check_overlap();
    }

    void check_file(std::filesystem::path const& file) const
    {
        require("file", "CSV with the positions", "\"positions.csv\"");
        for (auto const* key : {"mass", "count", "box", "spacing", "jitter"})
            refuse(key);
        if (!std::filesystem::is_regular_file(file))
            throw UserError(at("file") + ": file " + file.string() +
                            " of [[insertion]] does not exist (the particles start where it says); give its path "
                            "relative to the case file");
    }

private:
    std::string path(std::string const& key) const { return entry("insertion", index_, key); }
    std::string at(std::string const& key) const { return document_.at(path(key)); }

    void require(std::string const& key, std::string const& purpose, std::string const& example) const
    {
        if (!document_.has(path(key)))
            throw UserError(at(key) + ": \"" + key + "\" is missing in [[insertion]] (" + purpose + "); add e.g. " +
                            key + " = " + example);
    }

    void refuse(std::string const& key) const
    {
        if (document_.has(path(key)))
            throw UserError(at(key) + ": \"" + key + "\" in [[insertion]] has no effect (arrangement is \"" +
                            insertion_.arrangement + "\"); remove it or change arrangement");
    }

    void check_amount() const
    {
        bool const mass = document_.has(path("mass"));
        bool const count = document_.has(path("count"));
        if (mass && count)
            throw UserError(at("count") +
                            ": both \"mass\" and \"count\" are given in [[insertion]] (one follows from "
                            "the other); remove one");
        if (!mass && !count)
            throw UserError(at("mass") +
                            ": neither \"mass\" nor \"count\" is given in [[insertion]] (how many particles "
                            "to insert); add e.g. mass = 0.039 or count = 17563");
    }

    void check_box() const
    {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!(insertion_.box[0][axis] < insertion_.box[1][axis]))
                throw UserError(at("box") + ": box in [[insertion]] is empty along " + "xyz"[axis] +
                                " (the first corner must be the lower one); write e.g. box = [[0.0, 0.0, 0.0], "
                                "[0.09, 0.008, 0.5]]");
    }

    void check_overlap() const
    {
        // two neighbours on the lattice, each displaced towards the other
        double const nearest = insertion_.spacing - 2 * insertion_.jitter;
        if (nearest < insertion_.diameter)
            throw UserError(
                at("spacing") +
                ": particles of [[insertion]] can overlap at the start (spacing - 2 jitter = " + to_text(nearest) +
                " m is below the diameter " + to_text(insertion_.diameter) + " m); raise spacing or lower jitter");
    }

    InsertionSettings const& insertion_;
    std::size_t index_;
    Document const& document_;
};

void check_insertion(Case const& input, Document const& document)
{
    for (std::size_t i = 0; i < input.insertion.size(); ++i)
    {
        auto const& insertion = input.insertion[i];
        check_material_exists(insertion.material, entry("insertion", i, "material"), input, document);
        InsertionCheck const check(insertion, i, document);
        if (insertion.arrangement == "file")
            check.check_file(insertion.file);
        else
            check.check_lattice();
    }
}

void check_output(OutputSettings const& output, Document const& document)
{
    std::set<std::string> seen;
    for (std::size_t i = 0; i < output.planes.size(); ++i)
    {
        auto const& plane = output.planes[i];
        if (!seen.insert(plane.name).second)
            throw UserError(document.at(entry("output.planes", i, "name")) + ": plane \"" + plane.name +
                            "\" is defined twice (its columns would have the same name); rename one");
        if (std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]) == 0)
            throw UserError(document.at(entry("output.planes", i, "normal")) + ": normal of plane \"" + plane.name +
                            "\" is zero (it has no direction); write e.g. normal = [0.0, 0.0, 1.0]");
    }
    if (output.inlet.empty() != output.outlet.empty())
        throw UserError(document.at(output.inlet.empty() ? "output.outlet" : "output.inlet") +
                        ": only one of \"inlet\" and "
                        "\"outlet\" is given in [output] (the pressure drop is taken from one to the other); add the "
                        "other or remove this one");
}

}  // namespace

void check_case(Case const& input, Document const& document)
{
    check_grid(input.run, document);
    check_material_names(input, document);
    check_contacts(input, document);
    check_material_exists(input.walls.material, "walls.material", input, document);
    check_insertion(input, document);
    check_pairs_in_use(input, document);
    check_output(input.output, document);
}

}  // namespace gimdem::case_file
