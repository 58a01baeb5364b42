// SPDX-License-Identifier: BSD-3-Clause
#include "DemScene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "BoxMesh.hpp"
#include "DataFile.hpp"
#include "particles/Insertion.hpp"

namespace gimdem::benchmark
{

namespace
{

constexpr double diameter = 1.545e-3;  // [m]
constexpr double cell = 2.25 * diameter;

/// Constants of the optional laws are small, so that a bed at rest stays about as it is.
Case case_of(SceneOptions const& options, std::array<double, 3> const& box)
{
    Case settings = test::bead_case(options.restitution, options.friction);
    settings.dem.gravity = {0, 0, -options.gravity};
    settings.dem.skin = options.skin;
    settings.dem.precision = options.precision;
    settings.dem.contact_law = options.law;
    settings.dem.rolling_friction = options.rolling;
    settings.dem.cohesion = options.cohesion;
    ContactSettings& contact = settings.contacts.front();
    contact.normal_stiffness = 300;
    contact.rolling_friction = 0.01;
    contact.rolling_damping = 0.3;
    contact.cohesion_energy_density = 50;
    for (int m = 1; m < options.materials; ++m)
    {
        settings.materials.push_back(settings.materials.front());
        settings.materials.back().name += std::to_string(m);
        for (int other = 0; other <= m; ++other)
        {
            settings.contacts.push_back(settings.contacts.front());
            settings.contacts.back().pair = {settings.materials[static_cast<std::size_t>(other)].name,
                                             settings.materials.back().name};
        }
    }
    bool const flat = options.sides == "floor" || options.sides == "periodic";
    settings.domain.box = {Triple{0, 0, 0}, Triple{box[0], box[1], box[2]}};
    settings.domain.periodic = {flat, flat, options.sides == "periodic"};
    return settings;
}

coupling::Mesh mesh_of(std::array<double, 3> const& box, bool fine)
{
    if (!fine) return test::BoxMesh::make({1, 1, 1}, {box[0], box[1], box[2]});
    auto const cells = [](double length) { return std::max(1, static_cast<int>(length / cell)); };
    return test::BoxMesh::make({cells(box[0]), cells(box[1]), cells(box[2])}, {box[0], box[1], box[2]});
}

WallGeometry walls_of(std::string const& sides, PolyMesh const& mesh)
{
    double const reach = 0.6 * diameter;
    if (sides == "walls") return {mesh, {"bottom"}, reach};
    if (sides == "closed") return {mesh, {"bottom", "top"}, reach};
    std::vector<WallItemSettings> items;
    if (sides == "floor")
    {
        items.emplace_back().name = "floor";
        items.back().normal = {0, 0, 1};
    }
    return {items, reach};
}

std::vector<test::Sphere> inserted(SceneOptions const& options, Case settings)
{
    InsertionSettings insertion;
    insertion.material = "bead";
    insertion.diameter = diameter;
    insertion.count = options.count;
    insertion.box = {{{0, 0, 0}, {options.box[0], options.box[1], options.box[2]}}};
    insertion.spacing = options.spacing;
    insertion.jitter = options.jitter;
    insertion.arrangement = options.start;
    if (options.size_ratio > 1)
    {
        insertion.diameter = 0;
        insertion.sizes = SizeSettings{"uniform", diameter / options.size_ratio, diameter, 0, 0, {}, {}};
    }
    settings.insertion = {insertion};
    ParticleState const state = insert_particles(settings, Materials(settings));
    std::vector<test::Sphere> spheres;
    for (std::int64_t i = 0; i < state.count(); ++i)
        spheres.push_back({state.position[i].xyz(), state.position[i].w});
    return spheres;
}

/// Adds Gaussian velocities without a mean.
void agitate(std::vector<test::Sphere>& spheres, double deviation)
{
    std::mt19937_64 random(12345);
    auto const uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
    Vec3 sum = Vec3::Zero();
    for (test::Sphere& s : spheres)
    {
        Vec3 v;
        for (int axis = 0; axis < 3; ++axis)
        {
            double const radius = std::sqrt(-2 * std::log(uniform()));
            v[axis] = deviation * radius * std::cos(2 * std::numbers::pi * uniform());
        }
        s.velocity += v;
        sum += v;
    }
    for (test::Sphere& s : spheres)
        s.velocity -= sum / static_cast<double>(spheres.size());
}

std::vector<test::Sphere> spheres_of(SceneOptions const& options, Case const& settings)
{
    std::vector<test::Sphere> const one = options.data.empty() ? inserted(options, settings) : read_data(options.data);
    std::vector<test::Sphere> all;
    for (int i = 0; i < options.tiles[0]; ++i)
        for (int j = 0; j < options.tiles[1]; ++j)
            for (test::Sphere s : one)
            {
                s.position += Vec3(i * options.box[0], j * options.box[1], 0);
                all.push_back(s);
            }
    for (std::size_t k = 1; k < all.size(); k += 2)
        all[k].radius *= 1 - options.size_step;
    if (options.speed > 0) agitate(all, options.speed);
    return all;
}

}  // namespace

Scene::Scene(SceneOptions const& options)
    : box{options.box[0] * options.tiles[0], options.box[1] * options.tiles[1], options.box[2]},
      mesh(mesh_of(box, options.drag)),
      walls(walls_of(options.sides, mesh))
{
    settings = case_of(options, box);
    spheres = spheres_of(options, settings);
}

ParticleState Scene::particles() const
{
    ParticleState state = test::particles_of(spheres);
    auto const kinds = static_cast<std::int64_t>(settings.materials.size());
    for (std::int64_t i = 0; i < state.count(); ++i)
        state.material[i] = static_cast<std::int32_t>(i % kinds);
    return state;
}

}  // namespace gimdem::benchmark
