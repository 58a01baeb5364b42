// SPDX-License-Identifier: BSD-3-Clause
#include "session/Ranks.hpp"

#include <algorithm>
#include <utility>

#include "message/MeshMerge.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::session
{
namespace
{

std::string rank_text(std::size_t rank)
{
    return "rank " + std::to_string(rank);
}

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

}  // namespace

std::string endpoint_of_rank(std::string const& endpoint, std::int32_t rank)
{
    bool const is_ipc = endpoint.rfind("ipc://", 0) == 0;
    return is_ipc ? endpoint + "." + std::to_string(rank) : endpoint.substr(0, endpoint.rfind(':')) + ":*";
}

Ranks::Ranks(Exchange& first, Parts others) : parts_(1, &first), others_(std::move(others))
{
    for (auto const& part : others_)
        parts_.push_back(part.get());
    set_watch([] {});
}

std::vector<std::string> Ranks::endpoints() const
{
    std::vector<std::string> names;
    for (auto const& part : others_)
        names.push_back(part->endpoint());
    return names;
}

/// Runs a call; if one rank's session ends in it, so do the others, with the same reason.
template <class Body>
auto Ranks::together(Body body) -> decltype(body())
{
    try
    {
        return body();
    }
    catch (CouplingError const& error)
    {
        if (has_failed()) abort(Fault::peer, error.what());
        throw;
    }
}

void Ranks::fail(Fault fault, std::string const& text)
{
    abort(fault, text);
    throw CouplingError(fault, text);
}

void Ranks::wait_for_others(ClientInfo const& first, ServerTerms const& terms)
{
    name_ = "client \"" + first.name + "\"";
    wants_ = message::choose_solid_fields(first.wants, Fault::protocol);
    together(
        [&]
        {
            for (std::size_t rank = 1; rank < parts_.size(); ++rank)
            {
                ClientInfo const info = parts_[rank]->wait_for_client(terms);
                bool const same = info.name == first.name && info.fluid.density == first.fluid.density &&
                                  info.fluid.viscosity == first.fluid.viscosity && info.wants == first.wants &&
                                  info.schedule == first.schedule;
                if (!same)
                    fail(Fault::protocol, "the Hello of " + rank_text(rank) + " of " + name_ +
                                              " differs from that of rank 0 (name, fluid, fields or schedule); the "
                                              "ranks must solve one case");
            }
        });
}

Mesh Ranks::receive_mesh()
{
    return together(
        [&]
        {
            std::vector<Mesh> meshes;
            for (Exchange* const part : parts_)
                meshes.push_back(part->receive_mesh());
            try
            {
                message::MergedMesh merged = message::merge_meshes(meshes);
                first_cell_ = std::move(merged.first_cell);
                return std::move(merged.mesh);
            }
            catch (CouplingError const& error)
            {
                fail(error.fault(), "the ranks of " + name_ + " have meshes that do not fit together: " + error.what());
            }
        });
}

void Ranks::accept_mesh(SolidFields const& initial, Timings const& timings)
{
    check_solid(initial);
    forward_stop();
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->accept_mesh(cut(initial, rank), timings);
        });
}

std::optional<FluidState> Ranks::receive_fluid()
{
    return together(
        [&]() -> std::optional<FluidState>
        {
            std::vector<FluidState> states;
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
            {
                auto state = parts_[rank]->receive_fluid();
                if (rank > 0 && state.has_value() == states.empty())
                    fail(Fault::protocol, name_ + " is out of order: " + rank_text(state ? 0 : rank) +
                                              " said goodbye, but " + rank_text(state ? rank : 0) +
                                              " began a step (all ranks must take the same steps)");
                if (state) states.push_back(*std::move(state));
            }
            if (states.empty()) return std::nullopt;
            check_same_step(states);

            FluidState whole = states.front();
            for (FluidState const& state : states)
            {
                take_longest(whole.previous, state.previous);
                whole.exchange = std::max(whole.exchange, state.exchange);
                whole.waiting = std::max(whole.waiting, state.waiting);
            }
            whole.fields = join(states);
            return whole;
        });
}

void Ranks::check_same_step(std::vector<FluidState> const& states)
{
    for (std::size_t rank = 1; rank < states.size(); ++rank)
        if (!is_same(states[rank], states[0]))
            fail(Fault::protocol, name_ + " is out of order: rank 0 sent " + text_of(states[0]) + ", " +
                                      rank_text(rank) + " " + text_of(states[rank]) +
                                      " (all ranks must take the same steps)");
}

void Ranks::send_solid(SolidFields const& fields, Timings const& timings)
{
    check_solid(fields);
    forward_stop();
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->send_solid(cut(fields, rank), timings);
        });
}

void Ranks::request_stop(std::string const& reason)
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    stop_ = reason;
}

/// Before a solid is sent, so that all ranks learn of a stop at the same step.
void Ranks::forward_stop()
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    if (!stop_) return;
    for (Exchange* const part : parts_)
        part->request_stop(*stop_);
}

void Ranks::abort(Fault fault, std::string const& reason) noexcept
{
    for (Exchange* const part : parts_)
        part->abort(fault, reason);
}

std::string const& Ranks::shared_memory_note() const
{
    for (Exchange const* const part : parts_)
        if (!part->shared_memory_note().empty()) return part->shared_memory_note();
    return parts_.front()->shared_memory_note();
}

double Ranks::bytes() const
{
    double sum = 0;
    for (Exchange const* const part : parts_)
        sum += part->bytes();
    return sum;
}

/// Each rank watches the others meanwhile.
void Ranks::set_watch(std::function<void()> watch)
{
    for (Exchange* const part : parts_)
        part->set_watch(
            [this, part, watch]
            {
                for (Exchange* const other : parts_)
                    if (other != part) other->look_for_loss();
                watch();
            });
}

void Ranks::look_for_loss()
{
    for (Exchange* const part : parts_)
        part->look_for_loss();
}

bool Ranks::has_failed() const
{
    return std::any_of(parts_.begin(), parts_.end(), [](Exchange const* part) { return part->has_failed(); });
}

std::size_t Ranks::cells_of(std::size_t rank) const
{
    return static_cast<std::size_t>(first_cell_[rank + 1] - first_cell_[rank]);
}

/// Fault::user, before any rank gets its part.
void Ranks::check_solid(SolidFields const& fields) const
{
    if (!first_cell_.empty()) message::check_fields(wants_, fields, static_cast<std::size_t>(first_cell_.back()));
}

SolidFields Ranks::cut(SolidFields const& whole, std::size_t rank) const
{
    SolidFields part;
    for (auto const& entry : wants_)
    {
        auto const first = static_cast<std::size_t>(first_cell_[rank]) * entry.components;
        part.*entry.values = {(whole.*entry.values).data() + first, cells_of(rank) * entry.components};
    }
    return part;
}

FluidFields Ranks::join(std::vector<FluidState> const& states)
{
    FluidFields whole;
    for (auto const& entry : message::fluid_fields)
    {
        if ((states.front().fields.*entry.values).empty()) continue;
        std::vector<double>& values = fluid_[entry.name];
        values.resize(static_cast<std::size_t>(first_cell_.back()) * entry.components);
        for (std::size_t rank = 0; rank < states.size(); ++rank)
        {
            Span<double const> const part = states[rank].fields.*entry.values;
            auto const first = static_cast<std::ptrdiff_t>(first_cell_[rank]) * entry.components;
            std::copy(part.begin(), part.end(), values.begin() + first);
        }
        whole.*entry.values = values;
    }
    return whole;
}

}  // namespace gimdem::coupling::session
