// SPDX-License-Identifier: BSD-3-Clause
/// `fbsi`, face-based soft intersection, theory.md (G.28): a cell's share is the product over its faces of the part of
/// the particle behind each. Faces of the boundary do not count, so that nothing is lost through walls.
#pragma once

#include "mapping/methods/ReachingMethod.hpp"

namespace gimdem
{

/// Part of a ball behind a plane that its centre is `outside` of, in units of the radius: the spherical cap.
GIMDEM_HD inline double part_behind(double outside)
{
    double const t = outside > 1 ? 0 : (outside < -1 ? 1 : (1 - outside) / 2);
    return t * t * (3 - 2 * t);
}

class FaceSoftIntersection : public ReachingMethod
{
public:
    // All cells whose faces' planes a ball may reach: the corners of a box around it.
    FaceSoftIntersection(exec::Execution const& execution, PolyMesh const& mesh)
        : ReachingMethod(execution, mesh, 1.7320508075688772), mesh_(mesh)
    {
    }

    void compute_weights(WeightTask const& task) override { fill_rows(task, Law{mesh_.view()}); }

private:
    struct Law
    {
        MeshKernelView mesh;

        GIMDEM_HD void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
        {
            for (int k = 0; k < count; ++k)
                w[k] = share(particle, cells[k]);
        }

        GIMDEM_HD double share(Quad const& particle, std::int32_t cell) const
        {
            double product = 1;
            for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1] && product > 0; ++k)
            {
                std::int32_t const face = mesh.cell_faces[k];
                if (face >= mesh.internal_face_count) continue;
                product *= part_behind(mesh.distance_outside(face, cell, particle.xyz()) / particle.w);
            }
            return product;
        }
    };

    PolyMesh const& mesh_;
};

}  // namespace gimdem
