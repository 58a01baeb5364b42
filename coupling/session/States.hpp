// SPDX-License-Identifier: BSD-3-Clause
/// The state machine of both sides, as tables. docs/protocol.md prints the same tables.
#pragma once

#include <optional>
#include <string>

#include "gimdem/coupling/Span.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::session
{

/// Where a session is. The comment tells the side, and what it waits for.
enum class State
{
    created,      ///< client: its program has not called connect()
    greeting,     ///< client: for Welcome
    listening,    ///< server: for Hello
    welcomed,     ///< both: for the mesh, of the client's program or of the client
    meshing,      ///< client: for MeshAccepted; server: for its program's judgement of the mesh
    accepted,     ///< client: for the solid at t = 0
    ready,        ///< both: for the next fluid, of the client's program or of the client
    waiting,      ///< client, serial: for the solid of this step, while its program is blocked
    solving,      ///< client, serial: for its program to end the fluid step
    overlapping,  ///< client, overlapped: for its program to end the fluid step, and the solid of the step
    awaiting,     ///< client, iterated: for the solid of this pass, while its program is blocked
    iterating,    ///< client, iterated: for its program to repeat or to end the fluid step
    computing,    ///< server: for its program to answer the fluid
    completing,   ///< server: for the cells of the fluid that were left out
    saving,       ///< client: for CheckpointSaved; server: for its program to save a checkpoint
    finished,     ///< both: Goodbye was said
    failed        ///< both: a fault ended the session
};

/// What moves a session: a call of its program, or a message of its peer. Error and Heartbeat are in no table, because
/// they mean the same in every state: Error -> failed, Heartbeat -> no change.
enum class Event
{
    // calls of the client's program
    connect,
    send_mesh,
    begin_serial_step,
    begin_overlapped_step,
    begin_iterated_step,
    iterate_step,
    end_step,
    save_checkpoint,
    finish,
    // calls of the server's program
    wait_for_client,
    receive_mesh,
    accept_mesh,
    reject_mesh,
    receive_fluid,
    complete,
    send_solid,
    checkpoint_is_saved,
    // messages
    hello,
    welcome,
    mesh,
    mesh_accepted,
    fluid_state,
    solid_state,
    fluid_wanted,
    goodbye,
    checkpoint,
    checkpoint_saved
};

/// In state `from`, `event` is legal and leads to state `to`. What no rule allows is refused.
struct Rule
{
    State from;
    Event event;
    State to;
};

Span<Rule const> client_rules();
Span<Rule const> server_rules();

/// Where the event leads to, if it is legal.
std::optional<State> next_state(Span<Rule const> rules, State from, Event event);

std::string name_of(State state);
/// "begin_step()" for a call, "FluidState" for a message.
std::string name_of(Event event);
/// The event that a message is; empty for Error and Heartbeat.
std::optional<Event> event_of(message::Kind kind);
/// The messages that a state allows, for error texts: "Mesh or Goodbye".
std::string allowed_messages(Span<Rule const> rules, State state);

}  // namespace gimdem::coupling::session
