// SPDX-License-Identifier: BSD-3-Clause
#include "output/ResultSeries.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "output/OutputFile.hpp"
#include "output/Text.hpp"

namespace gimdem::output
{

namespace
{

/// "cells", 12, ".vtu" -> "cells/cells_000012.vtu"
std::string frame_name(std::string const& kind, std::size_t frame, std::string const& extension)
{
    char number[24];
    std::snprintf(number, sizeof number, "_%06zu", frame);
    return kind + '/' + kind + number + extension;
}

std::string entry(double time, int part, std::string const& name, std::string const& file)
{
    return "    <DataSet timestep=\"" + to_text(time) + "\" part=\"" + std::to_string(part) + "\" name=\"" + name +
           "\" file=\"" + file + "\"/>\n";
}

/// The times of the frames that an index lists [s], empty where there is no index.
std::vector<double> read_times(std::filesystem::path const& index)
{
    std::vector<double> times;
    std::string const key = "timestep=\"";
    std::ifstream in(index);
    for (std::string line; std::getline(in, line);)
        if (auto const at = line.find(key); at != std::string::npos && line.find("part=\"0\"") != std::string::npos)
            times.push_back(std::strtod(line.c_str() + at + key.size(), nullptr));
    return times;
}

}  // namespace

ResultSeries::ResultSeries(std::filesystem::path folder, coupling::Mesh const& mesh)
    : folder_(std::move(folder)), cells_(mesh)
{
    make_folder(folder_ / "cells");
    make_folder(folder_ / "particles");
}

int ResultSeries::resume(double time)
{
    times_ = read_times(index());
    // a frame at the very time of the restart is written again; its time may differ in the last bits
    double const end = time - 1e-9 * std::abs(time);
    std::erase_if(times_, [end](double frame_time) { return frame_time >= end; });
    return frame_count();
}

void ResultSeries::write(double time, ParticleFrame const& particles, std::span<CellField const> fields)
{
    std::size_t const frame = times_.size();
    cells_.write(folder_ / frame_name("cells", frame, ".vtu"), time, fields);
    write_vtk_particles(folder_ / frame_name("particles", frame, ".vtp"), particles);
    times_.push_back(time);
    write_index();
}

void ResultSeries::write_index() const
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
    for (std::size_t frame = 0; frame < times_.size(); ++frame)
    {
        text += entry(times_[frame], 0, "cells", frame_name("cells", frame, ".vtu"));
        text += entry(times_[frame], 1, "particles", frame_name("particles", frame, ".vtp"));
    }
    text += "  </Collection>\n</VTKFile>\n";
    OutputFile out(index());
    out.write(text);
    out.commit();
}

}  // namespace gimdem::output
