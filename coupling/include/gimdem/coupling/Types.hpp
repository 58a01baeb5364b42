// SPDX-License-Identifier: BSD-3-Clause
/// Plain data that crosses the coupling border. SI units everywhere; arrays are flat and row-major.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gimdem/coupling/Span.hpp"

namespace gimdem::coupling
{

/// Version of the protocol, docs/protocol.md: peers must agree on the major number.
inline constexpr int protocol_major = 1;
inline constexpr int protocol_minor = 1;

/// Which time level each solver sees within one coupling step, docs/theory.md section C.
enum class Schedule
{
    serial,      ///< the fluid step t -> t + dt uses the particles at t + dt: one solver waits for the other
    overlapped,  ///< both solvers compute t -> t + dt at the same time, each on what the other sent last
    iterated     ///< serial, and the step is repeated in the fluid at t + dt until that stands still
};

/// As case files write it.
inline char const* name_of(Schedule schedule)
{
    switch (schedule)
    {
        case Schedule::overlapped:
            return "overlapped";
        case Schedule::iterated:
            return "iterated";
        default:
            return "serial";
    }
}

/// How the schedule `iterated` repeats a step, docs/theory.md (C.15)-(C.18).
struct Iteration
{
    double tolerance = 1e-4;     ///< relative residual at which a step is accepted [1]
    int max_passes = 20;         ///< of a step; 1 is the schedule serial
    double relaxation = 0.5;     ///< factor of the first pass [1]
    bool must_converge = false;  ///< else a step that did not is accepted as it is
};

/// What a boundary patch of the mesh is to the particles.
enum class PatchKind
{
    wall,      ///< solid: particles bounce
    open,      ///< inlet, outlet: fluid passes
    symmetry,  ///< plane of symmetry
    empty,     ///< the absent third dimension of a flat case
    cyclic,    ///< periodic partner of another patch
    processor  ///< shared with another rank of the same client
};

/// One boundary patch: a contiguous run of boundary faces.
struct Patch
{
    std::string name;
    PatchKind kind = PatchKind::wall;
    std::int32_t start_face = 0;  ///< first face of the patch, >= number of internal faces
    std::int32_t face_count = 0;
    std::int32_t neighbour_rank = 0;  ///< of a processor patch: the rank that has the cells behind it
};

/// Which of the processes that solve the fluid together (MPI) this is; the default is one process alone.
struct Rank
{
    std::int32_t number = 0;  ///< 0, 1, ..., count - 1
    std::int32_t count = 1;   ///< at most max_ranks
    std::uint64_t run = 0;    ///< where count > 1: a random number, not 0, that rank 0 tells the others
};

/// Each rank costs the server a thread and some fifteen open files, of the 1024 that systems usually allow.
inline constexpr std::int32_t max_ranks = 32;

/// A polyhedral mesh by reference, in the owner/neighbour addressing of OpenFOAM.
///
/// Internal faces come first; the normal of a face (right-hand rule over its points) leaves its owner.
struct MeshView
{
    Span<double const> points;              ///< shape=(n_points, 3) [m]
    Span<std::int32_t const> face_offsets;  ///< shape=(n_faces + 1,): face f has points [offset f, offset f+1)
    Span<std::int32_t const> face_points;   ///< shape=(face_offsets.back(),): point numbers
    Span<std::int32_t const> owner;         ///< shape=(n_faces,): cell numbers
    Span<std::int32_t const> neighbour;     ///< shape=(n_internal_faces,): cell numbers
    std::int32_t cell_count = 0;
    std::vector<Patch> patches;
};

/// The same mesh, owned: what the server receives.
struct Mesh
{
    std::vector<double> points;
    std::vector<std::int32_t> face_offsets;
    std::vector<std::int32_t> face_points;
    std::vector<std::int32_t> owner;
    std::vector<std::int32_t> neighbour;
    std::int32_t cell_count = 0;
    std::vector<Patch> patches;
};

/// Constant properties of the fluid.
struct FluidProperties
{
    double density = 0;    ///< [kg/m^3]
    double viscosity = 0;  ///< dynamic [Pa s]
};

/// Names on the wire of the fields that can travel. A scene names those that it needs; no other is sent.
namespace field
{
// client -> server, at the time t where the step begins
inline constexpr char const* velocity = "velocity";                              ///< (n_cells, 3) [m/s]
inline constexpr char const* velocity_gradient = "velocity_gradient";            ///< (n_cells, 3, 3) [1/s]
inline constexpr char const* pressure_gradient = "pressure_gradient";            ///< (n_cells, 3) [Pa/m]
inline constexpr char const* void_fraction_gradient = "void_fraction_gradient";  ///< (n_cells, 3) [1/m]
inline constexpr char const* pressure = "pressure";                              ///< (n_cells,) [Pa]
// server -> client
inline constexpr char const* void_fraction = "void_fraction";        ///< (n_cells,) [1]
inline constexpr char const* momentum_source = "momentum_source";    ///< S: (n_cells, 3) [N/m^3]
inline constexpr char const* drag_coefficient = "drag_coefficient";  ///< K: (n_cells,) [kg/(m^3 s)]
inline constexpr char const* drag_momentum = "drag_momentum";        ///< K u_p = S + K v: (n_cells, 3) [N/m^3]
}  // namespace field

/// The fluid at the beginning of a coupling step. Component [3*i + j] of a gradient of a vector is
/// d(component j)/d(x_i), OpenFOAM's order. A field that the scene does not need may be left empty.
struct FluidFields
{
    Span<double const> velocity;                ///< (n_cells, 3) [m/s]
    Span<double const> velocity_gradient;       ///< (n_cells, 9) [1/s]
    Span<double const> pressure_gradient;       ///< (n_cells, 3) [Pa/m]
    Span<double const> void_fraction_gradient;  ///< (n_cells, 3) [1/m]
    Span<double const> pressure;                ///< (n_cells,) [Pa], relative to any fixed reference
};

/// What the particles do to the fluid over one coupling step. Empty where the client did not ask for it.
///
/// The force per volume on the fluid at velocity v is  S = drag_momentum - drag_coefficient * v;
/// momentum_source is the same S at the velocity that the client sent (theory.md, C.5-C.7).
struct SolidFields
{
    Span<double const> void_fraction;     ///< (n_cells,) [1], in (0, 1]
    Span<double const> momentum_source;   ///< (n_cells, 3) [N/m^3]
    Span<double const> drag_coefficient;  ///< (n_cells,) [kg/(m^3 s)]
    Span<double const> drag_momentum;     ///< (n_cells, 3) [N/m^3]
};

/// One coupling step, t -> t + dt.
struct Step
{
    std::int64_t number = 0;  ///< 1, 2, ...; 0 is the initial state
    double time = 0;          ///< t, where the step begins [s]
    double dt = 0;            ///< [s]
};

/// A named number that a peer tells about its last step, for logs and progress: e.g. {"courant_max", 0.4, "1"}.
struct Monitor
{
    std::string name;
    double value = 0;
    std::string unit;
};

/// Where a peer spent the wall time of a step.
struct Timings
{
    double compute = 0;  ///< solving [s]
    double mapping = 0;  ///< particles to cells, server only [s]
    double output = 0;   ///< writing files [s]
};

}  // namespace gimdem::coupling
