// SPDX-License-Identifier: BSD-3-Clause
#include "output/VtkParticles.hpp"

#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "output/VtkXml.hpp"

namespace gimdem::output
{

namespace
{

void check_size(char const* name, std::size_t size, std::size_t expected)
{
    if (size != 0 && size != expected)
        throw std::invalid_argument(std::string("particle array ") + name + " has " + std::to_string(size) +
                                    " values instead of " + std::to_string(expected));
}

void check_sizes(ParticleFrame const& frame)
{
    std::size_t const n = frame.position.size() / 3;
    check_size("position", frame.position.size(), 3 * n);
    check_size("radius", frame.radius.size(), n);
    check_size("velocity", frame.velocity.size(), 3 * n);
    check_size("angular_velocity", frame.angular_velocity.size(), 3 * n);
    check_size("id", frame.id.size(), n);
}

}  // namespace

void write_vtk_particles(std::filesystem::path const& file, ParticleFrame const& frame)
{
    check_sizes(frame);
    std::size_t const n = frame.position.size() / 3;

    // one vertex per point, or ParaView shows nothing
    std::vector<std::int64_t> connectivity(n);
    std::vector<std::int64_t> offsets(n);
    std::iota(connectivity.begin(), connectivity.end(), std::int64_t{0});
    std::iota(offsets.begin(), offsets.end(), std::int64_t{1});

    std::vector<VtkArray> data;
    if (!frame.radius.empty()) data.push_back(vtk_reals("radius", frame.radius));
    if (!frame.velocity.empty()) data.push_back(vtk_reals("velocity", frame.velocity, 3));
    if (!frame.angular_velocity.empty()) data.push_back(vtk_reals("angular_velocity", frame.angular_velocity, 3));
    if (!frame.id.empty()) data.push_back(vtk_integers("id", frame.id));
    VtkArray const time = vtk_time(frame.time);
    VtkArray const points = vtk_reals("Points", frame.position, 3);
    VtkArray const vertices = vtk_integers("connectivity", connectivity);
    VtkArray const vertex_ends = vtk_integers("offsets", offsets);

    std::string const count = '"' + std::to_string(n) + '"';
    VtkDocument document("PolyData");
    document.open("FieldData").add(time).close();
    document.open("Piece", "NumberOfPoints=" + count + " NumberOfVerts=" + count);
    document.open("PointData");
    for (auto const& array : data)
        document.add(array);
    document.close();
    document.open("Points").add(points).close();
    document.open("Verts").add(vertices).add(vertex_ends).close();
    document.write(file);
}

}  // namespace gimdem::output
