// SPDX-License-Identifier: BSD-3-Clause
#include "walls/SurfaceCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

// A triangle flatter than this fraction of its longest side has no normal: files hold seven digits.
constexpr double flattest = 1e-6;

std::string text(Vec3 const& x)
{
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z());
}

void check_triangles(SurfaceMesh const& surface, std::string const& source)
{
    if (surface.triangles.empty())
        throw UserError(source + " holds no triangle (a wall needs some); export the surface again");
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
        double longest = 0;
        for (int corner = 0; corner < 3; ++corner)
        {
            if (!surface.point(t, corner).allFinite())
                throw UserError(
                    fmt::format("{}: triangle {} has a corner that is not finite (it has no place); "
                                "export the surface again",
                                source, t + 1));
            longest = std::max(longest, (surface.point(t, (corner + 1) % 3) - surface.point(t, corner)).norm());
        }
        if (!(surface.area_vector(t).norm() > flattest * longest * longest))
            throw UserError(
                fmt::format("{}: triangle {} at {} has no area (it has no normal to push particles along); "
                            "remove it, for example by merging duplicate points in a mesh editor",
                            source, t + 1, text(surface.point(t, 0))));
    }
}

void check_edges(SurfaceMesh const& surface, std::string const& source)
{
    auto const uses = edges_of(surface);
    for_each_edge(uses,
                  [&](std::size_t begin, std::size_t end)
                  {
                      EdgeUse const& first = uses[begin];
                      std::string const edge = fmt::format("the edge from {} to {}",
                                                           text(surface.points[static_cast<std::size_t>(first.low)]),
                                                           text(surface.points[static_cast<std::size_t>(first.high)]));
                      if (end - begin == 1)
                          throw UserError(fmt::format(
                              "{}: the surface is open: {} belongs to triangle {} alone (a closed surface has two at "
                              "each edge); close the hole, or set open = true if the surface is meant as a sheet",
                              source, edge, first.triangle + 1));
                      EdgeUse const& second = uses[begin + 1];
                      if (end - begin > 2)
                          throw UserError(fmt::format(
                              "{}: {} belongs to {} triangles, {} and {} among them (a closed surface has two at each "
                              "edge, one inside and one outside); remove the inner faces, or set open = true",
                              source, edge, end - begin, first.triangle + 1, second.triangle + 1));
                      if (first.forward == second.forward)
                          throw UserError(fmt::format(
                              "{}: triangles {} and {} are wound against each other at {} (one of them is inside out); "
                              "let a mesh editor unify the normals",
                              source, first.triangle + 1, second.triangle + 1, edge));
                  });
}

}  // namespace

std::vector<EdgeUse> edges_of(SurfaceMesh const& surface)
{
    std::vector<EdgeUse> uses;
    uses.reserve(3 * surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::size_t side = 0; side < 3; ++side)
        {
            std::int32_t const a = surface.triangles[t][side], b = surface.triangles[t][(side + 1) % 3];
            uses.push_back(
                {std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), static_cast<std::int8_t>(side), a < b});
        }
    std::sort(uses.begin(), uses.end(),
              [](EdgeUse const& a, EdgeUse const& b)
              { return std::tie(a.low, a.high, a.triangle, a.side) < std::tie(b.low, b.high, b.triangle, b.side); });
    return uses;
}

// Relative to the first corner, so that a surface far from the origin keeps its digits.
double signed_volume(SurfaceMesh const& surface)
{
    double six = 0;
    Vec3 const from = surface.point(0, 0);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        six += (surface.point(t, 0) - from).dot((surface.point(t, 1) - from).cross(surface.point(t, 2) - from));
    return six / 6;
}

void check_surface(SurfaceMesh const& surface, std::string const& source, bool open)
{
    check_triangles(surface, source);
    if (open) return;
    check_edges(surface, source);
    double const volume = signed_volume(surface);
    if (!(volume > 0))
        throw UserError(
            fmt::format("{}: the surface is inside out, triangle 1 and all others (it encloses {:.6g} m^3: "
                        "its triangles are wound clockwise seen from outside); let a mesh editor flip the "
                        "normals. On which side particles are is said by inside = true or false",
                        source, volume));
}

}  // namespace gimdem
