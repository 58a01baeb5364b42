// SPDX-License-Identifier: BSD-3-Clause
/// A whole fluid solver in one file, coupled with Client.hpp: the gas in a column of cells, one above the other.
/// column.c and column.py are the same solver in C and in Python.
///
/// Usage: column-cpp <endpoint> <run folder> [folder of keys] [--restart <state>]; the run folder has constant/column.
/// Writes column.csv (a line a step), profile.csv (a line a cell, at the end) and states/, from which it goes on,
/// there.
///
/// Volume-averaged equations of a gas of constant density (theory.md, F.1 and F.2) in one dimension, where friction at
/// the walls and inertia are neglected: with q the superficial velocity and S the force of the particles per volume,
///     d(alpha)/dt + dq/dz = 0,                so  q rises from cell to cell by what the particles displace;
///     0 = -alpha dp/dz + alpha rho g + S,     S = M - K v (C.5),  v = q / alpha.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gimdem/coupling/Client.hpp"

using namespace gimdem::coupling;

namespace
{

double constexpr gravity = -9.81;  ///< along z [m/s^2]

/// constant/column: a name and a number a line; # begins a comment.
std::map<std::string, double> read_settings(std::string const& file_name)
{
    std::ifstream file(file_name);
    if (!file) throw std::runtime_error(file_name + " cannot be read");
    std::map<std::string, double> settings;
    for (std::string line; std::getline(file, line);)
    {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string name;
        if (words >> name) words >> settings[name];
    }
    return settings;
}

/// n cells above each other: level k has the points 4 k .. 4 k + 3, anticlockwise seen from above.
Mesh make_mesh(int n, double width, double depth, double height)
{
    Mesh mesh;
    mesh.cell_count = n;
    mesh.face_offsets.push_back(0);
    auto const add_face = [&](std::int32_t owner, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d)
    {
        mesh.face_points.insert(mesh.face_points.end(), {a, b, c, d});
        mesh.face_offsets.push_back(static_cast<std::int32_t>(mesh.face_points.size()));
        mesh.owner.push_back(owner);
    };
    for (int k = 0; k <= n; ++k)
    {
        double const z = height * k / n;
        mesh.points.insert(mesh.points.end(), {0, 0, z, width, 0, z, width, depth, z, 0, depth, z});
    }
    for (int k = 1; k < n; ++k)
    {
        add_face(k - 1, 4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3);
        mesh.neighbour.push_back(k);
    }
    add_face(0, 0, 3, 2, 1);
    add_face(n - 1, 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3);
    for (int k = 0; k < n; ++k)
        for (int side = 0; side < 4; ++side)
        {
            int const next = (side + 1) % 4;
            add_face(k, 4 * k + side, 4 * k + next, 4 * (k + 1) + next, 4 * (k + 1) + side);
        }
    mesh.patches = {{"inlet", PatchKind::open, n - 1, 1},
                    {"outlet", PatchKind::open, n, 1},
                    {"walls", PatchKind::wall, n + 1, 4 * n}};
    return mesh;
}

MeshView view_of(Mesh const& mesh)
{
    return {mesh.points,    mesh.face_offsets, mesh.face_points, mesh.owner,
            mesh.neighbour, mesh.cell_count,   mesh.patches};
}

/// The gas. A vector field has three numbers a cell, of which only the last, along z, is not 0 here.
struct Column
{
    Column(std::size_t cells, double cell_height, double cross_section, double fluid_density)
        : n(cells),
          h(cell_height),
          area(cross_section),
          density(fluid_density),
          void_fraction(n),
          velocity(3 * n),
          velocity_gradient(9 * n),
          pressure_gradient(3 * n),
          void_fraction_gradient(3 * n),
          pressure(n)
    {
    }

    void start(SolidFields const& solid)
    {
        for (std::size_t k = 0; k < n; ++k)
            void_fraction[k] = solid.void_fraction[k];
    }

