// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/CaseChecks.hpp"
#include "core/CaseText.hpp"
#include "core/Error.hpp"

namespace gimdem::case_file
{

namespace
{

/// [insertion.sizes] or [inlets.sizes], with the messages for keys that are missing or have no effect.
class SizesCheck
{
public:
    SizesCheck(SizeSettings const& sizes, std::string const& path, std::string const& list, Document const& document)
        : sizes_(sizes), path_(path), section_("[" + list + ".sizes]"), document_(document)
    {
    }

    void operator()() const
    {
        bool const list = sizes_.distribution == "discrete";
        bool const bell = sizes_.distribution == "normal" || sizes_.distribution == "lognormal";
        for (auto const* key : {"minimum", "maximum"})
            demand(key, !list);
        for (auto const* key : {"mean", "deviation"})
            demand(key, bell);
        for (auto const* key : {"diameters", "mass_fractions"})
            demand(key, list);
        if (list)
            check_list();
        else if (!(sizes_.minimum < sizes_.maximum))
            fail("maximum", "is not above minimum (no diameter lies between them)", "raise maximum or lower minimum");
    }

private:
    void demand(std::string const& key, bool needed) const
    {
        bool const given = document_.has(path_ + '.' + key);
        std::string const why = " (the distribution is \"" + sizes_.distribution + "\")";
        if (needed && !given) fail(key, "is missing" + why, "add it");
        if (!needed && given) fail(key, "has no effect" + why, "remove it or change distribution");
    }

    void check_list() const
    {
        if (sizes_.diameters.empty() || sizes_.diameters.size() != sizes_.mass_fractions.size())
            fail("mass_fractions",
                 "has " + to_text(sizes_.mass_fractions.size()) + " entries, diameters has " +
                     to_text(sizes_.diameters.size()) + " (each diameter has one share)",
                 "give as many of one as of the other");
        double const sum = std::accumulate(sizes_.mass_fractions.begin(), sizes_.mass_fractions.end(), 0.0);
        // Shares are written with a few digits: a sum that is off by less than a thousandth is meant to be 1.
        if (std::abs(sum - 1) > 1e-3)
            fail("mass_fractions", "adds up to " + to_text(sum) + " (shares of the whole add up to 1)",
                 "correct the shares");
    }

    [[noreturn]] void fail(std::string const& key, std::string const& problem, std::string const& advice) const
    {
        throw UserError(document_.at(path_ + '.' + key) + ": \"" + key + "\" in " + section_ + ' ' + problem + "; " +
                        advice);
    }

