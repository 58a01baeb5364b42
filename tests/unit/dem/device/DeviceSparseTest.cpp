// SPDX-License-Identifier: BSD-3-Clause
/// A device tells which cells of the next fluid its particles read, and reads no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "DeviceBackends.hpp"
#include "DeviceScene.hpp"
#include "engine/CoupledEngine.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr BoxMesh::Size size{4, 4, 24};
constexpr std::size_t cells = 4 * 4 * 24;
constexpr int steps = 4;
constexpr double dt = 2.5e-3;  ///< coupling step [s]

/// 216 beads at the bottom of a tall box, carried upward by water at 4 m/s: they cross three cells of 3 mm in a
/// coupling step, so that the velocity that was asked for is not always enough.
struct TallScene
{
    explicit TallScene(exec::Execution execution)
        : settings(made()),
          materials(settings),
          mesh(BoxMesh::make(size, {0.0126, 0.0126, 0.0756})),
          walls(mesh, {"bottom", "top"}, 1.5e-3),
          system(settings, execution, materials, walls, particles_of(loose_spheres(6)))
    {
        system.prepare();
        engine = std::make_unique<CoupledEngine>(settings, execution, mesh, walls,
                                                 coupling::FluidProperties{1000, 1e-3}, system);
        engine->map_initial_state();
    }

    static Case made()
    {
        Case settings = DeviceScene::falling();
        settings.dem.time_step = 4e-5;
        return settings;
    }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;
    std::unique_ptr<CoupledEngine> engine;
};

/// Another one in each cell and step; or not a number where no field is needed.
class WaterAt
{
public:
    explicit WaterAt(int step)
    {
        for (std::size_t i = 0; i < 9 * cells; ++i)
        {
            double const x = std::sin(0.37 * static_cast<double>(i) + step);
            values_["velocity_gradient"].push_back(20 * x);
            if (i >= 3 * cells) continue;
            values_["velocity"].push_back(0.3 * x + (i % 3 == 2 ? 4 : 0));
            values_["pressure_gradient"].push_back(50 * x);
            values_["void_fraction_gradient"].push_back(20 * x);
        }
    }

    /// Returns how many cells have no velocity any more.
    std::size_t spoil_but(std::vector<coupling::NeededCells> const& needed)
    {
        std::size_t without_velocity = 0;
        for (coupling::NeededCells const& some : needed)
            for (std::string const& field : some.fields)
                for (std::size_t c = 0; c < cells && values_.count(field) == 1; ++c)
                {
                    if (contains(some.cells, {{static_cast<std::int32_t>(c), 1}})) continue;
                    std::vector<double>& values = values_[field];
                    std::size_t const components = values.size() / cells;
                    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(c * components), components,
                                std::numeric_limits<double>::quiet_NaN());
                    without_velocity += field == "velocity";
                }
        return without_velocity;
    }

    coupling::FluidFields fields() const
    {
        return {values_.at("velocity"),
                values_.at("velocity_gradient"),
                values_.at("pressure_gradient"),
                values_.at("void_fraction_gradient"),
                {}};
    }

private:
    std::map<std::string, std::vector<double>> values_;
};

void expect_same_bits(CoupledEngine const& one, CoupledEngine const& other)
{
    auto const a = one.fields(), b = other.fields();
    auto const same = [](coupling::Span<double const> x, coupling::Span<double const> y)
    { return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0; };
    EXPECT_TRUE(same(a.void_fraction, b.void_fraction));
    EXPECT_TRUE(same(a.momentum_source, b.momentum_source));
    EXPECT_TRUE(same(a.drag_coefficient, b.drag_coefficient));
    EXPECT_TRUE(same(a.drag_momentum, b.drag_momentum));
}

class DeviceSparseTest : public OnDevice
{
};

TEST_P(DeviceSparseTest, ReadsOnlyTheCellsThatItAskedFor)
{
    TallScene whole(GetParam()), sparse(GetParam());
    int wanted = 0;
    for (int n = 1; n <= steps; ++n)
    {
        SCOPED_TRACE(n);
        coupling::Step const step{n, (n - 1) * dt, dt};
        WaterAt const water(n);
        WaterAt some(n);
        EXPECT_GT(some.spoil_but(sparse.engine->step_cells(true).needed), cells / 3);
        whole.engine->advance(step, water.fields());
        StepReport const report = sparse.engine->advance(step, some.fields(), [&] { return water.fields(); });

        wanted += report.fluid_was_wanted;
        expect_same_bits(*whole.engine, *sparse.engine);
        gimdem::test::expect_same_bits(whole.system, sparse.system);
    }
    EXPECT_GT(wanted, 0) << "the particles never left the needed cells";
    EXPECT_LT(wanted, steps);
}

TEST_P(DeviceSparseTest, AsksForTheCellsThatTheHostAsksFor)
{
    TallScene host(serial), there(GetParam());
    auto const ours = host.engine->step_cells(true).needed, theirs = there.engine->step_cells(true).needed;
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t k = 0; k < ours.size(); ++k)
    {
        EXPECT_EQ(ours[k].fields, theirs[k].fields);
        EXPECT_TRUE(contains(ours[k].cells, theirs[k].cells) && contains(theirs[k].cells, ours[k].cells));
    }
}

GIMDEM_ON_DEVICES(DeviceSparseTest);

}  // namespace
