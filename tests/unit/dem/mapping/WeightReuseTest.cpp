// SPDX-License-Identifier: BSD-3-Clause
/// Weights that are reused are those of the place and cell where a particle was when it last moved too far; so they are
/// the same after a restart and in any order of the particles.
#include "mapping/WeightReuse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "CellMeshes.hpp"
#include "Figure.hpp"
#include "Mapped.hpp"
#include "SameBits.hpp"
#include "mapping/Mapper.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr double distance = 0.05;

MappingSettings reusing(std::string_view name)
{
    MappingSettings settings = method(name);
    settings.reuse_distance = distance;
    return settings;
}

/// Particles that wander about a mesh, and a mapper that follows them.
struct Walk
{
    Walk(PolyMesh const& on, std::string_view name, exec::Execution execution = serial)
        : Walk(on, name, particles_of(random_spheres(200, on.low(), on.high(), 0.02, 0.08)), execution)
    {
    }
    Walk(PolyMesh const& on, std::string_view name, ParticleState some, exec::Execution execution = serial)
        : mesh(on), particles(std::move(some)), mapper(execution, mesh, reusing(name)), walls(mesh.face_count())
    {
        walls.fill(1);
        map();
    }
    void map()
    {
        mapper.locate(particles, walls);
        mapper.compute_weights(particles);
    }
    /// Everyone moves by up to 4 % of its diameter along each axis; by its id, so that the order does not matter.
    void step()
    {
        ++steps;
        for (std::int64_t p = 0; p < particles.count(); ++p)
        {
            std::mt19937_64 random(static_cast<std::uint64_t>(1000 * steps + particles.id[p]));
            std::uniform_real_distribution<double> uniform(-0.04, 0.04);
            Quad& x = particles.position[p];
            Vec3 const way(uniform(random), uniform(random), uniform(random));
            x.set_xyz((x.xyz() + 2 * x.w * way).cwiseMax(mesh.low()).cwiseMin(mesh.high()));
        }
        map();
    }
    /// The particle that was at order[i] is now at i.
    void reorder(std::vector<std::int32_t> const& order)
    {
        particles.permute(serial, order);
        mapper.permute(order);
    }
    auto rows() const { return rows_by_id(mapper, particles); }

    PolyMesh const& mesh;
    ParticleState particles;
    Mapper mapper;
    exec::Buffer<std::uint8_t> walls;
    int steps = 0;
};

class WeightReuseOf : public testing::TestWithParam<std::string_view>
{
protected:
    PolyMesh const mesh{voronoi_cells(4, {1, 1, 1}).mesh()};
};
INSTANTIATE_TEST_SUITE_P(Methods, WeightReuseOf, testing::Values("gim", "fbsi", "exact", "divided", "pcm"));

