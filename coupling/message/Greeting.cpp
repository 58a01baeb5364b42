// SPDX-License-Identifier: BSD-3-Clause
#include "message/Greeting.hpp"

#include <algorithm>

#include "message/CheckpointMessages.hpp"
#include "message/Fields.hpp"

namespace gimdem::coupling::message
{
namespace
{

v1::Schedule to_wire(Schedule schedule)
{
    switch (schedule)
    {
        case Schedule::serial:
            return v1::SCHEDULE_SERIAL;
        case Schedule::overlapped:
            return v1::SCHEDULE_OVERLAPPED;
        case Schedule::iterated:
            return v1::SCHEDULE_ITERATED;
    }
    return v1::SCHEDULE_UNSPECIFIED;
}

std::optional<Schedule> from_wire(v1::Schedule schedule)
{
    switch (schedule)
    {
        case v1::SCHEDULE_UNSPECIFIED:
            return std::nullopt;
        case v1::SCHEDULE_SERIAL:
            return Schedule::serial;
        case v1::SCHEDULE_OVERLAPPED:
            return Schedule::overlapped;
        case v1::SCHEDULE_ITERATED:
            return Schedule::iterated;
        default:
            refuse("unknown schedule " + std::to_string(static_cast<int>(schedule)));
    }
}

using WireEncodings = google::protobuf::RepeatedField<int>;

void pack_encodings(Encodings const& encodings, WireEncodings& body)
{
    if (encodings.sparse) body.Add(v1::ENCODING_SPARSE);
    if (encodings.float32) body.Add(v1::ENCODING_FLOAT32);
    if (encodings.lz4) body.Add(v1::ENCODING_LZ4);
}

/// Those that a later version adds are not for us.
Encodings unpack_encodings(WireEncodings const& body)
{
    auto const has = [&](v1::Encoding encoding) { return std::find(body.begin(), body.end(), encoding) != body.end(); };
    return {has(v1::ENCODING_SPARSE), has(v1::ENCODING_FLOAT32), has(v1::ENCODING_LZ4)};
}

void pack_iteration(Iteration const& iteration, v1::Iteration& body)
{
    body.set_tolerance(iteration.tolerance);
    body.set_max_passes(iteration.max_passes);
    body.set_relaxation(iteration.relaxation);
    body.set_must_converge(iteration.must_converge);
}

Iteration unpack_iteration(v1::Iteration const& body)
{
    check_number(body.tolerance(), 0, "Welcome: tolerance");
    check_number(body.max_passes(), 1, "Welcome: max_passes");
    check_number(body.relaxation(), 0, "Welcome: relaxation");
    return {body.tolerance(), body.max_passes(), body.relaxation(), body.must_converge()};
}

void pack_rank(Rank const& rank, v1::Hello& body)
{
    if (rank.count == 1) return;
    body.set_rank(rank.number);
    body.set_ranks(rank.count);
    body.set_run(rank.run);
}

Rank unpack_rank(v1::Hello const& body)
{
    Rank const rank{body.rank(), body.ranks() == 0 ? 1 : body.ranks(), body.run()};
    if (auto const fault = find_rank_fault(rank)) refuse("Hello: " + *fault);
    return rank;
}

}  // namespace

std::optional<std::string> find_rank_fault(Rank const& rank)
{
    if (rank.count < 1 || rank.count > max_ranks)
        return std::to_string(rank.count) + " ranks (1 to " + std::to_string(max_ranks) + ")";
    if (rank.number < 0 || rank.number >= rank.count)
        return "rank " + std::to_string(rank.number) + " of " + std::to_string(rank.count) + " (counted from 0)";
    if (rank.count > 1 && rank.run == 0) return "rank " + std::to_string(rank.number) + " without the run's number";
    return std::nullopt;
}

Message pack(Hello const& hello)
{
    Message message;
    v1::Hello& body = *message.envelope.mutable_hello();
    body.set_name(printable(hello.name));
    body.set_density(hello.fluid.density);
    body.set_viscosity(hello.fluid.viscosity);
    for (std::string const& name : hello.wants)
        body.add_wants(name);
    if (hello.schedule) body.set_schedule(to_wire(*hello.schedule));
    body.set_timeout(hello.timeout);
    if (hello.resume) pack_resume_point(*hello.resume, body);
    body.set_iterates(hello.iterates);
    pack_rank(hello.rank, body);
    pack_encodings(hello.encodings, *body.mutable_encodings());
    return message;
}

Message pack(Welcome const& welcome)
{
    Message message;
    v1::Welcome& body = *message.envelope.mutable_welcome();
    body.set_server(printable(welcome.server));
    body.set_title(printable(welcome.title));
    body.set_schedule(to_wire(welcome.schedule));
    body.set_end_time(welcome.end_time);
    for (std::string const& name : welcome.needs)
        body.add_needs(name);
    body.set_saves_checkpoints(welcome.saves_checkpoints);
    body.set_fluid_steps(welcome.fluid_steps);
    if (welcome.schedule == Schedule::iterated) pack_iteration(welcome.iteration, *body.mutable_iteration());
    for (std::string const& endpoint : welcome.rank_endpoints)
        body.add_rank_endpoints(endpoint);
    pack_encodings(welcome.encodings, *body.mutable_encodings());
    return message;
}

Hello unpack_hello(Message const& message)
{
    v1::Hello const& body = message.envelope.hello();
    Hello hello;
    hello.name = body.name();
    hello.fluid = {body.density(), body.viscosity()};
    hello.wants.assign(body.wants().begin(), body.wants().end());
    hello.schedule = from_wire(body.schedule());
    hello.timeout = body.timeout();
    hello.resume = unpack_resume_point(body);
    hello.iterates = body.iterates();
    hello.rank = unpack_rank(body);
    hello.encodings = unpack_encodings(body.encodings());

    check_name(hello.name, "Hello: the client's name");
    check_number(hello.fluid.density, 0, "Hello: density");
    check_number(hello.fluid.viscosity, 0, "Hello: viscosity");
    check_number(hello.timeout, min_timeout, "Hello: timeout");
    choose_solid_fields(hello.wants, Fault::protocol);
    return hello;
}

Welcome unpack_welcome(Message const& message)
{
    v1::Welcome const& body = message.envelope.welcome();
    auto const schedule = from_wire(body.schedule());
    if (!schedule) refuse("Welcome: no schedule");

    Welcome welcome;
    welcome.server = body.server();
    welcome.title = body.title();
    welcome.schedule = *schedule;
    welcome.end_time = body.end_time();
    welcome.needs.assign(body.needs().begin(), body.needs().end());
    welcome.saves_checkpoints = body.saves_checkpoints();
    welcome.fluid_steps = std::max(1, body.fluid_steps());
    if (*schedule == Schedule::iterated) welcome.iteration = unpack_iteration(body.iteration());
    welcome.rank_endpoints.assign(body.rank_endpoints().begin(), body.rank_endpoints().end());
    welcome.encodings = unpack_encodings(body.encodings());

    check_name(welcome.server, "Welcome: the server's name");
    check_number(welcome.end_time, 0, "Welcome: end time");
    choose_fluid_fields(welcome.needs, Fault::protocol);
    return welcome;
}

}  // namespace gimdem::coupling::message
