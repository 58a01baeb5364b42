// SPDX-License-Identifier: BSD-3-Clause
/// Every message and every call in every state, against a second writing of the rules.
#include "session/States.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"
#include "session/Session.hpp"

namespace gimdem::coupling::session
{
namespace
{

using test::RawMessage;
using test::RawPeer;

/// How to bring a new session to a state.
struct Path
{
    State state;
    std::vector<Event> events;
};

std::vector<Path> const client_paths{
    {State::greeting, {Event::connect}},
    {State::welcomed, {Event::connect, Event::welcome}},
    {State::meshing, {Event::connect, Event::welcome, Event::send_mesh}},
    {State::accepted, {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted}},
    {State::ready, {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state}},
    {State::waiting,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::begin_serial_step}},
    {State::solving,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::begin_serial_step, Event::solid_state}},
    {State::overlapping,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::begin_overlapped_step}},
    {State::awaiting,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::begin_iterated_step}},
    {State::iterating,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::begin_iterated_step, Event::solid_state, Event::iterate_step, Event::solid_state}},
    {State::saving,
     {Event::connect, Event::welcome, Event::send_mesh, Event::mesh_accepted, Event::solid_state,
      Event::save_checkpoint}}};

std::vector<Path> const server_paths{
    {State::listening, {}},
    {State::welcomed, {Event::hello}},
    {State::meshing, {Event::hello, Event::mesh}},
    {State::ready, {Event::hello, Event::mesh, Event::accept_mesh}},
    {State::computing, {Event::hello, Event::mesh, Event::accept_mesh, Event::fluid_state}},
    {State::saving, {Event::hello, Event::mesh, Event::accept_mesh, Event::checkpoint}}};

/// The rules once more, from docs/protocol.md: the only messages that a state takes, and where they lead.
using Allowed = std::map<std::pair<State, std::string>, State>;

Allowed const client_allows{
    {{State::greeting, "Welcome"}, State::welcomed},    {{State::meshing, "MeshAccepted"}, State::accepted},
    {{State::accepted, "SolidState"}, State::ready},    {{State::waiting, "SolidState"}, State::solving},
    {{State::overlapping, "SolidState"}, State::ready}, {{State::awaiting, "SolidState"}, State::iterating},
    {{State::saving, "CheckpointSaved"}, State::ready}};

Allowed const server_allows{
    {{State::listening, "Hello"}, State::welcomed},   {{State::welcomed, "Mesh"}, State::meshing},
    {{State::ready, "FluidState"}, State::computing}, {{State::welcomed, "Goodbye"}, State::finished},
    {{State::meshing, "Goodbye"}, State::finished},   {{State::ready, "Goodbye"}, State::finished},
    {{State::computing, "Goodbye"}, State::finished}, {{State::ready, "Checkpoint"}, State::saving}};

std::map<std::string, RawMessage> every_message()
{
    Mesh const mesh = test::small_mesh();
    return {{"Hello", test::raw_hello()},
            {"Welcome", test::raw_welcome()},
            {"Mesh", test::raw_mesh(mesh)},
            {"MeshAccepted", test::raw_mesh_accepted(mesh.cell_count)},
            {"FluidState", test::raw_fluid(1, 0, 1e-3, mesh.cell_count)},
            {"SolidState", test::raw_solid(1, mesh.cell_count)},
            {"Checkpoint", test::raw_checkpoint()},
            {"CheckpointSaved", test::raw_checkpoint_saved()},
            {"Goodbye", test::raw_goodbye()},
            {"Error", test::raw_error("raw trouble")}};
}

/// A session in some state, and a raw peer that can send it anything.
class Meeting
{
public:
    Meeting(Role role, Path const& path) : session(role, "the session", test::patient), peer(open(role, session))
    {
        for (Event const event : path.events)
            happen(event);
        EXPECT_EQ(session.state(), path.state);
    }

    void receive()
    {
        session.receive("anything", transport::Clock::now() + transport::ticks(test::patient), test::patient);
    }

    Session session;
    RawPeer peer;

private:
    /// Only Hello must really travel: it makes its sender the server's peer.
    void happen(Event event)
    {
        if (event != Event::hello) return session.advance(event);
        peer.send(test::raw_hello());
        receive();
    }

