// SPDX-License-Identifier: BSD-3-Clause
/// Particles without walls and without fluid: in open space, or in a periodic box where the case has one.
#pragma once

#include <utility>
#include <vector>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem::test
{

struct OpenSpaceSystem
{
    OpenSpaceSystem(Case case_settings, std::vector<Sphere> const& spheres, exec::Execution execution = serial)
        : settings(std::move(case_settings)),
          materials(settings),
          mesh(without_walls()),
          walls(mesh, {}, 1),
          system(settings, execution, materials, walls, particles_of(spheres))
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
    }

    void run(int steps, double dt)
    {
        for (int s = 0; s < steps; ++s)
            system.step(dt);
    }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;

private:
    static coupling::Mesh without_walls()
    {
        coupling::Mesh mesh = BoxMesh::make({1, 1, 1}, {1, 1, 1});
        for (auto& patch : mesh.patches)
            patch.kind = coupling::PatchKind::open;
        return mesh;
    }
};

}  // namespace gimdem::test
