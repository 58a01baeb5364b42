// SPDX-License-Identifier: BSD-3-Clause
#include "FluidCase.hpp"

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gimdem::test
{

namespace
{

/// Open MPI on this machine alone, as root or not, with more processes than cores.
char const* const mpi =
    "mpirun --allow-run-as-root --oversubscribe --bind-to none --mca plm isolated --mca btl self,vader "
    "--mca btl_vader_single_copy_mechanism none -np ";

std::string text_of(Vector const& v)
{
    std::ostringstream out;
    out.precision(17);
    out << '(' << v[0] << ' ' << v[1] << ' ' << v[2] << ')';
    return out.str();
}

std::string mesh_dictionary(FluidCase const& fluid)
{
    auto const patch = [](std::string const& name, std::string const& type, std::string const& faces)
    { return name + " { type " + type + "; faces (" + faces + "); }\n"; };
    auto const pair = [](std::string const& partner) { return "cyclic; neighbourPatch " + partner; };
    bool const round = fluid.ends == FluidCase::Ends::cyclic;
    bool const wide = fluid.sides == "cyclic";

    std::ostringstream out;
    out << "scale 1;\nvertices (\n";
    for (double z : {0.0, fluid.lengths[2]})
        out << text_of({0, 0, z}) << text_of({fluid.lengths[0], 0, z})
            << text_of({fluid.lengths[0], fluid.lengths[1], z}) << text_of({0, fluid.lengths[1], z}) << '\n';
    out << ");\nblocks (hex (0 1 2 3 4 5 6 7) (" << fluid.cells[0] << ' ' << fluid.cells[1] << ' ' << fluid.cells[2]
        << ") simpleGrading (1 1 1));\nboundary (\n"
        << patch("inlet", round ? pair("outlet") : "patch", "(0 3 2 1)")
        << patch("outlet", round ? pair("inlet") : "patch", "(4 5 6 7)")
        << patch("left", wide ? pair("right") : "wall", "(0 4 7 3)")
        << patch("right", wide ? pair("left") : "wall", "(1 2 6 5)")
        << patch("faces", fluid.cells[1] == 1 ? "empty" : "symmetry", "(0 1 5 4) (3 7 6 2)") << ");\n";
    return out.str();
}

std::string boundary(FluidCase const& fluid, std::string const& inlet, std::string const& outlet,
                     std::string const& sides)
{
    bool const round = fluid.ends == FluidCase::Ends::cyclic;
    std::string const cyclic = "type cyclic;";
    return "boundaryField {\n inlet { " + (round ? cyclic : inlet) + " }\n outlet { " + (round ? cyclic : outlet) +
           " }\n \"left|right\" { " + (fluid.sides == "cyclic" ? cyclic : sides) + " }\n faces { type " +
           (fluid.cells[1] == 1 ? "empty" : "symmetry") + "; }\n}\n";
}

std::string velocity(FluidCase const& fluid)
{
    std::string const superficial = text_of({0, 0, fluid.superficial});
    std::ostringstream out;
    out.precision(17);
    out << "dimensions [0 1 -1 0 0 0 0];\ninternalField ";
    if (fluid.velocity)
    {
        auto const n = static_cast<std::size_t>(fluid.cells[0] * fluid.cells[1] * fluid.cells[2]);
        out << "nonuniform List<vector> " << n << " (\n";
        for (std::size_t c = 0; c < n; ++c)
            out << text_of(fluid.velocity(cell_centre(fluid, c))) << '\n';
        out << ");\n";
    }
    else
        out << "uniform " << superficial << ";\n";
    out << boundary(
        fluid,
        "type interstitialInletVelocity; inletVelocity uniform " + superficial + "; value uniform " + superficial + ";",
        "type zeroGradient;", "type " + fluid.sides + ";");
    return out.str();
}

std::string solution(FluidCase const& fluid)
{
    std::ostringstream out;
    out << "solvers {\n \"p.*\" { solver PCG; preconditioner DIC; tolerance 1e-14; relTol " << fluid.tolerance
        << "; }\n \"U.*\" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-14; relTol "
        << std::min(1e-9, 10 * fluid.tolerance) << "; }\n}\n"
        << "PIMPLE { momentumPredictor " << (fluid.momentum_predictor ? "yes" : "no")
        << "; nOuterCorrectors 1; nCorrectors " << fluid.correctors
        << "; nNonOrthogonalCorrectors 1; pRefCell 0; pRefValue 0; }\ncache { grad(U); }\n";
    return out.str();
}

std::string schemes(FluidCase const& fluid)
{
    return "ddtSchemes { default Euler; }\ngradSchemes { default " + fluid.gradient +
           "; }\n"
           "divSchemes { default none; div(alphaPhi,U) Gauss " +
           fluid.convection +
           "; div((alphaNu*dev2(T(grad(U))))) Gauss linear; }\n"
           "laplacianSchemes { default Gauss linear corrected; }\ninterpolationSchemes { default linear; }\n"
           "snGradSchemes { default corrected; }\n";
}

}  // namespace

Vector cell_centre(FluidCase const& fluid, std::size_t c)
{
    auto const nx = static_cast<std::size_t>(fluid.cells[0]);
    auto const ny = static_cast<std::size_t>(fluid.cells[1]);
    std::array<std::size_t, 3> const at = {c % nx, c / nx % ny, c / nx / ny};
    Vector x;
    for (int d = 0; d < 3; ++d)
        x[d] = (double(at[d]) + 0.5) * fluid.lengths[d] / fluid.cells[d];
    return x;
}

FluidProcess::FluidProcess(FluidCase const& fluid)
    : ranks_(static_cast<int>(fluid.cuts[0] * fluid.cuts[1] * fluid.cuts[2]))
{
    std::string name = (std::filesystem::temp_directory_path() / "gimdem-fluid-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no folder for temporary files");
    folder_ = name;
    for (auto const* part : {"0", "constant", "system"})
        std::filesystem::create_directory(folder_ / part);

    std::ostringstream control;
    control << "application gimdemFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1e9; deltaT "
            << fluid.time_step << "; writeControl timeStep; writeInterval 1000000; writePrecision 12;\n"
            << fluid.control;
    std::ostringstream air;
    air << "rho " << fluid.density << "; mu " << fluid.viscosity << ";\n";

    write("system/blockMeshDict", "dictionary", mesh_dictionary(fluid));
    write("system/controlDict", "dictionary", control.str());
    write("system/fvSchemes", "dictionary", schemes(fluid));
    write("system/fvSolution", "dictionary", solution(fluid));
    write("constant/transportProperties", "dictionary", air.str());
    write("constant/couplingProperties", "dictionary", "timeout 10; connectTime 20;\n");
    write("constant/g", "uniformDimensionedVectorField",
          "dimensions [0 1 -2 0 0 0 0]; value " + text_of(fluid.gravity) + ";\n");
    write("0/U", "volVectorField", velocity(fluid));
    write("0/p", "volScalarField",
          "dimensions [1 -1 -2 0 0 0 0];\ninternalField uniform 0;\n" +
              boundary(fluid, "type fixedFluxPressure; value uniform 0;", "type fixedValue; value uniform 0;",
                       "type fixedFluxPressure; value uniform 0;"));
    run("blockMesh");
    if (ranks_ == 1) return;
    write("system/decomposeParDict", "dictionary",
          "numberOfSubdomains " + std::to_string(ranks_) + "; method simple; simpleCoeffs { n " +
              text_of({fluid.cuts[0], fluid.cuts[1], fluid.cuts[2]}) + "; delta 0.001; }\n");
    run("decomposePar");
}

FluidProcess::~FluidProcess()
{
    if (pid_ > 0)
    {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void FluidProcess::write(std::string const& name, std::string const& kind, std::string const& text) const
{
    std::ofstream out(folder_ / name);
    out << "FoamFile { version 2.0; format ascii; class " << kind << "; object "
        << std::filesystem::path(name).filename().string() << "; }\n"
        << text;
}

void FluidProcess::run(std::string const& command) const
{
    ::setenv("WM_PROJECT_DIR", GIMDEM_OPENFOAM_PROJECT_DIR, 0);
    std::string const log = (folder_ / "log.setup").string();
    if (std::system(("cd " + folder_.string() + " && (" + command + ") > " + log + " 2>&1").c_str()) != 0)
    {
        std::ifstream in(log);
        throw std::runtime_error(command + " failed:\n" + std::string(std::istreambuf_iterator<char>(in), {}));
    }
}

void FluidProcess::start(std::string const& arguments)
{
    pid_ = ::fork();
    if (pid_ != 0) return;
    std::string client = GIMDEM_FOAM " -case " + folder_.string() + " " + arguments;
    if (ranks_ > 1) client = mpi + std::to_string(ranks_) + " " + client + " -parallel";
    std::string const command = "exec " + client + " > " + (folder_ / "log").string() + " 2>&1";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
}

int FluidProcess::wait()
{
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string FluidProcess::log() const
{
    std::ifstream in(folder_ / "log");
    return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace gimdem::test
