// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <set>
#include <vector>

#include "core/CaseChecks.hpp"
#include "core/CaseText.hpp"
#include "core/Error.hpp"

namespace gimdem::case_file
{

namespace
{

/// Settings of one [[wall]], with the messages for those that are missing or have no effect.
class WallCheck
{
public:
    WallCheck(Case const& input, std::size_t index, Document const& document)
        : wall_(input.wall[index]), domain_(input.domain), index_(index), document_(document)
    {
    }

    void check() const
    {
        if (wall_.shape == "plane") check_plane();
        if (wall_.shape == "cylinder") check_cylinder();
        if (wall_.shape == "stl") check_stl();
        if (wall_.rotation) require_length("rotation.axis", wall_.rotation->axis);
        if (wall_.vibration) require_length("vibration.direction", wall_.vibration->direction);
    }

private:
    void check_plane() const
    {
        require("point", "a point of the plane [m]", "[0.0, 0.0, 0.0]");
        require("normal", "direction towards the particles", "[0.0, 0.0, 1.0]");
        require_length("normal", wall_.normal);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (domain_.periodic[axis] && wall_.normal[axis] != 0)
                throw UserError(
                    at("normal") + ": \"normal\"" + of_wall() + " has a part along " + "xyz"[axis] +
                    ", where [domain] is periodic (an infinite plane would end at the border); use stl for a "
                    "wall within the box, or leave that axis out of periodic");
        refuse({"axis", "radius", "length", "inside", "file", "scale", "open"});
    }

    void check_cylinder() const
    {
        require("point", "a point of its axis [m]", "[0.0, 0.0, 0.0]");
        require("axis", "direction of its axis", "[0.0, 1.0, 0.0]");
        require("radius", "of the wall [m]", "0.05");
        require("inside", "whether the particles are inside the cylinder", "true");
        require_length("axis", wall_.axis);
        refuse({"normal", "file", "scale", "open"});
    }

    void check_stl() const
    {
        require("file", "the triangles", "\"drum.stl\"");
        if (wall_.open)
            refuse({"inside"});
        else
            require("inside", "whether the particles are inside the surface; or open = true for a sheet", "true");
        refuse({"point", "normal", "axis", "radius", "length"});
    }

    std::string path(std::string const& key) const { return entry("wall", index_, key); }
    std::string at(std::string const& key) const { return document_.at(path(key)); }
    std::string of_wall() const { return " of [[wall]] \"" + wall_.name + "\""; }

    void require(std::string const& key, std::string const& purpose, std::string const& example) const
    {
        if (!document_.has(path(key)))
            throw UserError(at(key) + ": \"" + key + '"' + of_wall() + " is missing (" + purpose + "); add e.g. " +
                            key + " = " + example);
    }

    void refuse(std::vector<std::string> const& keys) const
    {
        for (auto const& key : keys)
            if (document_.has(path(key)))
                throw UserError(at(key) + ": \"" + key + '"' + of_wall() + " has no effect (shape is \"" + wall_.shape +
                                (wall_.open ? "\", open" : "\"") + "); remove it or change shape");
    }

    void require_length(std::string const& key, Triple const& direction) const
    {
        if (!(std::hypot(direction[0], direction[1], direction[2]) > 0))
            throw UserError(at(key) + ": \"" + key + '"' + of_wall() +
                            " is zero (it has no direction); write e.g. [0.0, 0.0, 1.0]");
    }

    WallItemSettings const& wall_;
    DomainSettings const& domain_;
    std::size_t index_;
    Document const& document_;
};

}  // namespace

void check_walls(Case const& input, Document const& document)
{
    std::set<std::string> seen;
    for (std::size_t i = 0; i < input.wall.size(); ++i)
    {
        if (!seen.insert(input.wall[i].name).second)
            throw UserError(document.at(entry("wall", i, "name")) + ": wall \"" + input.wall[i].name +
                            "\" is defined twice (a name stands for one wall); rename one");
        WallCheck(input, i, document).check();
    }
}

}  // namespace gimdem::case_file
