// SPDX-License-Identifier: BSD-3-Clause
#include "message/StatusMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

int constexpr max_figures = 512;

std::string cut(std::string const& text)
{
    return printable(text).substr(0, max_name_bytes);
}

void pack_run(RunStatus const& run, v1::Status& body)
{
    body.set_title(printable(run.title));
    body.set_activity(printable(run.activity));
    body.set_folder(printable(run.folder));
    body.set_schedule(run.schedule);
    body.set_time(run.time);
    body.set_end_time(run.end_time);
    body.set_steps_per_second(run.steps_per_second);
    body.set_wall_per_simulated(run.wall_per_simulated);
    for (Monitor const& figure : run.figures)
    {
        v1::Monitor& entry = *body.add_figures();
        entry.set_name(printable(figure.name));
        entry.set_value(figure.value);
        entry.set_unit(printable(figure.unit));
    }
}

RunStatus unpack_run(v1::Status const& body)
{
    if (body.figures_size() > max_figures)
        refuse("Status: " + std::to_string(body.figures_size()) + " figures (at most " + std::to_string(max_figures) +
               ")");
    RunStatus run{cut(body.title()),
                  cut(body.activity()),
                  body.folder().substr(0, max_text_bytes),
                  cut(body.schedule()),
                  body.time(),
                  body.end_time(),
                  body.steps_per_second(),
                  body.wall_per_simulated(),
                  {}};
    for (v1::Monitor const& figure : body.figures())
        run.figures.push_back({cut(figure.name()), figure.value(), cut(figure.unit())});
    return run;
}

}  // namespace

Message pack_status_request(std::string const& name)
{
    Message message;
    message.envelope.mutable_status_request()->set_name(printable(name));
    return message;
}

Message pack(Status const& status)
{
    Message message;
    message.envelope.set_step(status.step);
    v1::Status& body = *message.envelope.mutable_status();
    body.set_server(printable(status.server));
    body.set_state(status.state);
    body.set_state_time(status.state_time);
    body.set_uptime(status.uptime);
    body.set_memory(status.memory);
    body.set_process(status.process);
    body.set_client(printable(status.client));
    body.set_client_state(printable(status.client_state));
    body.set_client_silence(status.client_silence);
    body.set_clock_offset(status.clock.offset);
    body.set_clock_uncertainty(status.clock.uncertainty);
    pack_run(status.run, body);
    return message;
}

Status unpack_status(Message const& message)
{
    v1::Status const& body = message.envelope.status();
    Status status;
    status.run = unpack_run(body);
    status.server = cut(body.server());
    status.protocol =
        std::to_string(message.envelope.protocol_major()) + "." + std::to_string(message.envelope.protocol_minor());
    status.state = cut(body.state());
    status.state_time = body.state_time();
    status.step = message.envelope.step();
    status.uptime = body.uptime();
    status.memory = body.memory();
    status.process = body.process();
    status.client = cut(body.client());
    status.client_state = cut(body.client_state());
    status.client_silence = body.client_silence();
    status.clock = {body.clock_offset(), body.clock_uncertainty()};
    return status;
}

}  // namespace gimdem::coupling::message
