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

std::string entry(std::string const& list, std::size_t index, std::string const& key)
{
    return list + '[' + std::to_string(index) + "]." + key;
}

namespace
{

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

void check_encodings(CouplingSettings const& coupling, Document const& document)
{
    auto const has = [&](char const* name)
    { return std::find(coupling.encodings.begin(), coupling.encodings.end(), name) != coupling.encodings.end(); };
    if (has("sparse") && has("dense"))
        throw UserError(document.at("coupling.encodings") +
                        ": \"encodings\" in [coupling] has sparse and dense (fields travel in one way or the other); "
                        "remove one");
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
    std::set<std::string> used;
    for (auto const& insertion : input.insertion)
        used.insert(insertion.material);
    for (auto const& inlet : input.inlets)
        used.insert(inlet.material);
    for (auto const& first : used)
    {
        require(first, input.walls.material);
        for (auto const& wall : input.wall)
            if (!wall.material.empty()) require(first, wall.material);
        for (auto const& second : used)
            require(first, second);
    }
}

void check_insertions(Case const& input, Document const& document)
{
    for (std::size_t i = 0; i < input.insertion.size(); ++i)
    {
        auto const& insertion = input.insertion[i];
        check_material_exists(insertion.material, entry("insertion", i, "material"), input, document);
        check_insertion(insertion, i, document);
    }
}

void check_inlets(Case const& input, Document const& document)
{
    if (input.insertion.empty() && input.inlets.empty())
        throw UserError(document.file +
                        ": [[insertion]] is missing (which particles there are at the start; or [[inlets]]: which "
                        "come later); add [[insertion]] with material = \"bead\"");
    for (std::size_t i = 0; i < input.inlets.size(); ++i)
    {
        check_material_exists(input.inlets[i].material, entry("inlets", i, "material"), input, document);
        check_inlet(input.inlets[i], i, document);
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
    check_encodings(input.coupling, document);
    check_material_names(input, document);
    check_contacts(input, document);
    check_contact_laws(input, document);
    check_material_exists(input.walls.material, "walls.material", input, document);
    for (std::size_t i = 0; i < input.wall.size(); ++i)
        if (!input.wall[i].material.empty())
            check_material_exists(input.wall[i].material, entry("wall", i, "material"), input, document);
    check_walls(input, document);
    check_insertions(input, document);
    check_inlets(input, document);
    check_domain(input, document);
    check_pairs_in_use(input, document);
    check_output(input.output, document);
}

}  // namespace gimdem::case_file
