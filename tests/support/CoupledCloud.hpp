// SPDX-License-Identifier: BSD-3-Clause
/// Particles of one size, on a lattice, in a box of fluid that moves as one body along x.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/CoupledEngine.hpp"

namespace gimdem::test
{

/// 64 particles, at rest in a box of 4 cm, in eight cells, eight in each: by symmetry all do the same.
struct CoupledCloud
{
    struct Properties
    {
        double radius = 5e-4;            ///< [m]
        double particle_density = 1000;  ///< [kg/m^3]
        double fluid_density = 1;        ///< [kg/m^3]
        double viscosity = 1e-2;         ///< [Pa s]
        double gravity = 0;              ///< along x [m/s^2]
        bool drag = true;
        bool pressure_gradient = false;
    };

    static constexpr int along = 4;
    static constexpr double length = 0.04;  ///< of the box [m]
    static constexpr double volume = length * length * length;
    static constexpr double dem_step = 1e-5;  ///< [s]

    explicit CoupledCloud(Properties const& given, exec::Execution execution = serial)
        : properties(given),
          settings(case_of(given)),
          materials(settings),
          mesh(BoxMesh::make({2, 2, 2}, {length, length, length})),
          walls(mesh, {"bottom", "top"}, 2 * given.radius),
          system(settings, execution, materials, walls, particles_of(lattice(given.radius), given.particle_density))
    {
        system.prepare();
        engine = std::make_unique<CoupledEngine>(
            settings, execution, mesh, walls, coupling::FluidProperties{given.fluid_density, given.viscosity}, system);
        engine->map_initial_state();
    }

    /// One step in a fluid of this velocity [m/s] and pressure gradient [Pa/m], both along x.
    StepReport advance(coupling::Step const& step, double velocity, double gradient = 0)
    {
        set_fluid(velocity, gradient);
        return engine->advance(step, fluid());
    }
    void set_fluid(double velocity, double gradient)
    {
        auto const cells = static_cast<std::size_t>(mesh.cell_count());
        fluid_velocity.assign(3 * cells, 0);
        pressure_gradient.assign(3 * cells, 0);
        for (std::size_t c = 0; c < cells; ++c)
        {
            fluid_velocity[3 * c] = velocity;
            pressure_gradient[3 * c] = gradient;
        }
    }
    coupling::FluidFields fluid() const
    {
        coupling::FluidFields fields;
        fields.velocity = fluid_velocity;
        fields.pressure_gradient = pressure_gradient;
        return fields;
    }

    /// Force on all of the fluid along x [N], were its velocity that [m/s].
    double force_on_fluid(double velocity) const
    {
        auto const solid = engine->fields();
        double sum = 0;
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        {
            auto const i = static_cast<std::size_t>(c);
            sum += mesh.volume(c) * (solid.drag_momentum[3 * i] - solid.drag_coefficient[i] * velocity);
        }
        return sum;
    }
    /// Drag coefficient of one particle [kg/s].
    double drag_coefficient() const
    {
        double sum = 0;
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
            sum += mesh.volume(c) * engine->fields().drag_coefficient[static_cast<std::size_t>(c)];
        return sum / static_cast<double>(count);
    }

    double solid_volume() const { return static_cast<double>(count) * sphere_volume(properties.radius); }  ///< [m^3]
    double fluid_mass() const { return properties.fluid_density * (volume - solid_volume()); }             ///< [kg]
    double mass() const { return properties.particle_density * sphere_volume(properties.radius); }  ///< of one [kg]
    /// Mean velocity of the particles along x [m/s].
    double velocity() const
    {
        double sum = 0;
        for (std::int64_t p = 0; p < count; ++p)
            sum += std::as_const(system).particles().velocity[p].x;
        return sum / static_cast<double>(count);
    }

    static constexpr std::int64_t count = along * along * along;
    Properties properties;
    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;
    std::unique_ptr<CoupledEngine> engine;
    std::vector<double> fluid_velocity, pressure_gradient;

private:
    static Case case_of(Properties const& given)
    {
        Case settings = bead_case();
        settings.materials[0].density = given.particle_density;
        settings.dem.time_step = dem_step;
        settings.dem.gravity = {given.gravity, 0, 0};
        settings.fluid_forces.drag = given.drag ? "beetstra" : "none";
        settings.fluid_forces.pressure_gradient = given.pressure_gradient;
        return settings;
    }
    static std::vector<Sphere> lattice(double radius)
    {
        std::vector<Sphere> spheres;
        for (int k = 0; k < along; ++k)
            for (int j = 0; j < along; ++j)
                for (int i = 0; i < along; ++i)
                    spheres.push_back({length / along * (Vec3(i, j, k) + Vec3::Constant(0.5)), radius, {0, 0, 0}});
        return spheres;
    }
};

}  // namespace gimdem::test
