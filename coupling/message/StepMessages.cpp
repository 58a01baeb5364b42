// SPDX-License-Identifier: BSD-3-Clause
#include "message/StepMessages.hpp"

#include <cmath>
#include <limits>

#include "message/ClockMessages.hpp"
#include "message/Runs.hpp"

namespace gimdem::coupling::message
{
namespace
{

int constexpr max_monitors = 256;

void check_sent_number(double value, double least, char const* whose)
{
    if (!std::isfinite(value) || value < least)
        throw CouplingError(Fault::user, std::string(whose) + " is " + number_text(value) +
                                             " (it must be finite and at least " + number_text(least) +
                                             "); check the call");
}

void pack_timings(Timings const& timings, v1::Timings& body)
{
    check_sent_number(timings.compute, 0, "timings.compute");
    check_sent_number(timings.mapping, 0, "timings.mapping");
    check_sent_number(timings.output, 0, "timings.output");
    body.set_compute(timings.compute);
    body.set_mapping(timings.mapping);
    body.set_output(timings.output);
}

Timings unpack_timings(v1::Timings const& body)
{
    check_number(body.compute(), 0, "timings.compute");
    check_number(body.mapping(), 0, "timings.mapping");
    check_number(body.output(), 0, "timings.output");
    return {body.compute(), body.mapping(), body.output()};
}

void pack_monitors(std::vector<Monitor> const& monitors, v1::FluidState& body)
{
    if (monitors.size() > max_monitors)
        throw CouplingError(Fault::user, std::to_string(monitors.size()) + " monitors (at most " +
                                             std::to_string(max_monitors) + "); send the ones that a log needs");
    for (Monitor const& monitor : monitors)
    {
        if (monitor.name.empty() || monitor.name.size() > max_name_bytes)
            throw CouplingError(Fault::user,
                                "a monitor has an empty or too long name; give it one that a log can print");
        v1::Monitor& entry = *body.add_monitors();
        entry.set_name(printable(monitor.name));
        entry.set_value(monitor.value);
        entry.set_unit(printable(monitor.unit));
    }
}

std::vector<Monitor> unpack_monitors(v1::FluidState const& body)
{
    if (body.monitors_size() > max_monitors)
        refuse("FluidState: " + std::to_string(body.monitors_size()) + " monitors (at most " +
               std::to_string(max_monitors) + ")");
    std::vector<Monitor> monitors;
    for (v1::Monitor const& entry : body.monitors())
    {
        check_name(entry.name(), "FluidState: the name of a monitor");
        monitors.push_back({entry.name(), entry.value(), entry.unit()});
    }
    return monitors;
}

/// Both sides must have agreed on the ways that the arrays travel.
void check_encodings(Message const& message, Encodings const& encodings)
{
    for (v1::ArrayHeader const& header : message.envelope.arrays())
    {
        std::string const who = describe(message) + ": array \"" + header.name() + "\"";
        if (!header.dense() && !encodings.sparse) refuse(who + " is sparse, which was not agreed on");
        if (header.type() == v1::ELEMENT_TYPE_F32 && !encodings.float32)
            refuse(who + " has numbers of 32 bits, which was not agreed on");
        if (header.compression() != v1::COMPRESSION_NONE && !encodings.lz4)
            refuse(who + " is compressed, which was not agreed on");
    }
}

/// Has the fluid all cells? Fault::protocol if cells that are needed are not in it.
bool is_complete(Message const& message, Terms const& terms)
{
    bool complete = true;
    for (int k = 0; k < message.envelope.arrays_size(); ++k)
    {
        v1::ArrayHeader const& header = message.envelope.arrays(k);
        if (header.dense()) continue;
        complete = false;
        CellRuns const* const needed = needed_cells(terms.needed, header.name());
        if (needed == nullptr || !contains(cells_of_array(message.envelope, k, terms.cell_count), *needed))
            refuse(describe(message) + ": array \"" + header.name() + "\" lacks cells that the server needs");
    }
    return complete;
}

}  // namespace

Message lay_out(FluidState const& state, Terms const& terms)
{
    double constexpr lowest = std::numeric_limits<double>::lowest();
    check_sent_number(state.step.time, lowest, "step.time");
    check_sent_number(state.step.dt, lowest, "step.dt");

    Message message;
    message.envelope.set_step(state.step.number);
    v1::FluidState& body = *message.envelope.mutable_fluid_state();
    body.mutable_step()->set_number(state.step.number);
    body.mutable_step()->set_time(state.step.time);
    body.mutable_step()->set_dt(state.step.dt);
    pack_monitors(state.monitors, body);
    pack_timings(state.previous, *body.mutable_previous());
    body.set_exchange(state.exchange);
    body.set_waiting(state.waiting);
    message.envelope.set_iteration(state.pass);
    check_sent_number(state.residual, 0, "residual");
    if (state.pass > 0)
        body.mutable_rewind()->set_residual(state.residual);
    else
        body.set_residual(state.residual);
    lay_out_fields(message, terms.fluid, state.fields, terms.cell_count, terms.memory,
                   {terms.encodings, &terms.needed, nullptr});
    return message;
}

Message lay_out(SolidState const& state, Terms const& terms)
{
    Message message;
    v1::SolidState& body = *message.envelope.mutable_solid_state();
    pack_timings(state.timings, *body.mutable_timings());
    body.set_busy_time(state.busy_time);
    body.set_stop_requested(state.stop_request.has_value());
    body.set_stop_reason(printable(state.stop_request.value_or("")));
    if (terms.encodings.sparse) pack_needed(state.cells.needed, body);
    lay_out_fields(message, terms.solid, state.fields, terms.cell_count, terms.memory,
                   {terms.encodings, nullptr, state.cells.solid ? &*state.cells.solid : nullptr});
    return message;
}

Message pack_fluid_wanted()
{
    Message message;
    message.envelope.mutable_fluid_wanted();
    return message;
}

FluidState unpack_fluid_state(Message const& message, Terms const& terms)
{
    v1::FluidState const& body = message.envelope.fluid_state();
    if (body.step().number() != message.envelope.step())
        refuse("FluidState: step " + std::to_string(body.step().number()) + " in an envelope of step " +
               std::to_string(message.envelope.step()));
    check_number(body.exchange(), 0, "FluidState: exchange");
    check_number(body.waiting(), 0, "FluidState: waiting");

    FluidState state;
    state.step = {body.step().number(), body.step().time(), body.step().dt()};
    check_encodings(message, terms.encodings);
    state.fields = view_fields(message, terms.fluid, terms.cell_count, terms.store);
    state.is_complete = is_complete(message, terms);
    state.monitors = unpack_monitors(body);
    state.previous = unpack_timings(body.previous());
    state.exchange = body.exchange();
    state.waiting = body.waiting();
    state.pass = message.envelope.iteration();
    if (body.has_rewind() != (state.pass > 0))
        refuse("FluidState of iteration " + std::to_string(state.pass) + (body.has_rewind() ? " with" : " without") +
               " a Rewind (just those above 0 have one)");
    state.residual = body.has_rewind() ? body.rewind().residual() : body.residual();
    check_number(state.residual, 0, "FluidState: residual");
    if (body.has_previous_times())
    {
        state.previous_times = unpack_times(body.previous_times());
        state.clock = unpack_offset(body.previous_times());
    }
    return state;
}

SolidState unpack_solid_state(Message const& message, Terms const& terms)
{
    v1::SolidState const& body = message.envelope.solid_state();
    check_number(body.busy_time(), 0, "SolidState: busy time");

    SolidState state;
    check_encodings(message, terms.encodings);
    state.fields = view_fields(message, terms.solid, terms.cell_count, terms.store);
    state.cells.needed = unpack_needed(body, terms.cell_count);
    state.timings = unpack_timings(body.timings());
    state.busy_time = body.busy_time();
    if (body.stop_requested()) state.stop_request = body.stop_reason();
    return state;
}

}  // namespace gimdem::coupling::message
