// SPDX-License-Identifier: BSD-3-Clause
#include "MappingScene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "BoxMesh.hpp"
#include "CellMeshes.hpp"
#include "PolyMeshFiles.hpp"
#include "RandomPacking.hpp"
#include "core/Error.hpp"

namespace gimdem::benchmark
{

namespace
{

/// What a box is made of.
struct Pattern
{
    Vec3 period;                ///< [diameters]
    std::array<int, 3> counts;  ///< of periods along each axis
    Vec3 lengths() const { return diameter * period.cwiseProduct(Vec3(counts[0], counts[1], counts[2])); }
};

Pattern pattern_of(MeshOptions const& options)
{
    double const a = options.ratio;
    Vec3 period(a, a, a);
    if (options.mesh == "stretched-2") period = a / std::cbrt(2) * Vec3(1, 1, 2);
    if (options.mesh == "stretched-4") period = a / std::cbrt(4) * Vec3(1, 1, 4);
    if (options.mesh == "tetrahedra") period *= std::cbrt(6);
    Pattern pattern{period, {}};
    for (int axis = 0; axis < 3; ++axis)
        pattern.counts[axis] =
            std::max(options.cells, static_cast<int>(std::ceil(options.width / period[axis] - 1e-9)));
    // The making of more of them takes long.
    if (options.mesh == "polyhedra") pattern.counts.fill(std::min(pattern.counts[0], 11));
    return pattern;
}

bool is_built_in(MeshOptions const& options)
{
    return std::ranges::find(built_in_meshes, options.mesh) != std::end(built_in_meshes);
}

coupling::Mesh make_mesh(MeshOptions const& options)
{
    if (!is_built_in(options)) return test::read_poly_mesh(options.mesh);
    Pattern const pattern = pattern_of(options);
    Vec3 const lengths = pattern.lengths();
    int const n = pattern.counts[0];
    if (options.mesh == "tetrahedra") return test::shaken(test::tetrahedra(n, diameter * pattern.period), 0.1).mesh();
    if (options.mesh == "polyhedra") return test::voronoi_cells(n, lengths).mesh();
    return test::BoxMesh::make(pattern.counts, {lengths.x(), lengths.y(), lengths.z()});
}

}  // namespace

MappingScene::MappingScene(MeshOptions const& options)
    : mesh(make_mesh(options)), box{mesh.low(), mesh.high()}, is_from_files(!is_built_in(options))
{
    double volume = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        volume += mesh.volume(c);
    if (std::abs(volume / (box.high - box.low).prod() - 1) > 1e-6)
        throw UserError(fmt::format("{} is not a box along the axes (it fills {:.3g} of one); give another mesh",
                                    options.mesh, volume / (box.high - box.low).prod()));
    if (is_from_files)
    {
        middle = bed(bed_count);
        middle.low.array() += diameter / 2;
        middle.high.array() -= diameter / 2;
        return;
    }
    Pattern const pattern = pattern_of(options);
    int const periods = options.mesh == "polyhedra" ? 3 : 1;  // all of its cells are different
    for (int axis = 0; axis < 3; ++axis)
        middle.low[axis] = diameter * pattern.period[axis] * ((pattern.counts[axis] - periods) / 2);
    middle.high = middle.low + diameter * periods * pattern.period;
}

double MappingScene::ratio() const
{
    return std::cbrt((box.high - box.low).prod() / mesh.cell_count()) / diameter;
}

Region MappingScene::bed(std::int64_t count) const
{
    Vec3 const edges = box.high - box.low;
    double const height =
        static_cast<double>(count) * sphere_volume(diameter / 2) / (solid_fraction * edges.x() * edges.y());
    if (count == 0 || height > edges.z()) return box;
    return {box.low, box.low + Vec3(edges.x(), edges.y(), height)};
}

std::vector<test::Sphere> MappingScene::packing(std::int64_t count, int sweeps) const
{
    Region const at = bed(count);
    double const volume = (at.high - at.low).prod();
    test::RandomPacking packing(std::lround(solid_fraction * volume / sphere_volume(diameter / 2)), at.low, at.high,
                                diameter);
    packing.shake(sweeps);
    std::vector<test::Sphere> spheres;
    for (Vec3 const& x : packing.centres())
        spheres.push_back({x, diameter / 2});
    return spheres;
}

}  // namespace gimdem::benchmark