TEST_P(WeightReuseOf, GivesTheWeightsOfTheLastPlaceThatWasTooFar)
{
    Walk walk(mesh, GetParam());
    // What is expected, one particle at a time.
    std::vector<Quad> last(walk.particles.position.host().begin(), walk.particles.position.host().end());
    std::vector<std::int32_t> cell(walk.mapper.cell_of().host().begin(), walk.mapper.cell_of().host().end());
    std::int64_t kept = 0, renewed = 0;
    Mapper plain(serial, mesh, method(GetParam()));
    for (int step = 0; step < 15; ++step)
    {
        // A large one among them from here on: other candidates for all.
        if (step == 7) walk.particles.position[0].w = 0.11;
        walk.step();
        ParticleState at_last;
        at_last.resize(walk.particles.count());
        for (std::int64_t p = 0; p < walk.particles.count(); ++p)
        {
            auto const i = static_cast<std::size_t>(p);
            Quad const& x = walk.particles.position[p];
            bool const serves = cell[i] == walk.mapper.cell_of()[p] && last[i].w == x.w &&
                                (x.xyz() - last[i].xyz()).norm() <= 2 * x.w * distance;
            (serves ? kept : renewed) += 1;
            if (!serves) last[i] = x;
            cell[i] = walk.mapper.cell_of()[p];
            at_last.position[p] = last[i];
        }
        plain.locate(at_last, walk.walls);
        plain.compute_weights(at_last);
        ASSERT_TRUE(same_bits(plain.cell_of(), walk.mapper.cell_of()));
        EXPECT_TRUE(same_bits(plain.weights(), walk.mapper.weights())) << step;
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(renewed, 500);
}

TEST_P(WeightReuseOf, IsTheSameInAnyOrderAndOnAnyNumberOfThreads)
{
    Walk one(mesh, GetParam()), other(mesh, GetParam(), {exec::Backend::openmp, 3});
    std::vector<std::int32_t> order(static_cast<std::size_t>(one.particles.count()));
    std::iota(order.begin(), order.end(), 0);
    for (int step = 0; step < 6; ++step)
    {
        std::ranges::shuffle(order, std::mt19937_64(static_cast<std::uint64_t>(step)));
        other.reorder(order);
        one.step();
        other.step();
        EXPECT_EQ(one.rows(), other.rows());
    }
}

TEST_P(WeightReuseOf, IsTheSameAfterARestart)
{
    Walk one(mesh, GetParam());
    for (int step = 0; step < 4; ++step)
        one.step();
    Walk restarted(mesh, GetParam());
    restarted.particles = one.particles;
    restarted.steps = one.steps;
    restarted.mapper.reuse()->restore(one.mapper.reuse()->reference());
    restarted.map();
    EXPECT_EQ(one.rows(), restarted.rows());
    for (int step = 0; step < 4; ++step)
    {
        one.step();
        restarted.step();
        EXPECT_EQ(one.rows(), restarted.rows());
    }
}

TEST(WeightReuse, FollowsParticlesThatComeAndGo)
{
    PolyMesh const mesh(voronoi_cells(4, {1, 1, 1}).mesh());
    Walk walk(mesh, "exact");
    walk.step();
    auto const before = walk.rows();
    // The first half goes, then ten come.
    std::vector<std::int32_t> order(100);
    std::iota(order.begin(), order.end(), 100);
    walk.reorder(order);
    order.resize(110);
    std::iota(order.begin(), order.end(), 0);
    ParticleState const others = particles_of(random_spheres(110, mesh.low(), mesh.high(), 0.02, 0.08, 12));
    walk.particles.resize(110);
    for (std::int64_t p = 100; p < 110; ++p)
    {
        walk.particles.position[p] = others.position[p];
        walk.particles.id[p] = 100 + p;
    }
    walk.mapper.permute(order);
    walk.map();
    auto const after = walk.rows();
    for (std::int64_t id = 100; id < 200; ++id)
        EXPECT_EQ(after.at(id), before.at(id));
    ASSERT_EQ(after.size(), 110u);
    auto const fresh = Walk(mesh, "exact", walk.particles).rows();
    for (std::int64_t id = 200; id < 210; ++id)
        EXPECT_EQ(after.at(id), fresh.at(id));
}

/// Largest error of a weight where all particles are as far from their references as they may be, away from walls.
double largest_error(std::string_view name)
{
    PolyMesh const mesh(hexahedra(8, {0.25, 0.25, 0.25}).mesh());
    Walk walk(mesh, name);
    auto spheres = random_spheres(300, Vec3::Constant(0.4), Vec3::Constant(1.6), 0.05, 0.1);
    walk.particles = particles_of(spheres);
    walk.map();
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    for (Sphere& sphere : spheres)
    {
        Vec3 const way = Vec3(normal(random), normal(random), normal(random)).normalized();
        sphere.position += 0.999 * distance * 2 * sphere.radius * way;
    }
    walk.particles = particles_of(spheres);
    walk.map();
    Mapped const now(mesh, method(name), spheres);
    EXPECT_TRUE(same_bits(walk.mapper.cell_of(), now.mapper.cell_of()));
    double largest = 0;
    for (std::int64_t k = 0; k < now.mapper.weights().size(); ++k)
        largest = std::max(largest, std::abs(walk.mapper.weights()[k] - now.mapper.weights()[k]));
    return largest;
}

TEST(WeightReuse, OfTheExactOverlapErrsByTheDistanceAtMost)
{
    double const error = largest_error("exact");
    // (G.19), which a plane through the centre and across the way reaches.
    EXPECT_LT(error, 1.5 * distance);
    EXPECT_GT(error, 0.8 * 1.5 * distance);
    figure("reuse_error_of_exact", error / distance);
    figure("reuse_error_of_gim", largest_error("gim") / distance);
    figure("reuse_error_of_fbsi", largest_error("fbsi") / distance);
}

}  // namespace
