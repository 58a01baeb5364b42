// SPDX-License-Identifier: BSD-3-Clause
/// The case file as data: what case.toml says, checked, with defaults filled in. SI units.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gimdem
{

using Triple = std::array<double, 3>;

/// [run]
struct RunSettings
{
    double until = 0;                 ///< simulated time [s]
    std::string client = "openfoam";  ///< who solves the fluid; none: particles alone
    std::string grid;                 ///< chosen mesh variant, empty where the case has one mesh
    std::vector<std::string> grids;   ///< mesh variants on offer
};

/// [coupling]
struct CouplingSettings
{
    std::string schedule = "serial";               ///< serial | overlapped | iterated
    std::string endpoint = "ipc";                  ///< ipc | ipc:///path | tcp://127.0.0.1:port
    std::filesystem::path keys;                    ///< folder; empty: none
    double timeout = 30;                           ///< a peer silent for this long is dead [s]
    double connect_time = 120;                     ///< wait for the client to appear [s]
    double grace_time = 0;                         ///< a client that was lost may come back within it [s]
    std::vector<std::string> encodings{"sparse"};  ///< how fields travel, where the client can
    std::int64_t fluid_steps = 1;                  ///< equal fluid steps of a coupling step
    double tolerance = 1e-4;                       ///< of schedule iterated: relative residual of a step
    std::int64_t max_passes = 20;                  ///< of a step of schedule iterated
    double relaxation = 0.5;                       ///< factor of the first pass
    bool must_converge = false;                    ///< a step that did not ends the run
};

/// [dem]
struct DemSettings
{
    double time_step = 0;                       ///< upper bound [s]
    Triple gravity{0, 0, 0};                    ///< [m/s^2]
    int threads = 0;                            ///< 0: all cores
    std::string backend = "openmp";             ///< serial | openmp | cuda
    std::string sorting = "library";            ///< library | plain: who scans and sorts on a GPU
    std::string precision = "double";           ///< double | mixed: of the contact laws between particles
    double skin = 0.3;                          ///< of the neighbour list, in units of the smallest radius [1]
    std::string contact_law = "hertz-mindlin";  ///< one of force_law_names
    std::string rolling_friction = "none";      ///< one of rolling_law_names
    std::string cohesion = "none";              ///< one of cohesion_law_names
};

/// [[materials]]
struct MaterialSettings
{
    std::string name;
    double density = 0;        ///< [kg/m^3]
    double young_modulus = 0;  ///< [Pa]
    double poisson_ratio = 0;  ///< in [0, 0.5]
};

/// [[contacts]]: one for every pair of materials that can touch
struct ContactSettings
{
    std::array<std::string, 2> pair;
    double restitution = 1;          ///< normal, in [0.05, 1]
    double friction = 0;             ///< Coulomb coefficient of sliding
    bool limit_damping = false;      ///< the dashpot never pulls; it is tuned so that the restitution stays
    bool tangential_damping = true;  ///< whether the tangential spring has a dashpot beside it

    // Only where the laws chosen in [dem] need them; check_contact_laws sees to it that they are given.
    double normal_stiffness = 0;                  ///< k_n of the linear law [N/m]
    double tangential_stiffness_ratio = 2.0 / 7;  ///< k_t / k_n of the linear law
    double rolling_friction = 0;                  ///< mu_r
    double rolling_damping = 0;                   ///< eta_r of EPSD, share of critical
    double cohesion_energy_density = 0;           ///< [J/m^3]
};

/// [walls]
struct WallSettings
{
    std::string material;
    std::vector<std::string> also;  ///< patches that stop particles although the fluid passes
};

/// [wall.rotation]: turns about an axis through origin
struct WallRotationSettings
{
    Triple axis{};     ///< direction, of any length
    Triple origin{};   ///< a point of the axis [m]
    double speed = 0;  ///< right-handed about axis [rad/s]
};

/// [wall.vibration]: displacement amplitude * direction * sin(2 pi frequency t + phase)
struct WallVibrationSettings
{
    Triple direction{};    ///< of any length
    double amplitude = 0;  ///< [m]
    double frequency = 0;  ///< [Hz]
    double phase = 0;      ///< [rad]
};

/// [[wall]]: one beside those of the client's mesh
struct WallItemSettings
{
    std::string name;
    std::string shape = "plane";  ///< plane | cylinder | stl
    std::string material;         ///< empty: that of [walls]
    Triple point{};               ///< of a plane; on a cylinder's axis, where it begins if it has a length [m]
    Triple normal{};              ///< plane: towards the particles, of any length
    Triple axis{};                ///< cylinder: direction, of any length
    double radius = 0;            ///< cylinder [m]
    double length = 0;            ///< cylinder [m]; 0: infinite
    bool inside = false;          ///< particles are inside the cylinder or the closed surface
    std::filesystem::path file;   ///< stl; relative to the case file, here absolute
    double scale = 1;             ///< stl: metres per unit of the file
    bool open = false;            ///< stl: a sheet with rims, touched from both sides
    Triple velocity{0, 0, 0};     ///< [m/s]
    std::optional<WallRotationSettings> rotation;
    std::optional<WallVibrationSettings> vibration;
};

/// [domain]: the box of a run without a fluid, and so without a mesh; and where space repeats itself
struct DomainSettings
{
    std::array<Triple, 2> box{};                        ///< corners [m]
    std::vector<std::string> open;                      ///< sides through which particles leave: xmin, xmax, ymin, ...
    std::array<bool, 3> periodic{false, false, false};  ///< along x, y, z. Sides neither open nor periodic are walls
};

/// [insertion.sizes], [inlets.sizes]: how diameters are distributed, by number, theory.md (D.60)-(D.63)
struct SizeSettings
{
    std::string distribution;            ///< uniform | normal | lognormal | discrete
    double minimum = 0;                  ///< [m]
    double maximum = 0;                  ///< [m]
    double mean = 0;                     ///< before truncation [m]
    double deviation = 0;                ///< before truncation [m]
    std::vector<double> diameters;       ///< discrete [m]
    std::vector<double> mass_fractions;  ///< discrete [1]
};

/// [[insertion]]
struct InsertionSettings
{
    std::string material;
    double diameter = 0;                  ///< [m]; for "file" a default where the file has no radius column
    double mass = 0;                      ///< total [kg], 0: not given
    std::int64_t count = 0;               ///< 0: not given
    std::string arrangement = "lattice";  ///< lattice | file | random
    std::array<Triple, 2> box{};          ///< lattice, random: corners [m]
    double spacing = 0;                   ///< lattice: distance of neighbours [m]
    double jitter = 0;                    ///< lattice: largest random displacement per axis [m]
    std::uint64_t seed = 1;
    Triple velocity{0, 0, 0};  ///< [m/s]
    /// file: CSV with the header x,y,z[,radius][,vx,vy,vz] [m, m/s]; relative to the case file, here absolute
    std::filesystem::path file;
    std::optional<SizeSettings> sizes{};  ///< random: instead of one diameter
};

/// [[inlets]]: particles that come during the run
struct InletSettings
{
    std::string material;
    double diameter = 0;          ///< [m]; or sizes
    double mass_rate = 0;         ///< [kg/s]
    Triple velocity{0, 0, 0};     ///< [m/s]
    std::array<Triple, 2> box{};  ///< region: a box [m] ...
    Triple centre{0, 0, 0};       ///< ... or a disc: its centre [m],
    Triple normal{0, 0, 0};       ///< the direction across it, of any length,
    double radius = 0;            ///< and its radius [m]; 0: box
    double start = 0;             ///< [s]
    double end = 0;               ///< [s]; 0: never
    double interval = 1e-3;       ///< at most, between two lots of particles [s]
    std::uint64_t seed = 1;
    std::optional<SizeSettings> sizes{};
};

/// [settle]
struct SettleSettings
{
    double duration = 0;        ///< at most [s]; 0: do not settle
    double kinetic_energy = 0;  ///< stop below this mean kinetic energy per particle [J]
};

/// [fluid_forces]
struct FluidForceSettings
{
    std::string drag = "beetstra";  ///< none | beetstra
    bool pressure_gradient = true;
};

/// [mapping]
struct MappingSettings
{
    std::string method = "gim";          ///< one of mapping_method_names
    std::int64_t points = 29;            ///< of method divided
    double coefficient = 0.4;            ///< phi of method gim-fixed
    double bandwidth = 2;                ///< b of methods kernel and diffusion, in particle diameters
    double reuse_distance = 0;           ///< how far weights serve, in particle diameters; 0: not at all
    double void_fraction_minimum = 0.1;  ///< smaller values are clipped and counted
};

/// A plane over which quantities are averaged.
struct PlaneSettings
{
    std::string name;
    Triple point{};
    Triple normal{};
};

/// [output]
struct OutputSettings
{
    double sample_interval = 1e-3;    ///< of the time series [s]
    double particle_interval = 1e-2;  ///< of the ParaView files [s]; 0: none
    double checkpoint_interval = 0;   ///< of the checkpoints [s]; 0: none
    std::vector<PlaneSettings> planes;
    std::string inlet;  ///< patches between which the pressure drop is taken
    std::string outlet;
};

/// A whole case.
struct Case
{
    std::filesystem::path file;  ///< case.toml
    std::string title;
    std::string identity;  ///< the settings that decide how the particles move, as text: for checkpoints
    RunSettings run;
    CouplingSettings coupling;
    DemSettings dem;
    std::vector<MaterialSettings> materials;
    std::vector<ContactSettings> contacts;
    WallSettings walls;
    std::vector<WallItemSettings> wall;
    DomainSettings domain;
    std::vector<InsertionSettings> insertion;
    std::vector<InletSettings> inlets;
    std::optional<SettleSettings> settle;
    FluidForceSettings fluid_forces;
    MappingSettings mapping;
    OutputSettings output;
};

/// Read and check a case file.
///
/// Throws UserError naming the key, the file, the line and, for an unknown key, the nearest known one; for a value out
/// of range the allowed range; for a missing key what it is for.
Case read_case(std::filesystem::path const& file);

/// The same from text, for tests; `file` is only what messages call it.
Case parse_case(std::string const& text, std::filesystem::path const& file);

/// All settings with unit, range, default and purpose, as Markdown for the user guide.
std::string settings_as_markdown();

}  // namespace gimdem
