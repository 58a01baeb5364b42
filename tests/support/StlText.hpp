// SPDX-License-Identifier: BSD-3-Clause
/// STL files for tests: written, used, removed.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/Case.hpp"
#include "exec/Vector.hpp"

namespace gimdem::test
{

using Corners = std::array<Vec3, 3>;
using Soup = std::vector<Corners>;

inline std::string ascii_stl(Soup const& soup)
{
    std::string text = "solid wall\n";
    for (Corners const& triangle : soup)
    {
        text += "facet normal 0 0 0\nouter loop\n";
        for (Vec3 const& x : triangle)
            text += fmt::format("vertex {} {} {}\n", x.x(), x.y(), x.z());
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid wall\n";
}

inline std::string binary_stl(Soup const& soup)
{
    std::string text(80, ' ');
    auto const put = [&](auto value)
    {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        text.append(bytes, sizeof value);
    };
    put(static_cast<std::uint32_t>(soup.size()));
    for (Corners const& triangle : soup)
    {
        for (int k = 0; k < 3; ++k)
            put(0.0f);
        for (Vec3 const& x : triangle)
            for (int axis = 0; axis < 3; ++axis)
                put(static_cast<float>(x[axis]));
        put(std::uint16_t{0});
    }
    return text;
}

/// A file that lives as long as this.
struct TemporaryStl
{
    explicit TemporaryStl(std::string const& content)
    {
        static int number = 0;
        path = std::filesystem::temp_directory_path() / fmt::format("gimdem-wall-{}-{}.stl", ::getpid(), ++number);
        std::ofstream(path, std::ios::binary) << content;
    }
    explicit TemporaryStl(Soup const& soup) : TemporaryStl(ascii_stl(soup)) {}
    ~TemporaryStl() { std::filesystem::remove(path); }
    TemporaryStl(TemporaryStl const&) = delete;
    TemporaryStl& operator=(TemporaryStl const&) = delete;

    std::filesystem::path path;
};

/// The quadrilateral a, b, c, d as two triangles.
inline void add_quad(Soup& soup, Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& d)
{
    soup.push_back({a, b, c});
    soup.push_back({a, c, d});
}

/// [low, high] squared at height z in n x n squares, each two triangles, upwards.
inline Soup floor_soup(double low, double high, int n, double z = 0)
{
    Soup soup;
    auto const at = [&](int i, int j) { return Vec3(low + (high - low) * i / n, low + (high - low) * j / n, z); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return soup;
}

/// A closed box, normals outward.
inline Soup box_soup(Vec3 const& a, Vec3 const& b)
{
    Soup soup;
    auto const at = [&](int x, int y, int z) { return Vec3(x ? b.x() : a.x(), y ? b.y() : a.y(), z ? b.z() : a.z()); };
    add_quad(soup, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    add_quad(soup, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    add_quad(soup, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    add_quad(soup, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    add_quad(soup, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    add_quad(soup, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    return soup;
}

/// The mantle of a cylinder about the y axis, n flat strips, in `pieces` along y, normals outward.
inline Soup mantle_soup(double radius, double length, int n, int pieces)
{
    Soup soup;
    auto const at = [&](int i, int j)
    {
        double const angle = 2 * std::numbers::pi * (i % n) / n;
        return Vec3(radius * std::cos(angle), length * j / pieces, -radius * std::sin(angle));
    };
    for (int j = 0; j < pieces; ++j)
        for (int i = 0; i < n; ++i)
            add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return soup;
}

inline WallItemSettings plane_wall(Triple const& point = {0, 0, 0}, Triple const& normal = {0, 0, 1})
{
    WallItemSettings wall;
    wall.name = "plane";
    wall.shape = "plane";
    wall.point = point;
    wall.normal = normal;
    return wall;
}

inline WallItemSettings tube_wall(double radius, bool inside, double length = 0)
{
    WallItemSettings wall;
    wall.name = "tube";
    wall.shape = "cylinder";
    wall.axis = {0, 1, 0};
    wall.radius = radius;
    wall.inside = inside;
    wall.length = length;
    return wall;
}

inline WallItemSettings stl_wall(TemporaryStl const& file, bool open, bool inside = false)
{
    WallItemSettings wall;
    wall.name = "stl";
    wall.shape = "stl";
    wall.file = file.path;
    wall.open = open;
    wall.inside = inside;
    return wall;
}

}  // namespace gimdem::test
