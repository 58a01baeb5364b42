// SPDX-License-Identifier: BSD-3-Clause
/// write_series FOLDER: a time series of particles whose values test_vtp.py can compute, too.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "output/ResultSeries.hpp"

namespace
{

/// The unit cube as one cell.
gimdem::coupling::Mesh cube()
{
    gimdem::coupling::Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.insert(mesh.points.end(), {double(i & 1), double((i >> 1) & 1), double((i >> 2) & 1)});
    mesh.face_points = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    mesh.face_offsets = {0, 4, 8, 12, 16, 20, 24};
    mesh.owner.assign(6, 0);
    mesh.cell_count = 1;
    return mesh;
}

}  // namespace

int main(int, char** arguments)
{
    std::int64_t const n = 20000;  // several compressed blocks
    gimdem::output::ResultSeries series(arguments[1], cube());
    for (int frame = 0; frame < 3; ++frame)
    {
        std::vector<double> position, radius, velocity;
        std::vector<std::int64_t> id;
        for (std::int64_t i = 0; i < n; ++i)
        {
            double const x = static_cast<double>(i);
            position.insert(position.end(), {0.5 * x, x + frame, -x});
            radius.push_back(0.25 * x);
            velocity.insert(velocity.end(), {x, 2 * x, static_cast<double>(frame)});
            id.push_back(n - i);
        }
        series.write(0.5 * frame, {0.5 * frame, position, radius, velocity, {}, id}, {});
    }
}
