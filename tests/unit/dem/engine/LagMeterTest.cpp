// SPDX-License-Identifier: BSD-3-Clause
#include "engine/LagMeter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "BoxMesh.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

// Sums of a few numbers of order one.
constexpr double rounding = 1e-14;

/// Two cells, the upper three times as large: 1 and 3 m^3.
PolyMesh two_cells()
{
    coupling::Mesh mesh = BoxMesh::make({1, 1, 2}, {1, 1, 4});
    for (std::size_t p = 4; p < 8; ++p)
        mesh.points[3 * p + 2] = 1;
    return PolyMesh(std::move(mesh));
}

struct Solid
{
    std::vector<double> void_fraction, coefficient, momentum;

    coupling::SolidFields fields() const
    {
        coupling::SolidFields fields;
        fields.void_fraction = void_fraction;
        fields.drag_coefficient = coefficient;
        fields.drag_momentum = momentum;
        return fields;
    }
};

TEST(LagMeter, IsTheChangeOfTheForceAtTheSameVelocityOverTheForce)
{
    PolyMesh const mesh = two_cells();
    LagMeter meter(mesh);
    std::vector<double> const still(6, 0.0), velocity{1, 0, 0, 0, 2, 0};
    Solid const before{{0.5, 0.7}, {10, 20}, {12, 0, 0, 0, 46, 0}};
    Solid const now{{0.6, 0.7}, {11, 20}, {16, 0, 0, 0, 43, 0}};

    LagError const first = meter.measure(before.fields(), still);
    LagError const second = meter.measure(now.fields(), velocity);

    EXPECT_EQ(first.force, 0);
    EXPECT_EQ(first.solid_fraction, 0);
    // M - K v: 12 - 10 = 2 became 16 - 11 = 5 in the cell of 1 m^3, 46 - 40 = 6 became 43 - 40 = 3 in that of 3 m^3.
    EXPECT_NEAR(second.force, std::sqrt((1 * 9.0 + 3 * 9) / (1 * 25.0 + 3 * 9)), rounding);
    EXPECT_NEAR(second.solid_fraction, std::sqrt(0.01 / (0.16 + 3 * 0.09)), rounding);
}

TEST(LagMeter, IsZeroWhereNothingChangesAndWhereNothingIs)
{
    PolyMesh const mesh = two_cells();
    Solid const solid{{0.5, 0.7}, {10, 20}, {12, 1, 2, 3, 46, 4}}, none{{1, 1}, {0, 0}, {0, 0, 0, 0, 0, 0}};
    for (Solid const& same : {solid, none})
    {
        LagMeter meter(mesh);
        meter.measure(same.fields(), {});
        LagError const lag = meter.measure(same.fields(), {});
        EXPECT_EQ(lag.force, 0);
        EXPECT_EQ(lag.solid_fraction, 0);
    }
}

}  // namespace
