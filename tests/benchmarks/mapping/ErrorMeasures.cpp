// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorMeasures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "particles/Random.hpp"

namespace gimdem::benchmark
{

namespace
{

constexpr std::size_t batch = 512;  ///< particles whose weights are held at a time

Vec3 random_place(RandomStream& random, Region const& region)
{
    double const x = random.unit(), y = random.unit(), z = random.unit();
    return region.low + (region.high - region.low).cwiseProduct(Vec3(x, y, z));
}

Vec3 random_direction(RandomStream& random)
{
    double const z = random.between(-1, 1), angle = random.between(0, 2 * std::numbers::pi);
    double const across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

bool is_inside(Vec3 const& x, Region const& region)
{
    return (x - region.low).minCoeff() >= 0 && (region.high - x).minCoeff() >= 0;
}

bool is_at_wall(PolyMesh const& mesh, std::int32_t cell)
{
    return std::ranges::any_of(mesh.faces_of_cell(cell),
                               [&](std::int32_t f) { return f >= mesh.internal_face_count(); });
}

}  // namespace

Probes::Probes(MappingScene const& scene, int place_count, int line_count)
{
    RandomStream random(29);
    for (int i = 0; i < place_count; ++i)
        places.push_back({random_place(random, scene.middle), diameter / 2});
    while (std::ssize(lines) < line_count)
    {
        Vec3 const from = random_place(random, scene.middle);
        Vec3 const step = diameter / 100 * random_direction(random);
        if (scene.is_from_files && !is_inside(from + steps_per_line * step, scene.middle)) continue;
        auto& line = lines.emplace_back();
        for (int k = 0; k <= steps_per_line; ++k)
            line.push_back({from + k * step, diameter / 2});
    }
}

double wrong_cells(MethodOnMesh& method, MethodOnMesh& exact, Probes const& probes)
{
    double sum = 0;
    for (std::size_t first = 0; first < probes.places.size(); first += batch)
    {
        auto const from = probes.places.begin() + static_cast<std::ptrdiff_t>(first);
        auto const count = static_cast<std::ptrdiff_t>(std::min(batch, probes.places.size() - first));
        std::vector<test::Sphere> const some(from, from + count);
        auto const rows = method.weights(some), right = exact.weights(some);
        for (std::size_t p = 0; p < rows.size(); ++p)
            sum += test::share_in_wrong_cells(rows[p], right[p]);
    }
    return sum / static_cast<double>(probes.places.size());
}

Jump void_fraction_jump(MethodOnMesh& method, PolyMesh const& mesh, Probes const& probes)
{
    Jump jump;
    double const volume = sphere_volume(diameter / 2);
    std::int64_t steps = 0;
    for (auto const& line : probes.lines)
    {
        auto const rows = method.weights(line);
        for (std::size_t k = 1; k < rows.size(); ++k, ++steps)
        {
            double largest = 0;
            test::for_each_cell_of(rows[k - 1], rows[k],
                                   [&](std::int32_t cell, double a, double b)
                                   { largest = std::max(largest, std::abs(b - a) * volume / mesh.volume(cell)); });
            jump.largest = std::max(jump.largest, largest);
            jump.mean += largest;
        }
    }
    jump.mean /= static_cast<double>(steps);
    return jump;
}

PackingErrors packing_errors(MappingScene const& scene, Region const& bed, std::vector<double> const& fractions,
                             std::vector<double> const& exact)
{
    double squares = 0, volumes = 0, at_walls = 0, exact_at_walls = 0;
    for (std::int32_t c = 0; c < scene.mesh.cell_count(); ++c)
    {
        auto const i = static_cast<std::size_t>(c);
        double const volume = scene.mesh.volume(c);
        if (!is_inside(scene.mesh.centroid(c), bed)) continue;
        squares += volume * (fractions[i] - exact[i]) * (fractions[i] - exact[i]);
        volumes += volume;
        if (!is_at_wall(scene.mesh, c)) continue;
        at_walls += volume * fractions[i];
        exact_at_walls += volume * exact[i];
    }
    return {std::sqrt(squares / volumes), *std::ranges::max_element(fractions), at_walls / exact_at_walls};
}

}  // namespace gimdem::benchmark
