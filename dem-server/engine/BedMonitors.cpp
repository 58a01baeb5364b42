// SPDX-License-Identifier: BSD-3-Clause
#include "engine/BedMonitors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gimdem
{

namespace
{

/// Lowest corner of the mesh's bounding box along `up`.
double floor_height(PolyMesh const& mesh, Vec3 const& up)
{
    double lowest = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner)
    {
        Vec3 const x((corner & 1) != 0 ? mesh.high().x() : mesh.low().x(),
                     (corner & 2) != 0 ? mesh.high().y() : mesh.low().y(),
                     (corner & 4) != 0 ? mesh.high().z() : mesh.low().z());
        lowest = std::min(lowest, x.dot(up));
    }
    return lowest;
}

}  // namespace

Vec3 upward(Case const& settings)
{
    Vec3 const g(settings.dem.gravity[0], settings.dem.gravity[1], settings.dem.gravity[2]);
    return g.norm() > 0 ? Vec3(-g.normalized()) : Vec3(0, 0, 1);
}

double bed_height(ParticleState const& particles, PolyMesh const& mesh, Vec3 const& up)
{
    if (particles.count() == 0) return 0;
    double largest = 0;
    for (Quad const& x : particles.position.host())
        largest = std::max(largest, x.w);
    Vec3 const axis = std::abs(up.x()) < 0.9 ? Vec3(Vec3(1, 0, 0) - up.x() * up).normalized()
                                             : Vec3(Vec3(0, 1, 0) - up.y() * up).normalized();
    Vec3 const other = up.cross(axis);
    double const width = 8 * largest;

    double const base = floor_height(mesh, up);
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<double>> columns;
    for (Quad const& x : particles.position.host())
    {
        Vec3 const at = x.xyz() - mesh.low();
        auto const column = [&](double along) { return static_cast<std::int64_t>(std::floor(along / width)); };
        columns[{column(at.dot(axis)), column(at.dot(other))}].push_back(x.xyz().dot(up) + x.w - base);
    }
    double sum = 0;
    for (auto& [place, tops] : columns)
    {
        auto const rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(tops.size() - 1) + 0.5);
        std::nth_element(tops.begin(), tops.begin() + rank, tops.end());
        sum += tops[static_cast<std::size_t>(rank)];
    }
    return sum / static_cast<double>(columns.size());
}

double centre_of_mass_height(ParticleState const& particles, PolyMesh const& mesh, Vec3 const& up)
{
    double moment = 0;
    for (std::int64_t p = 0; p < particles.count(); ++p)
        moment += particles.mass(p) * particles.position[p].xyz().dot(up);
    double const mass = total_mass(particles);
    return mass > 0 ? moment / mass - floor_height(mesh, up) : 0;
}

Vec3 momentum(ParticleState const& particles)
{
    Vec3 sum = Vec3::Zero();
    for (Quad const& v : particles.velocity.host())
        sum += v.xyz() / v.w;
    return sum;
}

double total_mass(ParticleState const& particles)
{
    double sum = 0;
    for (Quad const& v : particles.velocity.host())
        sum += 1 / v.w;
    return sum;
}

double fastest(ParticleState const& particles)
{
    double largest = 0;
    for (Quad const& v : particles.velocity.host())
        largest = std::max(largest, v.xyz().squaredNorm());
    return std::sqrt(largest);
}

double patch_pressure(PolyMesh const& mesh, coupling::Patch const& patch, coupling::FluidFields const& fluid)
{
    double sum = 0;
    for (std::int32_t f = patch.start_face; f < patch.start_face + patch.face_count; ++f)
    {
        std::int32_t const cell = mesh.topology().owner[static_cast<std::size_t>(f)];
        auto const c = static_cast<std::size_t>(cell);
        Vec3 const offset = mesh.face_centre(f) - mesh.centroid(cell);
        double pressure = fluid.pressure[c];
        if (!fluid.pressure_gradient.empty())
            for (std::size_t axis = 0; axis < 3; ++axis)
                pressure += offset[static_cast<int>(axis)] * fluid.pressure_gradient[3 * c + axis];
        sum += mesh.face_area(f) * pressure;
    }
    return sum / patch_area(mesh, patch);
}

double patch_area(PolyMesh const& mesh, coupling::Patch const& patch)
{
    double sum = 0;
    for (std::int32_t f = patch.start_face; f < patch.start_face + patch.face_count; ++f)
        sum += mesh.face_area(f);
    return sum;
}

}  // namespace gimdem
