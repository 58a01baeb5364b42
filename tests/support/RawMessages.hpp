// SPDX-License-Identifier: BSD-3-Clause
/// Messages as docs/protocol.md describes them, written by hand: what a foreign client or server would send.
#pragma once

#include <string>
#include <vector>

#include "RawPeer.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// Long enough that the peer does not take a raw peer, which has no heartbeat, for dead.
inline constexpr double raw_timeout = 20;  ///< [s]

inline RawMessage raw_hello()
{
    RawMessage message;
    v1::Hello& hello = *message.envelope.mutable_hello();
    hello.set_name("raw client");
    hello.set_density(1.2);
    hello.set_viscosity(1.8e-5);
    hello.add_wants("void_fraction");
    hello.set_timeout(raw_timeout);
    return message;
}

inline RawMessage raw_welcome()
{
    RawMessage message;
    message.envelope.set_session(77);
    v1::Welcome& welcome = *message.envelope.mutable_welcome();
    welcome.set_server("raw server");
    welcome.set_title("a test");
    welcome.set_schedule(v1::SCHEDULE_SERIAL);
    welcome.set_end_time(1);
    welcome.add_needs("velocity");
    return message;
}

inline RawMessage raw_mesh(coupling::Mesh const& mesh)
{
    RawMessage message;
    v1::Mesh& body = *message.envelope.mutable_mesh();
    body.set_cell_count(mesh.cell_count);
    for (coupling::Patch const& patch : mesh.patches)
    {
        v1::Patch& entry = *body.add_patches();
        entry.set_name(patch.name);
        entry.set_kind(patch.kind == coupling::PatchKind::open ? v1::PATCH_KIND_OPEN : v1::PATCH_KIND_WALL);
        entry.set_start_face(patch.start_face);
        entry.set_face_count(patch.face_count);
    }
    message.add("points", v1::ELEMENT_TYPE_F64, 3, mesh.points);
    message.add("face_offsets", v1::ELEMENT_TYPE_I32, 1, mesh.face_offsets);
    message.add("face_points", v1::ELEMENT_TYPE_I32, 1, mesh.face_points);
    message.add("owner", v1::ELEMENT_TYPE_I32, 1, mesh.owner);
    message.add("neighbour", v1::ELEMENT_TYPE_I32, 1, mesh.neighbour);
    return message;
}

inline RawMessage raw_mesh_accepted(int cell_count)
{
    RawMessage message;
    message.envelope.mutable_mesh_accepted()->set_cell_count(cell_count);
    return message;
}

/// With zero for every number of the fields; needs: names and components of the fluid fields.
inline RawMessage raw_fluid(int number, double time, double dt, int cell_count,
                            std::vector<std::pair<std::string, unsigned>> const& needs = {{"velocity", 3}})
{
    RawMessage message;
    message.envelope.set_step(number);
    v1::FluidState& fluid = *message.envelope.mutable_fluid_state();
    fluid.mutable_step()->set_number(number);
    fluid.mutable_step()->set_time(time);
    fluid.mutable_step()->set_dt(dt);
    for (auto const& [name, components] : needs)
        message.add(name, v1::ELEMENT_TYPE_F64, components,
                    std::vector<double>(components * static_cast<std::size_t>(cell_count)));
    return message;
}

/// Every cell full of fluid, and no drag: the fields that a client wants by default.
inline RawMessage raw_solid(int number, int cell_count)
{
    auto const cells = static_cast<std::size_t>(cell_count);
    RawMessage message;
    message.envelope.set_step(number);
    message.envelope.mutable_solid_state();
    message.add("void_fraction", v1::ELEMENT_TYPE_F64, 1, std::vector<double>(cells, 1.0));
    message.add("drag_coefficient", v1::ELEMENT_TYPE_F64, 1, std::vector<double>(cells));
    message.add("drag_momentum", v1::ELEMENT_TYPE_F64, 3, std::vector<double>(3 * cells));
    return message;
}

inline RawMessage raw_error(std::string const& reason)
{
    RawMessage message;
    v1::Error& error = *message.envelope.mutable_error();
    error.set_fault(v1::FAULT_KIND_USER);
    error.set_reason(reason);
    error.set_state("raw");
    error.set_name("raw peer");
    return message;
}

inline RawMessage raw_heartbeat()
{
    RawMessage message;
    v1::Heartbeat& heartbeat = *message.envelope.mutable_heartbeat();
    heartbeat.set_name("raw peer");
    heartbeat.set_state("raw");
    heartbeat.set_timeout(raw_timeout);
    return message;
}

inline RawMessage raw_checkpoint()
{
    RawMessage message;
    message.envelope.mutable_checkpoint()->set_time(1e-3);
    return message;
}

inline RawMessage raw_checkpoint_saved()
{
    RawMessage message;
    v1::CheckpointSaved& saved = *message.envelope.mutable_checkpoint_saved();
    saved.set_step(1);
    saved.set_time(1e-3);
    saved.set_name("step_000000001_at_0.001.h5");
    return message;
}

inline RawMessage raw_goodbye()
{
    RawMessage message;
    message.envelope.mutable_goodbye()->set_reason("the raw client is done");
    return message;
}

}  // namespace gimdem::test
