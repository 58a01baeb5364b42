// SPDX-License-Identifier: BSD-3-Clause
/// Hello and Welcome, as the server sees them.
#include "message/ClockMessages.hpp"
#include "message/Greeting.hpp"
#include "session/Options.hpp"
#include "session/ServerSession.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;
using transport::ticks;

Newcomer ServerSession::await_hello(ServerTerms const& offered)
{
    session_.require(Event::wait_for_client);
    terms_.fluid = message::choose_fluid_fields(offered.needs, Fault::user);
    wait_for_contact();
    Newcomer newcomer{.letter = receive("Hello"), .hello = {}};
    newcomer.hello = session_.read([&] { return message::unpack_hello(newcomer.letter.message); });
    session_.set_peer_name(name_of_rank(newcomer.hello.name, newcomer.hello.rank));
    check_rank(newcomer.hello.rank);
    return newcomer;
}

ClientInfo ServerSession::welcome(Newcomer const& newcomer, ServerTerms const& offered,
                                  std::vector<std::string> const& rank_endpoints)
{
    Letter const& letter = newcomer.letter;
    message::Hello const& hello = newcomer.hello;
    session_.choose_session_number();
    terms_.encodings = both(options_.encodings, hello.encodings);
    terms_.solid = message::choose_solid_fields(hello.wants, Fault::protocol);
    Schedule const schedule = choose_schedule(hello, offered);

    message::Message welcome = message::pack(Welcome{.server = options_.name,
                                                     .title = offered.title,
                                                     .schedule = schedule,
                                                     .end_time = offered.end_time,
                                                     .needs = offered.needs,
                                                     .saves_checkpoints = saves_checkpoints(),
                                                     .fluid_steps = offered.fluid_steps,
                                                     .iteration = offered.iteration,
                                                     .rank_endpoints = rank_endpoints,
                                                     .encodings = terms_.encodings});
    shared_.offer(welcome);
    shared_.agree(letter.message);
    session_.limit_arrays(transport::half_of_memory());
    if (session_.read([&] { return message::clock_reading(letter.message); }))
        message::put(
            {transport::on_clock(letter.arrival), clock_now(), options_.clock_origin, message::machine_number()},
            welcome);
    session_.send(std::move(welcome));
    return {.name = hello.name,
            .fluid = hello.fluid,
            .wants = hello.wants,
            .schedule = hello.schedule,
            .resume = hello.resume,
            .iterates = hello.iterates,
            .ranks = hello.rank.count};
}

Schedule ServerSession::choose_schedule(message::Hello const& hello, ServerTerms const& offered)
{
    Schedule const schedule = hello.schedule.value_or(offered.schedule);
    iterates_ = schedule == Schedule::iterated;
    if (iterates_ && !hello.iterates)
        session_.fail(Fault::user, "the schedule is iterated, and " + session_.peer_name() +
                                       " cannot repeat a step (it does not say so in Hello); choose schedule serial or "
                                       "overlapped, or another client");
    return schedule;
}

void ServerSession::wait_for_contact()
{
    if (session_.wait_for_contact(Clock::now() + ticks(options_.connect_time))) return;
    std::string const within =
        " has appeared at " + session_.endpoint() + " within " + seconds_text(options_.connect_time);
    if (expected_rank_)
        session_.fail(Fault::timeout, "no rank " + std::to_string(expected_rank_->number) + " of " +
                                          std::to_string(expected_rank_->count) + within +
                                          " (rank 0 is there); see why it did not start, or allow more time");
    session_.fail(Fault::timeout, "no client" + within +
                                      " (the fluid solver did not start, or uses another endpoint); start it with "
                                      "the same endpoint, or allow more time");
}

void ServerSession::check_rank(Rank const& rank)
{
    Rank const expected = expected_rank_.value_or(Rank{0, rank.count, rank.run});
    if (rank.number == expected.number && rank.count == expected.count && rank.run == expected.run) return;
    std::string const why =
        rank.number == expected.number && rank.count == expected.count
            ? "it belongs to another run"
            : "rank " + std::to_string(expected.number) + " of " + std::to_string(expected.count) + " is due there";
    session_.fail(Fault::protocol, session_.peer_name() + " has come to the endpoint " + session_.endpoint() +
                                       ", but " + why +
                                       " (rank 0 tells the others their endpoints and the number of the run); is "
                                       "an old program still running?");
}

}  // namespace gimdem::coupling::session