    static RawPeer open(Role role, Session& session)
    {
        if (role == Role::server)
        {
            session.open(transport::Socket::bind(test::unused_ipc_endpoint()));
            return RawPeer::client(session.endpoint());
        }
        RawPeer peer = RawPeer::server(test::any_tcp_endpoint());
        session.open(transport::Socket::connect(peer.endpoint()));
        session.send(message::pack_goodbye("anything, so that the peer knows our address"));
        EXPECT_TRUE(peer.receive());
        return peer;
    }
};

void expect_refusal(Meeting& meeting, State state, std::string const& name)
{
    std::string const where = "in state " + name_of(state);
    std::string const thrown = test::thrown_by([&] { meeting.receive(); });
    if (name == "Error")
    {
        EXPECT_THAT(thrown, testing::StartsWith("peer: "));
        EXPECT_THAT(thrown, testing::HasSubstr("raw trouble"));
        EXPECT_THAT(thrown, testing::HasSubstr(where));
    }
    else
    {
        EXPECT_THAT(thrown, testing::StartsWith("protocol: " + name));
        EXPECT_THAT(thrown, testing::HasSubstr("is out of order " + where));
        std::string const told = meeting.peer.receive_error();
        EXPECT_THAT(told, testing::HasSubstr(name));
        EXPECT_THAT(told, testing::HasSubstr("is out of order " + where));
    }
    EXPECT_EQ(meeting.session.state(), State::failed);
}

void check_every_message(Role role, std::vector<Path> const& paths, Allowed const& allows)
{
    for (Path const& path : paths)
        for (auto const& [name, raw] : every_message())
        {
            SCOPED_TRACE(name + " in state " + name_of(path.state));
            Meeting meeting(role, path);
            if (raw.envelope.has_welcome()) meeting.peer.set_session(0);
            RawMessage message = raw;
            if (!message.envelope.has_welcome()) message.envelope.clear_session();
            meeting.peer.send(message);

            auto const allowed = allows.find({path.state, name});
            if (allowed == allows.end())
            {
                expect_refusal(meeting, path.state, name);
                continue;
            }
            EXPECT_EQ(test::thrown_by([&] { meeting.receive(); }), "(nothing)");
            EXPECT_EQ(name_of(meeting.session.state()), name_of(allowed->second));
        }
}

TEST(States, OfTheClientTakeTheirMessagesOnly)
{
    check_every_message(Role::client, client_paths, client_allows);
}

TEST(States, OfTheServerTakeTheirMessagesOnly)
{
    // A server that has no client yet takes no notice of last words to an earlier one: see Strangers below.
    std::vector<Path> const connected(server_paths.begin() + 1, server_paths.end());
    check_every_message(Role::server, connected, server_allows);
}

TEST(States, OfAServerWithoutAClientTakeHelloOnly)
{
    for (auto const& [name, raw] : every_message())
    {
        SCOPED_TRACE(name);
        Meeting meeting(Role::server, server_paths.front());
        RawMessage message = raw;
        message.envelope.clear_session();
        bool const ignored = name == "Goodbye" || name == "Error";
        meeting.peer.send(message);
        if (ignored) meeting.peer.send(test::raw_hello());

        if (ignored || name == "Hello")
        {
            EXPECT_EQ(test::thrown_by([&] { meeting.receive(); }), "(nothing)");
            EXPECT_EQ(meeting.session.state(), State::welcomed);
        }
        else
            expect_refusal(meeting, State::listening, name);
    }
}

TEST(States, IgnoreHeartbeatsEverywhere)
{
    for (Path const& path : server_paths)
    {
        Meeting meeting(Role::server, path);
        for (int k = 0; k < 3; ++k)
            meeting.peer.send(test::raw_heartbeat());
        EXPECT_EQ(test::thrown_by([&] { meeting.session.look_for_trouble("nothing"); }), "(nothing)");
        EXPECT_EQ(meeting.session.state(), path.state);
    }
}

TEST(States, RefuseAMessageOfAnotherSession)
{
    Meeting meeting(Role::server, server_paths[3]);
    meeting.session.choose_session_number();
    meeting.peer.set_session(12345);
    meeting.peer.send(test::raw_fluid(1, 0, 1e-3, 24));

    EXPECT_FAULT(meeting.receive(), Fault::protocol, "belongs to session 12345");
    EXPECT_THAT(meeting.peer.receive_error(), testing::HasSubstr("belongs to session 12345"));
}

