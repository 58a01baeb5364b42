// SPDX-License-Identifier: BSD-3-Clause
#include "particles/Insertion.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.hpp"
#include "particles/RandomInsertion.hpp"
#include "particles/SphereSeed.hpp"

namespace gimdem
{

namespace
{

/// Uniform in [-1, 1) from the raw bits of a 64-bit Mersenne twister: the same numbers with any standard library.
double symmetric(std::mt19937_64& random)
{
    return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// A simple cubic lattice filled layer by layer along `up` (against gravity), stretched across to fill the box.
std::vector<SphereSeed> lattice(InsertionSettings const& settings, std::int64_t count, int up)
{
    double const radius = settings.diameter / 2;
    int const across[2] = {(up + 1) % 3, (up + 2) % 3};
    Vec3 low, size;
    for (int axis = 0; axis < 3; ++axis)
    {
        auto const a = static_cast<std::size_t>(axis);
        low[axis] = settings.box[0][a];
        size[axis] = settings.box[1][a] - low[axis];
    }
    std::int64_t n[3];
    Vec3 step;
    for (int axis = 0; axis < 3; ++axis)
    {
        n[axis] = static_cast<std::int64_t>(std::floor(size[axis] / settings.spacing + 1e-9));
        if (n[axis] < 1)
            throw UserError(
                fmt::format("[[insertion]] box is thinner ({:.6g} m) than one spacing ({:.6g} m); no particle "
                            "fits: widen the box or reduce the spacing",
                            size[axis], settings.spacing));
        step[axis] = axis == up ? settings.spacing : size[axis] / static_cast<double>(n[axis]);
    }
    std::int64_t const room = n[0] * n[1] * n[2];
    if (count > room)
        throw UserError(
            fmt::format("[[insertion]] asks for {} particles, but a lattice of spacing {:.6g} m has room for {} "
                        "in its box; enlarge the box or reduce the spacing",
                        count, settings.spacing, room));

    std::mt19937_64 random(settings.seed);
    std::vector<SphereSeed> seeds;
    seeds.reserve(static_cast<std::size_t>(count));
    for (std::int64_t k = 0; k < count; ++k)
    {
        std::int64_t at[3];
        at[across[0]] = k % n[across[0]];
        at[across[1]] = k / n[across[0]] % n[across[1]];
        at[up] = k / (n[across[0]] * n[across[1]]);
        Vec3 x;
        for (int axis = 0; axis < 3; ++axis)
            x[axis] =
                low[axis] + (static_cast<double>(at[axis]) + 0.5) * step[axis] + settings.jitter * symmetric(random);
        seeds.push_back({x, radius, Vec3(settings.velocity[0], settings.velocity[1], settings.velocity[2])});
    }
    return seeds;
}

std::string_view trimmed(std::string_view text)
{
    auto const begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Numbers of one CSV line.
std::vector<double> parse_numbers(std::string const& line, std::filesystem::path const& file, int number)
{
    std::vector<double> values;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
    {
        std::string_view const text = trimmed(cell);
        double value = 0;
        auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
            throw UserError(
                fmt::format("{}:{}: \"{}\" is not a finite number; each line holds the numbers its header names",
                            file.string(), number, cell));
        values.push_back(value);
    }
    return values;
}

/// Spheres of a CSV file with the header x,y,z[,radius][,vx,vy,vz].
std::vector<SphereSeed> from_file(InsertionSettings const& settings, std::filesystem::path const& folder)
{
    std::filesystem::path const file = folder / settings.file;
    std::ifstream in(file);
    if (!in)
        throw UserError(
            fmt::format("cannot read {} (it holds the particles); check [[insertion]] file", file.string()));

    std::string line;
    std::getline(in, line);
    std::map<std::string, std::size_t> column;
    std::stringstream names(line);
    for (std::string name; std::getline(names, name, ',');)
    {
        std::erase_if(name, [](char c) { return c == ' ' || c == '\r' || c == '\t'; });
        column.emplace(name, column.size());
    }
    for (char const* const name : {"x", "y", "z"})
        if (!column.contains(name))
            throw UserError(fmt::format("{}:1: the header has no column \"{}\"; it reads x,y,z[,radius][,vx,vy,vz]",
                                        file.string(), name));

    std::vector<SphereSeed> seeds;
    for (int number = 2; std::getline(in, line); ++number)
    {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        auto const values = parse_numbers(line, file, number);
        if (values.size() != column.size())
            throw UserError(fmt::format("{}:{}: {} numbers where the header names {}; complete the line", file.string(),
                                        number, values.size(), column.size()));
        auto const value = [&](char const* name, double otherwise)
        {
            auto const found = column.find(name);
            return found == column.end() ? otherwise : values[found->second];
        };
        SphereSeed const seed{
            {value("x", 0), value("y", 0), value("z", 0)},
            value("radius", settings.diameter / 2),
            {value("vx", settings.velocity[0]), value("vy", settings.velocity[1]), value("vz", settings.velocity[2])}};
        if (!(seed.radius > 0))
            throw UserError(
                fmt::format("{}:{}: radius {:.6g} m (it must be positive); give a column radius or [[insertion]] "
                            "diameter",
                            file.string(), number, seed.radius));
        seeds.push_back(seed);
    }
    return seeds;
}

std::vector<SphereSeed> seeds_of(InsertionSettings const& insertion, Case const& settings, double density, int up,
                                 ParticleState const& present)
{
    if (insertion.arrangement == "file") return from_file(insertion, settings.file.parent_path());
    if (insertion.arrangement == "random") return random_spheres_in_box(insertion, density, present);
    return lattice(insertion,
                   insertion.count > 0 ? insertion.count : count_of_mass(insertion.mass, insertion.diameter, density),
                   up);
}

}  // namespace

void append(std::vector<SphereSeed> const& seeds, int material, double density, std::int64_t first_id,
            ParticleState& particles)
{
    std::int64_t p = particles.count();
    particles.resize(p + std::ssize(seeds));
    for (SphereSeed const& seed : seeds)
    {
        double const mass = density * sphere_volume(seed.radius);
        if (!std::isnormal(mass) || !std::isnormal(mass * seed.radius * seed.radius))
            throw UserError(
                fmt::format("a particle of radius {:.6g} m and density {:.6g} kg/m^3 has no mass or moment of inertia "
                            "that can be computed with; correct the radius (in m) or the density",
                            seed.radius, density));
        particles.position[p] = Quad::of(seed.position, seed.radius);
        particles.velocity[p] = Quad::of(seed.velocity, 1 / mass);
        particles.angular_velocity[p] = {0, 0, 0, 1 / (0.4 * mass * seed.radius * seed.radius)};
        particles.force[p] = particles.torque[p] = {0, 0, 0, 0};
        particles.material[p] = material;
        particles.id[p] = first_id++;
        ++p;
    }
}

std::int64_t count_of_mass(double mass, double diameter, double density)
{
    return std::llround(mass / (density * sphere_volume(diameter / 2)));
}

ParticleState insert_particles(Case const& settings, Materials const& materials)
{
    // Lattices grow against gravity; z where there is none.
    Triple const& g = settings.dem.gravity;
    int up = 2;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(g[static_cast<std::size_t>(axis)]) > std::abs(g[static_cast<std::size_t>(up)])) up = axis;

    ParticleState particles;
    for (InsertionSettings const& insertion : settings.insertion)
    {
        int const material = materials.number_of(insertion.material);
        double const density = materials[material].density;
        append(seeds_of(insertion, settings, density, up, particles), material, density, particles.count(), particles);
    }
    return particles;
}

}  // namespace gimdem
