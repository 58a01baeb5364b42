// SPDX-License-Identifier: BSD-3-Clause
/// A small OpenFOAM case in a folder of its own, and the process that solves it.
#pragma once

#include <sys/types.h>
#include <array>
#include <filesystem>
#include <functional>
#include <string>

namespace gimdem::test
{

using Vector = std::array<double, 3>;

/// A box of hexahedra; the fluid flows along z.
struct FluidCase
{
    enum class Ends
    {
        open,   ///< gas enters at z = 0 with `superficial` and leaves at the top
        cyclic  ///< what leaves at the top enters at the bottom
    };

    Vector lengths = {0.01, 0.01, 0.1};  ///< [m]
    std::array<int, 3> cells = {1, 1, 20};
    Ends ends = Ends::open;
    std::string sides = "slip";      ///< boundary condition of U on the sides in x; "cyclic" is one
    double superficial = 0.9;        ///< [m/s]
    double density = 1.28;           ///< [kg/m^3]
    double viscosity = 1.7e-5;       ///< [Pa s]
    Vector gravity = {0, 0, -9.81};  ///< [m/s^2]
    double time_step = 1e-4;         ///< [s]
    double end_time = 0.01;          ///< [s]
    bool momentum_predictor = false;
    int correctors = 1;
    std::string convection = "limitedLinearV 1";
    std::string gradient = "Gauss linear";
    double tolerance = 1e-10;  ///< of the pressure, relative; of the velocity ten times that, 1e-9 at most
    std::string control;       ///< more of controlDict
    int fluid_steps = 1;       ///< of a coupling step
    bool overlapped = false;
    Vector cuts = {1, 1, 1};                 ///< parts along x, y and z, each solved by a process of its own
    std::function<Vector(Vector)> velocity;  ///< at t = 0, of a cell's centre; empty: superficial
};

/// Centre of cell c of the box.
Vector cell_centre(FluidCase const& fluid, std::size_t c);

/// The case's files and the solver's process. The folder goes with the object.
class FluidProcess
{
public:
    /// Writes the dictionaries and runs blockMesh; decomposePar too for several ranks.
    explicit FluidProcess(FluidCase const& fluid);
    ~FluidProcess();
    FluidProcess(FluidProcess const&) = delete;
    FluidProcess& operator=(FluidProcess const&) = delete;

    std::filesystem::path const& folder() const { return folder_; }

    /// Runs another OpenFOAM program in the folder and waits. @post it returned 0, or an exception.
    void run(std::string const& command) const;

    /// Starts gimdemFoam.
    void start(std::string const& arguments);

    /// Waits for its end and returns the exit code.
    int wait();

    /// Of gimdemFoam, or of mpirun.
    pid_t pid() const { return pid_; }
    std::string log() const;

private:
    void write(std::string const& name, std::string const& kind, std::string const& text) const;

    std::filesystem::path folder_;
    int ranks_;
    pid_t pid_ = -1;
};

}  // namespace gimdem::test
