// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseSettings.hpp"

#include "core/CaseTable.hpp"
#include "core/ContactLawNames.hpp"
#include "core/MappingMethodNames.hpp"

namespace gimdem
{

using namespace case_file;

// Columns: key, member, unit, range, example, purpose. The order is that of the documentation.
// clang-format off

Fields<Case> const& settings_of(Case const&)
{
    static Fields<Case> const fields = {
        optional("title",        &Case::title, "", anything(), "\"fluidised bed\"",
                 "one line that says what the case is"),
        required("run",          &Case::run,          "how long to simulate and on which mesh"),
        optional("coupling",     &Case::coupling,     "how the two solvers talk"),
        required("dem",          &Case::dem,          "how the particles move"),
        required("materials",    &Case::materials,    "what particles and walls are made of"),
        required("contacts",     &Case::contacts,     "how two materials touch"),
        required("walls",        &Case::walls,        "what bounds the particles"),
        optional("wall",         &Case::wall,         "a wall beside those of the mesh"),
        optional("domain",       &Case::domain,       "the box of a run without a fluid, and where space repeats itself"),
        optional("insertion",    &Case::insertion,    "which particles there are at the start"),
        optional("inlets",       &Case::inlets,       "particles that come during the run"),
        optional("settle",       &Case::settle,       "particles fall and come to rest before the fluid starts"),
        optional("fluid_forces", &Case::fluid_forces, "what the fluid does to a particle"),
        optional("mapping",      &Case::mapping,      "how particles become fields on the fluid's mesh"),
        optional("output",       &Case::output,       "what is written, and how often"),
    };
    return fields;
}

Fields<RunSettings> const& settings_of(RunSettings const&)
{
    using S = RunSettings;
    static Fields<S> const fields = {
        required("until",  &S::until,  "s", above(0), "1.0", "time to simulate"),
        optional("client", &S::client, "", one_of({"openfoam", "reference", "column-cpp", "column-c", "column-python", "none"}),
                 "\"openfoam\"",
                 "who solves the fluid; none: particles alone"),
        optional("grid",   &S::grid,   "", anything(), "\"B\"", "mesh variant to use, one of grids"),
        optional("grids",  &S::grids,  "", anything(), "[\"A\", \"B\"]", "mesh variants on offer"),
    };
    return fields;
}

Fields<CouplingSettings> const& settings_of(CouplingSettings const&)
{
    using S = CouplingSettings;
    static Fields<S> const fields = {
        optional("schedule",     &S::schedule,     "", one_of({"serial", "overlapped", "iterated"}), "\"serial\"",
                 "serial: one solver waits for the other; overlapped: both compute at once; iterated: serial, and each "
                 "step repeated until fluid and particles agree at its end"),
        optional("endpoint",     &S::endpoint,     "", endpoint(), "\"tcp://127.0.0.1:5570\"",
                 "where the solvers meet; ipc is a private socket file"),
        optional("keys",         &S::keys,         "", anything(), "\"../keys\"",
                 "folder made by ./gimdem keys: encrypts, and lets the endpoint be of any machine"),
        optional("timeout",      &S::timeout,      "s", above(0), "30.0", "a peer silent for this long is dead"),
        optional("connect_time", &S::connect_time, "s", above(0), "120.0",
                 "how long to wait for the fluid solver to appear"),
        optional("grace_time",   &S::grace_time,   "s", at_least(0), "600.0",
                 "how long a client that was lost may take to come back to its last checkpoint; 0: it may not"),
        optional("encodings",    &S::encodings,    "", one_of({"sparse", "dense", "float32", "lz4"}), "[\"sparse\", \"lz4\"]",
                 "how fields travel, where the client can: of cells with particles alone (sparse) or of all (dense), "
                 "rounded, compressed; protocol.md"),
        optional("fluid_steps",  &S::fluid_steps,  "", between(0, 1001), "1",
                 "the solvers meet after so many time steps of the fluid; theory.md (C.13)"),
        optional("tolerance",    &S::tolerance,    "", between(0, 1), "1e-4",
                 "schedule iterated: relative residual at which a step is accepted; theory.md (C.18)"),
        optional("max_passes",   &S::max_passes,   "", between(0, 10001), "20",
                 "schedule iterated: how often a step is computed at most"),
        optional("relaxation",   &S::relaxation,   "", above(0), "0.5",
                 "schedule iterated: factor of the first pass; those that follow have Aitken's"),
        optional("must_converge", &S::must_converge, "", anything(), "false",
                 "schedule iterated: a step that does not converge ends the run, else it is told and accepted"),
    };
    return fields;
}

Fields<DemSettings> const& settings_of(DemSettings const&)
{
    using S = DemSettings;
    static Fields<S> const fields = {
        required("time_step", &S::time_step, "s", above(0), "2.5e-5",
                 "upper bound; a coupling step takes a whole number of equal steps"),
        required("gravity",   &S::gravity,   "m/s^2", anything(), "[0.0, 0.0, -9.81]", "acceleration of free fall"),
        optional("threads",   &S::threads,   "", at_least(0), "0", "threads to use, 0: all cores"),
        optional("backend",   &S::backend,   "", one_of({"serial", "openmp", "cuda"}), "\"openmp\"",
                 "what runs the loops; cuda: a GPU"),
        optional("sorting",   &S::sorting,   "", one_of({"library", "plain"}), "\"library\"",
                 "what scans and sorts on a GPU: CUB, or the kernels of this program"),
        optional("precision", &S::precision, "", one_of({"double", "mixed"}), "\"double\"",
                 "of the laws of contacts between particles; mixed: single, where all else stays double"),
        optional("skin",      &S::skin,      "", fraction(0, 1), "0.3",
                 "of the neighbour list, in units of the smallest radius"),
        optional("contact_law", &S::contact_law, "", one_of(words(force_law_names)), "\"linear\"",
                 "force between surfaces: Hertz-Mindlin, or linear spring and dashpot"),
        optional("rolling_friction", &S::rolling_friction, "", one_of(words(rolling_law_names)), "\"cdt\"",
                 "resistance to rolling: constant torque, or elastic-plastic spring and dashpot"),
        optional("cohesion", &S::cohesion, "", one_of(words(cohesion_law_names)), "\"sjkr\"",
                 "attraction in contact: simplified JKR"),
    };
    return fields;
}

Fields<MaterialSettings> const& settings_of(MaterialSettings const&)
{
    using S = MaterialSettings;
    static Fields<S> const fields = {
        required("name",          &S::name,          "", not_empty(), "\"bead\"",
                 "what contacts, walls and insertion call it"),
        required("density",       &S::density,       "kg/m^3", above(0), "1150.0", "mass per volume of a particle"),
        required("young_modulus", &S::young_modulus, "Pa", above(0), "1.2e5", "stiffness in contact"),
        required("poisson_ratio", &S::poisson_ratio, "", within(0, 0.5), "0.33", "lateral to axial strain"),
    };
    return fields;
}

Fields<ContactSettings> const& settings_of(ContactSettings const&)
{
    using S = ContactSettings;
    static Fields<S> const fields = {
        required("pair",        &S::pair,        "", anything(), "[\"bead\", \"bead\"]",
                 "the two materials that touch"),
        required("restitution", &S::restitution, "", within(0.05, 1), "0.9",
                 "normal speed after over before a collision"),
        required("friction",    &S::friction,    "", at_least(0), "0.3", "Coulomb's coefficient of sliding"),
        optional("limit_damping", &S::limit_damping, "", anything(), "true",
                 "the normal force never attracts; its dashpot is tuned so that the restitution stays"),
        optional("tangential_damping", &S::tangential_damping, "", anything(), "false",
                 "a dashpot beside the tangential spring"),
        optional("normal_stiffness", &S::normal_stiffness, "N/m", above(0), "1000.0",
                 "spring of contact_law linear, needed there"),
        optional("tangential_stiffness_ratio", &S::tangential_stiffness_ratio, "", fraction(0, 1), "0.286",
                 "tangential over normal spring of contact_law linear"),
        optional("rolling_friction", &S::rolling_friction, "", at_least(0), "0.05",
                 "coefficient of rolling friction, needed where [dem] has such a law"),
        optional("rolling_damping", &S::rolling_damping, "", at_least(0), "0.3",
                 "share of critical damping, needed for rolling_friction epsd"),
        optional("cohesion_energy_density", &S::cohesion_energy_density, "J/m^3", at_least(0), "5e4",
                 "attraction per area of contact, needed where [dem] has cohesion"),
    };
    return fields;
}

Fields<WallSettings> const& settings_of(WallSettings const&)
{
    using S = WallSettings;
    static Fields<S> const fields = {
        required("material", &S::material, "", not_empty(), "\"bead\"",
                 "what the wall patches of the mesh are made of"),
        optional("also",     &S::also,     "", anything(), "[\"inlet\"]",
                 "patches that stop particles although the fluid passes"),
    };
    return fields;
}

Fields<DomainSettings> const& settings_of(DomainSettings const&)
{
    using S = DomainSettings;
    static Fields<S> const fields = {
        optional("box",      &S::box,      "m", anything(), "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]",
                 "lower and upper corner; needed"),
        optional("open",     &S::open,     "", anything(), "[\"zmax\"]",
                 "sides through which particles leave, of xmin, xmax, ymin, ymax, zmin, zmax; the others are walls"),
        optional("periodic", &S::periodic, "", anything(), "[true, true, false]",
                 "along x, y, z: what leaves the box on one side comes in on the other; no walls there"),
    };
    return fields;
}

Fields<InsertionSettings> const& settings_of(InsertionSettings const&)
{
    using S = InsertionSettings;
    static Fields<S> const fields = {
        required("material",    &S::material,    "", not_empty(), "\"bead\"", "what the particles are made of"),
        optional("diameter",    &S::diameter,    "m", above(0), "1.545e-3",
                 "of each particle; needed unless the file has a column radius or sizes are given"),
        optional("mass",        &S::mass,        "kg", above(0), "0.039", "of all particles together; or give count"),
        optional("count",       &S::count,       "", at_least(1), "17563", "number of particles; or give mass"),
        optional("arrangement", &S::arrangement, "", one_of({"lattice", "file", "random"}), "\"lattice\"",
                 "lattice: on a cubic lattice in box; file: at the positions in file; random: anywhere in box without "
                 "overlap"),
        optional("box",         &S::box,         "m", anything(), "[[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]",
                 "lower and upper corner of the lattice, or of where random particles are"),
        optional("spacing",     &S::spacing,     "m", above(0), "1.65e-3", "distance of neighbours on the lattice"),
        optional("jitter",      &S::jitter,      "m", at_least(0), "2e-5",
                 "largest random displacement from the lattice along each axis"),
        optional("seed",        &S::seed,        "", at_least(0), "1", "of the random numbers"),
        optional("velocity",    &S::velocity,    "m/s", anything(), "[0.0, 0.0, 0.0]", "at the start"),
        optional("file",        &S::file,        "", anything(), "\"positions.csv\"",
                 "CSV with the header x,y,z[,radius][,vx,vy,vz] in SI units, beside the case file"),
        optional("sizes",       &S::sizes,       "diameters of random particles, instead of one"),
    };
    return fields;
}

Fields<InletSettings> const& settings_of(InletSettings const&)
{
    using S = InletSettings;
    static Fields<S> const fields = {
        required("material",  &S::material,  "", not_empty(), "\"bead\"", "what the particles are made of"),
        optional("diameter",  &S::diameter,  "m", above(0), "1.545e-3", "of each particle; or give sizes"),
        required("mass_rate", &S::mass_rate, "kg/s", above(0), "0.01", "mean rate at which particles come"),
        optional("velocity",  &S::velocity,  "m/s", anything(), "[0.0, 0.0, -1.0]", "with which they come"),
        optional("box",       &S::box,       "m", anything(), "[[0.0, 0.0, 0.4], [0.09, 0.008, 0.41]]",
                 "where they appear: lower and upper corner; or give centre, normal and radius of a disc"),
        optional("centre",    &S::centre,    "m", anything(), "[0.045, 0.004, 0.4]", "of the disc"),
        optional("normal",    &S::normal,    "", anything(), "[0.0, 0.0, 1.0]", "direction across the disc, of any length"),
        optional("radius",    &S::radius,    "m", above(0), "0.003", "of the disc; all of a sphere's equator is in it"),
        optional("start",     &S::start,     "s", at_least(0), "0.0", "time of the first particles"),
        optional("end",       &S::end,       "s", above(0), "1.0", "no particles later"),
        optional("interval",  &S::interval,  "s", above(0), "1e-3", "between two lots of particles"),
        optional("seed",      &S::seed,      "", at_least(0), "1", "of the random numbers"),
        optional("sizes",     &S::sizes,     "diameters, instead of one"),
    };
    return fields;
}

Fields<SizeSettings> const& settings_of(SizeSettings const&)
{
    using S = SizeSettings;
    static Fields<S> const fields = {
        required("distribution",   &S::distribution,   "", one_of({"uniform", "normal", "lognormal", "discrete"}),
                 "\"uniform\"", "by number; discrete: a list with shares of the mass"),
        optional("minimum",        &S::minimum,        "m", above(0), "1e-3", "smallest diameter"),
        optional("maximum",        &S::maximum,        "m", above(0), "2e-3", "largest diameter"),
        optional("mean",           &S::mean,           "m", above(0), "1.5e-3",
                 "of the diameters, normal and lognormal, before they are cut to minimum and maximum"),
        optional("deviation",      &S::deviation,      "m", above(0), "2e-4", "standard deviation, likewise"),
        optional("diameters",      &S::diameters,      "m", above(0), "[1e-3, 2e-3]", "of the discrete sizes"),
        optional("mass_fractions", &S::mass_fractions, "", above(0), "[0.4, 0.6]",
                 "share of each discrete size in the mass; they add up to 1"),
    };
    return fields;
}

Fields<SettleSettings> const& settings_of(SettleSettings const&)
{
    using S = SettleSettings;
    static Fields<S> const fields = {
        required("duration",       &S::duration,       "s", at_least(0), "0.5",
                 "longest time to settle, 0: do not settle"),
        optional("kinetic_energy", &S::kinetic_energy, "J", at_least(0), "1e-9",
                 "settled once the mean kinetic energy per particle is below this"),
    };
    return fields;
}

Fields<FluidForceSettings> const& settings_of(FluidForceSettings const&)
{
    using S = FluidForceSettings;
    static Fields<S> const fields = {
        optional("drag",              &S::drag,              "", one_of({"none", "beetstra"}), "\"beetstra\"",
                 "drag law"),
        optional("pressure_gradient", &S::pressure_gradient, "", anything(), "true",
                 "buoyancy and the like: minus volume times pressure gradient"),
    };
    return fields;
}

Fields<MappingSettings> const& settings_of(MappingSettings const&)
{
    using S = MappingSettings;
    static Fields<S> const fields = {
        optional("method",                &S::method,                "", one_of(words(mapping_method_names)), "\"exact\"",
                 "who gets which part of a particle; theory.md, G, describes the methods"),
        optional("points",                &S::points,                "", at_least(1), "29",
                 "parts that method divided makes of a particle"),
        optional("coefficient",           &S::coefficient,           "", between(0, 2), "0.4",
                 "phi of method gim-fixed"),
        optional("bandwidth",             &S::bandwidth,             "", above(0), "2.0",
                 "b of methods kernel and diffusion, in particle diameters"),
        optional("reuse_distance",        &S::reuse_distance,        "", at_least(0), "0.02",
                 "how far a particle may move, in its diameters, before its weights are computed anew; 0: at every step"),
        optional("void_fraction_minimum", &S::void_fraction_minimum, "", between(0, 1), "0.1",
                 "smaller void fractions are clipped to this and counted"),
    };
    return fields;
}

Fields<PlaneSettings> const& settings_of(PlaneSettings const&)
{
    using S = PlaneSettings;
    static Fields<S> const fields = {
        required("name",   &S::name,   "", not_empty(), "\"45mm\"", "part of the column names in the time series"),
        required("point",  &S::point,  "m", anything(), "[0.0, 0.0, 0.045]", "a point of the plane"),
        required("normal", &S::normal, "", anything(), "[0.0, 0.0, 1.0]", "direction across the plane, of any length"),
    };
    return fields;
}

Fields<OutputSettings> const& settings_of(OutputSettings const&)
{
    using S = OutputSettings;
    static Fields<S> const fields = {
        optional("sample_interval",   &S::sample_interval,   "s", above(0), "1e-3", "between rows of the time series"),
        optional("particle_interval", &S::particle_interval, "s", at_least(0), "1e-2",
                 "between ParaView files, 0: none"),
        optional("checkpoint_interval", &S::checkpoint_interval, "s", at_least(0), "0.1",
                 "between checkpoints, 0: one at the end; with OpenFOAM a multiple of writeInterval"),
        optional("planes",            &S::planes,            "over which pressure and void fraction are averaged"),
        optional("inlet",             &S::inlet,             "", not_empty(), "\"inlet\"",
                 "the pressure drop is taken from this patch"),
        optional("outlet",            &S::outlet,            "", not_empty(), "\"outlet\"",
                 "the pressure drop is taken to this patch"),
    };
    return fields;
}

// clang-format on

}  // namespace gimdem
