// SPDX-License-Identifier: BSD-3-Clause
#include "DataFile.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gimdem::benchmark
{

namespace
{

constexpr double density = 1150;  // [kg/m^3]

void read_atom(std::istringstream& words, test::Sphere& s)
{
    double type, diameter, its_density;
    words >> type >> diameter >> its_density >> s.position[0] >> s.position[1] >> s.position[2];
    s.radius = diameter / 2;
}

void read_velocity(std::istringstream& words, test::Sphere& s)
{
    for (Vec3* v : {&s.velocity, &s.angular_velocity})
        words >> (*v)[0] >> (*v)[1] >> (*v)[2];
}

}  // namespace

std::vector<test::Sphere> read_data(std::string const& path)
{
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::vector<test::Sphere> spheres;
    std::string line, section;
    while (std::getline(file, line))
    {
        std::istringstream words(line);
        std::string first;
        if (!(words >> first)) continue;
        if (first == "Atoms" || first == "Velocities")
        {
            section = first;
            continue;
        }
        if (section.empty()) continue;
        auto const id = std::stoul(first);
        if (spheres.size() < id) spheres.resize(id);
        if (section == "Atoms")
            read_atom(words, spheres[id - 1]);
        else
            read_velocity(words, spheres[id - 1]);
        if (!words) throw std::runtime_error(path + ": cannot read \"" + line + "\"");
    }
    return spheres;
}

void write_data(std::string const& path, ParticleState const& p, std::array<double, 3> const& box)
{
    std::vector<std::int64_t> place(static_cast<std::size_t>(p.count()));
    for (std::int64_t i = 0; i < p.count(); ++i)
        place[static_cast<std::size_t>(p.id[i])] = i;
    std::ofstream file(path);
    file << fmt::format("state of benchmark_dem\n\n{} atoms\n1 atom types\n\n", p.count());
    for (std::size_t axis = 0; axis < 3; ++axis)
        file << fmt::format("0 {:.17g} {}lo {}hi\n", box[axis], "xyz"[axis], "xyz"[axis]);
    file << "\nAtoms\n\n";
    for (std::size_t k = 0; k < place.size(); ++k)
    {
        Quad const x = p.position[place[k]];
        file << fmt::format("{} 1 {:.17g} {} {:.17g} {:.17g} {:.17g}\n", k + 1, 2 * x.w, density, x.x, x.y, x.z);
    }
    file << "\nVelocities\n\n";
    for (std::size_t k = 0; k < place.size(); ++k)
    {
        Quad const v = p.velocity[place[k]], w = p.angular_velocity[place[k]];
        file << fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", k + 1, v.x, v.y, v.z, w.x, w.y,
                            w.z);
    }
    file.flush();
    if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace gimdem::benchmark
