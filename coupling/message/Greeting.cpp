// SPDX-License-Identifier: BSD-3-Clause
#include "message/Greeting.hpp"

#include "message/CheckpointMessages.hpp"
#include "message/Fields.hpp"

namespace gimdem::coupling::message
{
namespace
{

v1::Schedule to_wire(Schedule schedule)
{
    return schedule == Schedule::serial ? v1::SCHEDULE_SERIAL : v1::SCHEDULE_OVERLAPPED;
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
        default:
            refuse("unknown schedule " + std::to_string(static_cast<int>(schedule)));
    }
}

}  // namespace

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

    check_name(welcome.server, "Welcome: the server's name");
    check_number(welcome.end_time, 0, "Welcome: end time");
    choose_fluid_fields(welcome.needs, Fault::protocol);
    return welcome;
}

}  // namespace gimdem::coupling::message