TEST(States, LookForTroubleBeforeTheySendMore)
{
    Meeting meeting(Role::server, server_paths[4]);
    ASSERT_NO_THROW(meeting.session.look_for_trouble("the solid"));
    meeting.peer.send(test::raw_fluid(2, 0, 1e-3, 24));

    // It is on its way: look until it is here.
    std::string thrown = "(nothing)";
    auto const deadline = transport::Clock::now() + transport::ticks(test::patient);
    while (thrown == "(nothing)" && transport::Clock::now() < deadline)
        thrown = test::thrown_by([&] { meeting.session.look_for_trouble("the solid"); });
    EXPECT_THAT(thrown, testing::HasSubstr("FluidState of step 2"));
    EXPECT_THAT(thrown, testing::HasSubstr("out of order in state computing"));
}

/// The calls that a state allows, once more.
std::map<State, std::vector<Event>> const client_calls{
    {State::created, {Event::connect, Event::finish}},
    {State::greeting, {}},
    {State::welcomed, {Event::send_mesh, Event::finish}},
    {State::meshing, {}},
    {State::accepted, {}},
    {State::ready,
     {Event::begin_serial_step, Event::begin_overlapped_step, Event::begin_iterated_step, Event::save_checkpoint,
      Event::finish}},
    {State::waiting, {}},
    {State::solving, {Event::end_step, Event::finish}},
    {State::overlapping, {Event::end_step, Event::finish}},
    {State::saving, {}},
    {State::awaiting, {}},
    {State::iterating, {Event::iterate_step, Event::end_step, Event::finish}},
    {State::finished, {Event::finish}},
    {State::failed, {}}};

std::map<State, std::vector<Event>> const server_calls{{State::listening, {Event::wait_for_client}},
                                                       {State::welcomed, {Event::receive_mesh}},
                                                       {State::meshing, {Event::accept_mesh, Event::reject_mesh}},
                                                       {State::ready, {Event::receive_fluid}},
                                                       {State::computing, {Event::send_solid}},
                                                       {State::saving, {Event::checkpoint_is_saved}},
                                                       {State::finished, {Event::receive_fluid}},
                                                       {State::failed, {}}};

void check_calls(Span<Rule const> rules, std::map<State, std::vector<Event>> const& legal)
{
    for (auto const& [state, calls] : legal)
        for (int event = 0; event < static_cast<int>(Event::hello); ++event)
        {
            auto const call = static_cast<Event>(event);
            bool const expected = std::find(calls.begin(), calls.end(), call) != calls.end();
            EXPECT_EQ(next_state(rules, state, call).has_value(), expected)
                << name_of(call) << " in state " << name_of(state);
        }
}

TEST(States, AllowTheirCallsOnly)
{
    check_calls(client_rules(), client_calls);
    check_calls(server_rules(), server_calls);
}

TEST(States, NameTheCallTheStateAndTheFaultBefore)
{
    Session session(Role::client, "the session", test::patient);
    EXPECT_FAULT(session.require(Event::send_mesh), Fault::user, "send_mesh() is illegal in state created");
    session.abort(Fault::user, "it broke");
    EXPECT_FAULT(session.require(Event::connect), Fault::user,
                 "illegal in state failed, step 0 after the fault: it broke");
}

/// The rows below a heading of docs/protocol.md, up to the next heading.
std::vector<std::string> documented_rows(std::string const& heading)
{
    std::ifstream page(GIMDEM_PROTOCOL_PAGE);
    std::vector<std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(page, line);)
    {
        if (line.rfind("#", 0) == 0) inside = line == heading;
        bool const is_row = inside && line.rfind("| ", 0) == 0 && line != "| state | event | next state |";
        if (is_row) rows.push_back(line);
    }
    return rows;
}

std::vector<std::string> rows_of(Span<Rule const> rules)
{
    std::vector<std::string> rows;
    for (Rule const& rule : rules)
    {
        std::string event = name_of(rule.event);
        if (rule.event == Event::begin_serial_step) event += ", serial";
        if (rule.event == Event::begin_overlapped_step) event += ", overlapped";
        if (rule.event == Event::begin_iterated_step) event += ", iterated";
        rows.push_back("| " + name_of(rule.from) + " | " + event + " | " + name_of(rule.to) + " |");
    }
    return rows;
}

TEST(States, AreDocumentedAsTheyAre)
{
    EXPECT_EQ(documented_rows("### States of the client"), rows_of(client_rules()));
    EXPECT_EQ(documented_rows("### States of the server"), rows_of(server_rules()));
}

}  // namespace
}  // namespace gimdem::coupling::session