    /// Solves for the gas at the end of a step in which that solid holds and gas comes in at that velocity.
    void advance(SolidFields const& solid, double inflow, double dt)
    {
        double flux = inflow;
        applied_force = 0;
        for (std::size_t k = 0; k < n; ++k)
        {
            double const alpha = solid.void_fraction[k];
            double const flux_above = flux - h * (alpha - void_fraction[k]) / dt;
            double const v = 0.5 * (flux + flux_above) / alpha;
            double const source = solid.drag_momentum[3 * k + 2] - solid.drag_coefficient[k] * v;
            velocity[3 * k + 2] = v;
            pressure_gradient[3 * k + 2] = density * gravity + source / alpha;
            applied_force += source * (area * h);
            void_fraction[k] = alpha;
            flux = flux_above;
        }
        outflow = flux;
        integrate_pressure();
        differentiate();
    }

    /// From the outlet, where it is 0, downwards.
    void integrate_pressure()
    {
        double above = 0;
        for (std::size_t k = n; k-- > 0;)
        {
            double const rise = -pressure_gradient[3 * k + 2] * h;
            pressure[k] = above + 0.5 * rise;
            above += rise;
        }
        pressure_drop = above;
    }

    /// Gradients: from the cells on either side, one-sided at the ends.
    void differentiate()
    {
        for (std::size_t k = 0; k < n; ++k)
        {
            std::size_t const below = k == 0 ? k : k - 1;
            std::size_t const above = k + 1 == n ? k : k + 1;
            double const distance = h * static_cast<double>(above - below);
            velocity_gradient[9 * k + 8] = (velocity[3 * above + 2] - velocity[3 * below + 2]) / distance;
            void_fraction_gradient[3 * k + 2] = (void_fraction[above] - void_fraction[below]) / distance;
        }
    }

    /// All that the next step needs, beside what follows from it.
    void write(std::ostream& out) const
    {
        out << "applied_force " << applied_force << '\n';
        for (std::size_t k = 0; k < n; ++k)
            out << void_fraction[k] << ' ' << velocity[3 * k + 2] << ' ' << pressure_gradient[3 * k + 2] << '\n';
    }

    void read(std::istream& in)
    {
        std::string name;
        in >> name >> applied_force;
        for (std::size_t k = 0; k < n; ++k)
            in >> void_fraction[k] >> velocity[3 * k + 2] >> pressure_gradient[3 * k + 2];
        integrate_pressure();
        differentiate();
    }

    FluidFields fields() const
    {
        return {velocity, velocity_gradient, pressure_gradient, void_fraction_gradient, pressure};
    }

    void write_profile(std::string const& file_name) const
    {
        std::ofstream file(file_name);
        file.precision(17);
        file << "height,void_fraction,velocity,pressure\n";
        for (std::size_t k = 0; k < n; ++k)
            file << h * (static_cast<double>(k) + 0.5) << ',' << void_fraction[k] << ',' << velocity[3 * k + 2] << ','
                 << pressure[k] << '\n';
    }

