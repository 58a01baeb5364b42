// SPDX-License-Identifier: BSD-3-Clause
#include "output/StepTrace.hpp"

#include <algorithm>

namespace gimdem::output
{

namespace
{

int constexpr server_row = 1, client_row = 2;

void add_if_any(std::vector<Slice>& slices, std::string_view name, double from, double to)
{
    if (to > from) slices.push_back({name, from, to});
}

/// A call of the client, which may have been blocked for a part of it.
void add_call(std::vector<Slice>& slices, double from, double to, double wait_from, double wait_to)
{
    double const begin = std::clamp(wait_from, from, to), end = std::clamp(wait_to, from, to);
    add_if_any(slices, "exchange", from, begin);
    add_if_any(slices, "waiting", begin, end);
    add_if_any(slices, "exchange", end, to);
}

}  // namespace

std::vector<Slice> slices_of(ServerStep const& step)
{
    coupling::ServerTimes const& at = step.times;
    double const heard = std::clamp(at.arrived, at.asked, at.handed_out);
    double const moved = step.computing + step.timings.compute;
    std::vector<Slice> slices;
    add_if_any(slices, "waiting", at.asked, heard);
    add_if_any(slices, "exchange", heard, at.handed_out);
    add_if_any(slices, "output", at.handed_out, at.handed_out + step.timings.output);
    add_if_any(slices, "DEM", step.computing, moved);
    add_if_any(slices, "mapping", moved, moved + step.timings.mapping);
    add_if_any(slices, "exchange", at.answering, at.answered);
    add_if_any(slices, "records", at.answered, step.done);
    return slices;
}

std::vector<Slice> slices_of(coupling::ClientTimes const& times, coupling::Timings const& timings,
                             coupling::ClockOffset const& clock)
{
    std::vector<Slice> slices;
    auto const server_clock = [&](double time) { return time - clock.offset; };
    double const begun = server_clock(times.begun), resumed = server_clock(times.resumed);
    double const ended = server_clock(times.ended), closed = server_clock(times.closed);
    double const wait_from = server_clock(times.wait_from), wait_to = server_clock(times.wait_to);
    bool const told = timings.compute > 0;
    double const solved = told ? std::min(ended, resumed + timings.compute) : ended;

    add_call(slices, begun, resumed, wait_from, wait_to);
    add_if_any(slices, "CFD", resumed, solved);
    add_if_any(slices, "output", solved, std::min(ended, solved + timings.output));
    add_call(slices, ended, closed, wait_from, wait_to);
    return slices;
}

StepTrace::StepTrace(std::filesystem::path const& file, double origin, TraceChoice const& choice,
                     std::string const& client)
    : file_(file, origin), choice_(choice)
{
    file_.name_process(server_row, "gimdem-server");
    file_.name_process(client_row, "client " + client);
    file_.flush();
}

bool StepTrace::wants(std::int64_t step) const
{
    std::int64_t const later = step - (first_ > 0 ? first_ : step);
    return step > 0 && later >= 0 && later % choice_.every == 0 && later / choice_.every < choice_.steps;
}

void StepTrace::add(ServerStep const& step, std::vector<Counter> const& counters)
{
    if (!wants(step.number)) return;
    if (first_ == 0) first_ = step.number;
    double const start = coupling::clock_now();
    add_slices(server_row, slices_of(step), step.times.asked, step.done, step.number);
    for (Counter const& counter : counters)
        file_.counter(server_row, counter.name, step.times.answered, counter.value);
    file_.flush();
    cost_ += coupling::clock_now() - start;
}

void StepTrace::add(coupling::ClientTimes const& times, coupling::Timings const& timings,
                    coupling::ClockOffset const& clock)
{
    if (!wants(times.step)) return;
    double const start = coupling::clock_now();
    add_slices(client_row, slices_of(times, timings, clock), times.begun - clock.offset, times.closed - clock.offset,
               times.step);
    cost_ += coupling::clock_now() - start;
}

void StepTrace::add_slices(int process, std::vector<Slice> const& slices, double from, double to, std::int64_t step)
{
    file_.slice(process, "step", from, to, step);
    for (Slice const& slice : slices)
        file_.slice(process, slice.name, slice.from, slice.to, step);
}

}  // namespace gimdem::output