    SizeSettings const& sizes_;
    std::string path_, section_;
    Document const& document_;
};

bool is_empty(std::array<Triple, 2> const& box)
{
    return !(box[0][0] < box[1][0] && box[0][1] < box[1][1] && box[0][2] < box[1][2]);
}

bool is_periodic(DomainSettings const& domain)
{
    return domain.periodic[0] || domain.periodic[1] || domain.periodic[2];
}

/// A side of the box must exist, and there is none along a periodic axis. `key`: open of [domain] or also of [walls].
void check_sides(std::vector<std::string> const& names, std::string const& key, DomainSettings const& domain,
                 std::string const& place)
{
    std::vector<std::string> const sides{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
    for (auto const& name : names)
    {
        auto const found = std::find(sides.begin(), sides.end(), name);
        std::string const side = place + ": \"" + name + "\" in " + key;
        if (found == sides.end()) throw UserError(side + " is no side of the box; write e.g. \"zmax\"");
        if (domain.periodic[static_cast<std::size_t>(found - sides.begin()) / 2])
            throw UserError(side + " has no effect (that axis is periodic); remove it or change periodic");
    }
}

/// Lower and upper end of an inlet's region along an axis [m].
std::array<double, 2> extent_of(InletSettings const& inlet, std::size_t axis)
{
    if (inlet.radius == 0) return {inlet.box[0][axis], inlet.box[1][axis]};
    double const length = std::hypot(inlet.normal[0], inlet.normal[1], inlet.normal[2]);
    double const cosine = inlet.normal[axis] / length;
    double const reach = inlet.radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return {inlet.centre[axis] - reach, inlet.centre[axis] + reach};
}

/// Particles that appear outside of the box would be removed at once, and a periodic image could be taken already.
void check_inlets_are_inside(Case const& input, Document const& document)
{
    auto const& box = input.domain.box;
    for (std::size_t i = 0; i < input.inlets.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            auto const [low, high] = extent_of(input.inlets[i], axis);
            double const rounding = 1e-9 * (box[1][axis] - box[0][axis]);
            if (low >= box[0][axis] - rounding && high <= box[1][axis] + rounding) continue;
            throw UserError(
                fmt::format("{}: the region of [[inlets]] goes from {:.6g} to {:.6g} m along {}, beyond the box of "
                            "[domain], {:.6g} to "
                            "{:.6g} m (what appears out there is lost); move the region into the box",
                            document.at(entry("inlets", i, input.inlets[i].radius > 0 ? "centre" : "box")), low, high,
                            "xyz"[axis], box[0][axis], box[1][axis]));
        }
}

/// A run without a fluid: its box, and sections that it cannot have.
void check_run_alone(Case const& input, Document const& document)
{
    DomainSettings const& domain = input.domain;
    if (!document.has("domain"))
        throw UserError(document.file +
                        ": [domain] is missing (a run without a fluid has no mesh that bounds it); add [domain] with "
                        "box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]");
    if (is_empty(domain.box))
        throw UserError(document.at("domain.box") +
                        ": box in [domain] is empty (the first corner must be the lower one); write e.g. box = "
                        "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]");
    check_sides(domain.open, "open of [domain]", domain, document.at("domain.open"));
    check_sides(input.walls.also, "also of [walls]", domain, document.at("walls.also"));
    for (auto const* const section : {"settle", "fluid_forces", "mapping", "output.planes", "output.inlet"})
        if (document.has(section))
            throw UserError(document.at(section) + ": " + section +
                            " has no effect in a run without a fluid (client is \"none\"); remove it");
    check_inlets_are_inside(input, document);
}

}  // namespace

void check_sizes(std::optional<SizeSettings> const& sizes, double diameter, std::string const& path,
                 std::string const& list, Document const& document)
{
    if (sizes.has_value() == (diameter > 0))
        throw UserError(document.at(path) + (sizes ? ": both \"diameter\" and [" : ": neither \"diameter\" nor [") +
                        list + ".sizes] are given for [[" + list +
                        "]] (how large the particles are); give one of them, e.g. diameter = 1.545e-3");
    if (sizes) SizesCheck(*sizes, path, list, document)();
}

void check_inlet(InletSettings const& inlet, std::size_t index, Document const& document)
{
    auto const path = [&](std::string const& key) { return entry("inlets", index, key); };
    check_sizes(inlet.sizes, inlet.diameter, path("sizes"), "inlets", document);
    bool const box = document.has(path("box"));
    if (box == document.has(path("radius")))
        throw UserError(document.at(path("box")) + ": " + (box ? "both a box and" : "neither a box nor") +
                        " a disc are given in [[inlets]] (where the particles appear); give box, or centre, "
                        "normal and radius");
    if (box && is_empty(inlet.box))
        throw UserError(document.at(path("box")) +
                        ": box in [[inlets]] is empty (the first corner must be the lower one); write e.g. box = "
                        "[[0.0, 0.0, 0.4], [0.09, 0.008, 0.41]]");
    if (!box && std::hypot(inlet.normal[0], inlet.normal[1], inlet.normal[2]) == 0)
        throw UserError(document.at(path("radius")) +
                        ": the disc of [[inlets]] has no normal (it has no direction); write e.g. normal = [0.0, 0.0, "
                        "1.0]");
    if (document.has(path("end")) && !(inlet.start < inlet.end))
        throw UserError(document.at(path("end")) +
                        ": end in [[inlets]] is not after start (no particle would come); raise end or lower start");
}

void check_domain(Case const& input, Document const& document)
{
    DomainSettings const& domain = input.domain;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (domain.periodic[axis] && !(domain.box[1][axis] > domain.box[0][axis]))
            throw UserError(document.at("domain.box") + ": box in [domain] is empty along " + "xyz"[axis] +
                            " (that axis is periodic, the box tells its period); write e.g. box = [[0.0, 0.0, 0.0], "
                            "[0.05, 0.05, 0.05]]");
    if (input.run.client == "none") check_run_alone(input, document);
    // A periodic coupled run is refused when it starts: what other programs read of a case need not know.
    else if (document.has("domain") && !is_periodic(domain))
        throw UserError(document.at("domain") +
                        ": [domain] has no effect (the mesh of the fluid bounds the particles); remove it or write "
                        "client = \"none\" in [run]");
}

}  // namespace gimdem::case_file
