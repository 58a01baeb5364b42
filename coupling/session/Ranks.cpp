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

std::string start_of(ClientInfo const& client)
{
    if (!client.resume) return "begins a run";
    return "goes on from step " + std::to_string(client.resume->step) + " of session " +
           std::to_string(client.resume->session) + " at " + message::number_text(client.resume->time) + " s";
}

/// Between the Hello of a rank and that of rank 0, and what to do; empty if there is none.
std::optional<std::string> find_difference(ClientInfo const& other, ClientInfo const& first)
{
    bool const is_same = other.name == first.name && other.fluid.density == first.fluid.density &&
                         other.fluid.viscosity == first.fluid.viscosity && other.wants == first.wants &&
                         other.schedule == first.schedule;
    if (!is_same) return "(name, fluid, fields or schedule); the ranks must solve one case";
    if (other.resume == first.resume) return std::nullopt;
    return "(it " + start_of(other) + ", rank 0 " + start_of(first) + "); start all ranks from one checkpoint";
}

}  // namespace

std::string rank_text(std::size_t rank)
{
    return "rank " + std::to_string(rank);
}

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

/// Where a rank's session has ended, those of the others end too.
void Ranks::end_all(std::string const& reason) noexcept
{
    if (!has_failed()) return;
    has_lost_client_ =
        std::any_of(parts_.begin(), parts_.end(), [](Exchange const* part) { return part->has_lost_client(); });
    abort(Fault::peer, reason);
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
                if (auto const difference = find_difference(info, first))
                    fail(Fault::protocol, "the Hello of " + rank_text(rank) + " of " + name_ +
                                              " differs from that of rank 0 " + *difference);
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
                cells_ = RankCells(std::move(merged.first_cell), wants_);
                return std::move(merged.mesh);
            }
            catch (CouplingError const& error)
            {
                fail(error.fault(), "the ranks of " + name_ + " have meshes that do not fit together: " + error.what());
            }
        });
}

void Ranks::accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells)
{
    cells_.check(initial);
    forward_stop();
    together(
        [&]
        {
            for (std::size_t rank = 0; rank < parts_.size(); ++rank)
                parts_[rank]->accept_mesh(cells_.cut(initial, rank), timings, cells_.cut(cells, rank));
        });
}

void Ranks::wake_client()
{
    for (Exchange* const part : parts_)
        part->wake_client();
}

void Ranks::request_stop(std::string const& reason)
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    stop_ = reason;
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

}  // namespace gimdem::coupling::session