    std::size_t n;
    double h;        ///< height of a cell [m]
    double area;     ///< of the column [m^2]
    double density;  ///< [kg/m^3]
    std::vector<double> void_fraction, velocity, velocity_gradient, pressure_gradient, void_fraction_gradient, pressure;
    double pressure_drop = 0;  ///< from inlet to outlet [Pa]
    double applied_force = 0;  ///< of the particles on the gas, along z [N]
    double outflow = 0;        ///< superficial velocity at the outlet [m/s]
};

/// Where the gas goes on: a text that names the particles' checkpoint, then the resume point, then the column.
struct State
{
    ResumePoint point;
    long steps = 0;  ///< of the gas since the run began
};

/// A file is there once it is whole and on disk.
void write_whole(std::filesystem::path const& file, std::string const& text)
{
    std::filesystem::path const part = file.string() + ".part";
    std::FILE* const out = std::fopen(part.c_str(), "w");
    bool good = out && std::fputs(text.c_str(), out) >= 0 && std::fflush(out) == 0 && ::fsync(::fileno(out)) == 0;
    good = (!out || std::fclose(out) == 0) && good;
    if (!good) throw std::runtime_error(file.string() + " cannot be written");
    std::filesystem::rename(part, file);
}

void write_state(std::string const& folder, SavedCheckpoint const& saved, double time, long steps, Column const& column)
{
    std::ostringstream text;
    text.precision(17);
    text << "checkpoint " << saved.name << "\nsession " << saved.session << "\nstep " << saved.step << "\ntime " << time
         << "\nsteps " << steps << '\n';
    column.write(text);
    text << "end\n";
    std::ostringstream name;
    name << std::setw(9) << std::setfill('0') << steps << ".state";
    std::filesystem::create_directories(folder + "/states");
    write_whole(folder + "/states/" + name.str(), text.str());
}

State read_state(std::string const& file_name, Column& column)
{
    std::ifstream in(file_name);
    State state;
    std::string name, checkpoint, end;
    in >> name >> checkpoint >> name >> state.point.session >> name >> state.point.step >> name >> state.point.time >>
        name >> state.steps;
    column.read(in);
    if (!(in >> end) || end != "end") throw std::runtime_error(file_name + " cannot be read, or is of another column");
    return state;
}

/// column.csv; of a run that goes on in its folder, without the lines behind that time.
std::ofstream open_table(std::string const& file_name, double time)
{
    std::ostringstream kept;
    std::ifstream before(file_name);
    double last = -1;
    for (std::string line; std::getline(before, line);)
    {
        double t = 0;
        if (!(std::istringstream(line) >> t) || t <= last || t > time) continue;
        kept << line << '\n';
        last = t;
    }
    std::ofstream table(file_name);
    table.precision(17);
    table << "time,inflow,outflow,pressure_drop,applied_force\n" << kept.str();
    return table;
}

void run(std::string const& endpoint, std::string const& folder, std::string const& keys, std::string const& restart)
{
    auto const settings = read_settings(folder + "/constant/column");
    int const n = static_cast<int>(settings.at("cells"));
    double const dt = settings.at("time_step");
    Mesh const mesh = make_mesh(n, settings.at("width"), settings.at("depth"), settings.at("height"));
    Column column(static_cast<std::size_t>(n), settings.at("height") / n, settings.at("width") * settings.at("depth"),
                  settings.at("density"));
    auto const inflow_at = [&](double t) { return settings.at("inflow") * std::fmin(1, t / settings.at("ramp_time")); };

    ClientOptions options;
    options.endpoint = endpoint;
    options.name = "column-cpp";
    options.timeout = settings.at("timeout");
    options.keys = keys;
    State begin;
    if (!restart.empty())
    {
        begin = read_state(restart, column);
        options.resume = begin.point;
    }
    Client client(options);
    Welcome const& welcome = client.connect({settings.at("density"), settings.at("viscosity")});
    client.send_mesh(view_of(mesh));
    if (restart.empty())
    {
        column.start(client.solid());
        column.advance(client.solid(), inflow_at(0), dt);
    }

    std::ofstream table = open_table(folder + "/column.csv", begin.point.time);
    long const steps = std::lround(welcome.end_time / dt);
    long const steps_per_state = std::max(1L, std::lround(settings.at("save_interval") / dt));
    std::int64_t complete = begin.point.step;  // the newest checkpoint of which we have a state
    for (long i = begin.steps + 1; i <= steps && !client.stop_request(); ++i)
    {
        SolidFields const& solid = client.begin_step(
            {i - begin.steps, dt * static_cast<double>(i - 1), dt}, column.fields(),
            {{"applied_force_x", 0, "N"}, {"applied_force_y", 0, "N"}, {"applied_force_z", column.applied_force, "N"}});
        double const t = dt * static_cast<double>(i);
        column.advance(solid, inflow_at(t), dt);
        client.end_step();
        table << t << ',' << inflow_at(t) << ',' << column.outflow << ',' << column.pressure_drop << ','
              << column.applied_force << '\n';
        if (!welcome.saves_checkpoints || (i % steps_per_state != 0 && i != steps && !client.stop_request())) continue;
        table.flush();
        SavedCheckpoint const saved = client.save_checkpoint(t, complete);
        write_state(folder, saved, t, i, column);
        complete = saved.step;
    }
    table.close();
    column.write_profile(folder + "/profile.csv");
    client.finish(client.stop_request() ? "stopped as asked" : "end time reached");
}

}  // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> words(argv + 1, argv + argc);
    std::string restart;
    if (words.size() > 2 && words[words.size() - 2] == "--restart")
    {
        restart = words.back();
        words.resize(words.size() - 2);
    }
    if (words.size() != 2 && words.size() != 3)
    {
        std::cerr << "usage: column-cpp <endpoint> <run folder> [folder of keys] [--restart <state>]\n";
        return 2;
    }
    try
    {
        run(words[0], words[1], words.size() == 3 ? words[2] : "", restart);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "column-cpp: " << error.what() << std::endl;
        return 1;
    }
}
