// SPDX-License-Identifier: BSD-3-Clause
/// Fluid and solid of each step, of all ranks.
#include <algorithm>
#include <utility>

#include "message/Message.hpp"
#include "session/Ranks.hpp"

namespace gimdem::coupling::session
{
namespace
{

bool is_same(FluidState const& a, FluidState const& b)
{
    return a.step.number == b.step.number && a.step.time == b.step.time && a.step.dt == b.step.dt && a.pass == b.pass;
}

std::string text_of(FluidState const& state)
{
    return (state.pass > 0 ? "pass " + std::to_string(state.pass) + " of step " : "step ") +
           std::to_string(state.step.number) + " at " + message::number_text(state.step.time) +
           " s with dt = " + message::number_text(state.step.dt) + " s";
}

void take_longest(Timings& longest, Timings const& timings)
{
    longest.compute = std::max(longest.compute, timings.compute);
    longest.mapping = std::max(longest.mapping, timings.mapping);
    longest.output = std::max(longest.output, timings.output);
}

std::vector<FluidFields> fields_of(std::vector<FluidState> const& states)
{
    std::vector<FluidFields> fields;
    for (FluidState const& state : states)
        fields.push_back(state.fields);
    return fields;
}

}  // namespace

std::optional<FluidState> Ranks::receive_fluid()
{
    return together(
        [&]() -> std::optional<FluidState>
        {
            fluids_ = receive_fluids();
            if (fluids_.empty()) return std::nullopt;
            check_same_step(fluids_);

            FluidState whole = fluids_.front();
            for (FluidState const& fluid : fluids_)
            {
                take_longest(whole.previous, fluid.previous);
                whole.exchange = std::max(whole.exchange, fluid.exchange);
                whole.waiting = std::max(whole.waiting, fluid.waiting);
                whole.is_complete &= fluid.is_complete;
            }
            whole.fields = cells_.join(fields_of(fluids_));
            return whole;
        });
}

/// One of each rank; none if all have said goodbye.
std::vector<FluidState> Ranks::receive_fluids()
{
    std::vector<FluidState> fluids;
    for (std::size_t rank = 0; rank < parts_.size(); ++rank)
    {
        auto fluid = parts_[rank]->receive_fluid();
        if (rank > 0 && fluid.has_value() == fluids.empty())
            fail(Fault::protocol, name_ + " is out of order: " + rank_text(fluid ? 0 : rank) + " said goodbye, but " +
                                      rank_text(fluid ? rank : 0) +
                                      " began a step (all ranks must take the same steps)");
        if (fluid) fluids.push_back(*std::move(fluid));
    }
    return fluids;
}

/// Only ranks that left cells out are asked.
void Ranks::ask_for_whole(FluidState const& fluid)
{
    if (fluid.is_complete) return;
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->ask_for_whole(fluids_[rank]);
        });
}

void Ranks::take_whole(FluidState& fluid)
{
    if (fluid.is_complete) return;
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->take_whole(fluids_[rank]);
        });
    fluid.fields = cells_.join(fields_of(fluids_));
    fluid.is_complete = true;
}

void Ranks::check_same_step(std::vector<FluidState> const& states)
{
    for (std::size_t rank = 1; rank < states.size(); ++rank)
        if (!is_same(states[rank], states[0]))
            fail(Fault::protocol, name_ + " is out of order: rank 0 sent " + text_of(states[0]) + ", " +
                                      rank_text(rank) + " " + text_of(states[rank]) +
                                      " (all ranks must take the same steps)");
}

void Ranks::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    cells_.check(fields);
    forward_stop();
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->send_solid(cells_.cut(fields, rank), timings, cells_.cut(cells, rank));
        });
}

/// Before a solid is sent, so that all ranks learn of a stop at the same step.
void Ranks::forward_stop()
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    if (!stop_) return;
    for (Exchange* const part : parts_)
        part->request_stop(*stop_);
}

}  // namespace gimdem::coupling::session
