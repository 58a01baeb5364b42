// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoints of a run that reuses weights: they serve after the restart as they would have without it.
#include "BoxMesh.hpp"
#include "CheckpointRun.hpp"
#include "Mapped.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

MappingSettings reusing()
{
    MappingSettings settings = method("exact");
    settings.reuse_distance = 0.05;
    return settings;
}

/// A short run that is mapped every twenty steps.
struct MappedRun
{
    explicit MappedRun(exec::Execution execution) : run(execution), mapper(execution, mesh, reusing())
    {
        faces.resize(mesh.face_count());
        faces.fill(0);
        run.system.set_permutation_listener([this](std::span<std::int32_t const> order) { mapper.permute(order); });
    }
    void map()
    {
        mapper.locate(particles(), faces);
        mapper.compute_weights(particles());
    }
    void run_to(std::int64_t step)
    {
        while (run.at.step < step)
        {
            run.run_to(run.at.step + 20);
            map();
        }
    }
    void write(std::filesystem::path const& file) const
    {
        write_checkpoint(file, run.settings, run.at, run.inlets, run.system, mapper.reuse());
    }
    void read(std::filesystem::path const& file)
    {
        run.at = read_checkpoint(file, run.settings, run.inlets, run.system, mapper.reuse());
    }
    ParticleState const& particles() const { return std::as_const(run.system).particles(); }
    auto rows() const { return rows_by_id(mapper, particles()); }

    PolyMesh mesh{BoxMesh::make({5, 5, 6}, {0.02, 0.02, 0.03})};
    ShortRun run;
    Mapper mapper;
    exec::Buffer<std::uint8_t> faces;
};

TEST_F(CheckpointTest, WeightsThatAreReusedComeBack)
{
    MappedRun through(serial);
    through.run_to(400);
    through.write(file);
    // Without its references a run would have other weights.
    MappedRun forgetful(serial);
    forgetful.run.read(file);
    forgetful.map();
    EXPECT_NE(through.rows(), forgetful.rows());

    for (auto const& execution : {serial, three_threads})
    {
        MappedRun before(serial), after(execution);
        before.run_to(400);
        after.read(file);
        after.map();
        EXPECT_EQ(before.rows(), after.rows());
        before.run_to(480);
        after.run_to(480);
        EXPECT_EQ(before.rows(), after.rows());
    }
}

TEST_F(CheckpointTest, CheckpointWithoutReferencesIsRefusedWhereWeightsAreReused)
{
    MappedRun run(serial);
    run.run_to(20);
    run.run.write(file);
    EXPECT_THROW(run.read(file), UserError);
}

}  // namespace
