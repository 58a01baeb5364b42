// SPDX-License-Identifier: BSD-3-Clause
#include "session/States.hpp"

#include <array>

namespace gimdem::coupling::session
{
namespace
{

using S = State;
using E = Event;
using message::Kind;

std::array<Rule, 25> constexpr client_table{{
    {S::created, E::connect, S::greeting},
    {S::greeting, E::welcome, S::welcomed},
    {S::welcomed, E::send_mesh, S::meshing},
    {S::meshing, E::mesh_accepted, S::accepted},
    {S::accepted, E::solid_state, S::ready},
    // serial
    {S::ready, E::begin_serial_step, S::waiting},
    {S::waiting, E::fluid_wanted, S::waiting},
    {S::waiting, E::solid_state, S::solving},
    {S::solving, E::end_step, S::ready},
    // overlapped
    {S::ready, E::begin_overlapped_step, S::overlapping},
    {S::overlapping, E::end_step, S::overlapping},
    {S::overlapping, E::solid_state, S::ready},
    // iterated
    {S::ready, E::begin_iterated_step, S::awaiting},
    {S::awaiting, E::solid_state, S::iterating},
    {S::iterating, E::iterate_step, S::awaiting},
    {S::iterating, E::end_step, S::ready},
    // between two steps
    {S::ready, E::save_checkpoint, S::saving},
    {S::saving, E::checkpoint_saved, S::ready},
    // the end
    {S::created, E::finish, S::finished},
    {S::welcomed, E::finish, S::finished},
    {S::ready, E::finish, S::finished},
    {S::solving, E::finish, S::finished},
    {S::overlapping, E::finish, S::finished},
    {S::iterating, E::finish, S::finished},
    {S::finished, E::finish, S::finished},
}};

std::array<Rule, 18> constexpr server_table{{
    {S::listening, E::wait_for_client, S::listening},
    {S::listening, E::hello, S::welcomed},
    {S::welcomed, E::receive_mesh, S::welcomed},
    {S::welcomed, E::mesh, S::meshing},
    {S::meshing, E::accept_mesh, S::ready},
    {S::meshing, E::reject_mesh, S::failed},
    {S::ready, E::receive_fluid, S::ready},
    {S::ready, E::fluid_state, S::computing},
    {S::computing, E::complete, S::completing},
    {S::completing, E::fluid_state, S::computing},
    {S::computing, E::send_solid, S::ready},
    // between two steps
    {S::ready, E::checkpoint, S::saving},
    {S::saving, E::checkpoint_is_saved, S::ready},
    // the end
    {S::welcomed, E::goodbye, S::finished},
    {S::meshing, E::goodbye, S::finished},
    {S::ready, E::goodbye, S::finished},
    {S::computing, E::goodbye, S::finished},
    {S::finished, E::receive_fluid, S::finished},
}};

}  // namespace

Span<Rule const> client_rules()
{
    return {client_table.data(), client_table.size()};
}
Span<Rule const> server_rules()
{
    return {server_table.data(), server_table.size()};
}

std::optional<State> next_state(Span<Rule const> rules, State from, Event event)
{
    for (Rule const& rule : rules)
        if (rule.from == from && rule.event == event) return rule.to;
    return std::nullopt;
}

std::string name_of(State state)
{
    switch (state)
    {
        case S::created:
            return "created";
        case S::greeting:
            return "greeting";
        case S::listening:
            return "listening";
        case S::welcomed:
            return "welcomed";
        case S::meshing:
            return "meshing";
        case S::accepted:
            return "accepted";
        case S::ready:
            return "ready";
        case S::waiting:
            return "waiting";
        case S::solving:
            return "solving";
        case S::overlapping:
            return "overlapping";
        case S::awaiting:
            return "awaiting";
        case S::iterating:
            return "iterating";
        case S::computing:
            return "computing";
        case S::completing:
            return "completing";
        case S::saving:
            return "saving";
        case S::finished:
            return "finished";
        case S::failed:
            return "failed";
    }
    return "unknown";
}

std::string name_of(Event event)
{
    switch (event)
    {
        case E::connect:
            return "connect()";
        case E::send_mesh:
            return "send_mesh()";
        case E::begin_serial_step:
        case E::begin_overlapped_step:
        case E::begin_iterated_step:
            return "begin_step()";
        case E::iterate_step:
            return "iterate_step()";
        case E::end_step:
            return "end_step()";
        case E::save_checkpoint:
            return "save_checkpoint()";
        case E::checkpoint_is_saved:
            return "saver()";
        case E::finish:
            return "finish()";
        case E::wait_for_client:
            return "wait_for_client()";
        case E::receive_mesh:
            return "receive_mesh()";
        case E::accept_mesh:
            return "accept_mesh()";
        case E::reject_mesh:
            return "reject_mesh()";
        case E::receive_fluid:
            return "receive_fluid()";
        case E::complete:
            return "complete()";
        case E::send_solid:
            return "send_solid()";
        case E::hello:
            return message::kind_name(Kind::kHello);
        case E::welcome:
            return message::kind_name(Kind::kWelcome);
        case E::mesh:
            return message::kind_name(Kind::kMesh);
        case E::mesh_accepted:
            return message::kind_name(Kind::kMeshAccepted);
        case E::fluid_state:
            return message::kind_name(Kind::kFluidState);
        case E::solid_state:
            return message::kind_name(Kind::kSolidState);
        case E::fluid_wanted:
            return message::kind_name(Kind::kFluidWanted);
        case E::goodbye:
            return message::kind_name(Kind::kGoodbye);
        case E::checkpoint:
            return message::kind_name(Kind::kCheckpoint);
        case E::checkpoint_saved:
            return message::kind_name(Kind::kCheckpointSaved);
    }
    return "unknown";
}

std::optional<Event> event_of(Kind kind)
{
    switch (kind)
    {
        case Kind::kHello:
            return E::hello;
        case Kind::kWelcome:
            return E::welcome;
        case Kind::kMesh:
            return E::mesh;
        case Kind::kMeshAccepted:
            return E::mesh_accepted;
        case Kind::kFluidState:
            return E::fluid_state;
        case Kind::kSolidState:
            return E::solid_state;
        case Kind::kFluidWanted:
            return E::fluid_wanted;
        case Kind::kGoodbye:
            return E::goodbye;
        case Kind::kCheckpoint:
            return E::checkpoint;
        case Kind::kCheckpointSaved:
            return E::checkpoint_saved;
        default:
            return std::nullopt;
    }
}

std::string allowed_messages(Span<Rule const> rules, State state)
{
    std::string names;
    for (Rule const& rule : rules)
        if (rule.from == state && rule.event >= E::hello) names += (names.empty() ? "" : " or ") + name_of(rule.event);
    return names.empty() ? "none" : names;
}

}  // namespace gimdem::coupling::session
