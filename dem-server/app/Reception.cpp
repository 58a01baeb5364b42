// SPDX-License-Identifier: BSD-3-Clause
#include "app/Reception.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/CoupledRun.hpp"
#include "app/LogParts.hpp"
#include "app/Terms.hpp"
#include "core/Error.hpp"

namespace gimdem::app
{

namespace
{

coupling::Encodings encodings_of(CouplingSettings const& settings)
{
    auto const has = [&](char const* name)
    { return std::find(settings.encodings.begin(), settings.encodings.end(), name) != settings.encodings.end(); };
    return {.sparse = has("sparse"), .float32 = has("float32"), .lz4 = has("lz4")};
}

}  // namespace

Reception::Reception(Case const& settings, std::filesystem::path const& folder, RunEvents& events,
                     coupling::Server::CheckpointSaver saver)
    : settings_(settings), folder_(std::filesystem::absolute(folder)), events_(events), saver_(std::move(saver))
{
    open(settings.coupling.endpoint, settings.coupling.connect_time);
}

void Reception::open(std::string const& endpoint, double patience)
{
    server_.reset();  // frees the address
    server_.emplace(
        coupling::ServerOptions{.endpoint = endpoint,
                                .name = "gimdem-server " GIMDEM_VERSION,
                                .timeout = settings_.coupling.timeout,
                                .connect_time = patience,
                                .encodings = encodings_of(settings_.coupling),
                                .keys = settings_.coupling.keys,
                                .log = [events = &events_](std::string const& text) { events->warn("coupling", text); },
                                .clock_origin = clock_origin()});
    server_->save_checkpoints_by(saver_);
    server_->publish({.title = settings_.title,
                      .activity = "waiting for a client",
                      .folder = folder_.string(),
                      .schedule = settings_.coupling.schedule,
                      .end_time = settings_.run.until,
                      .figures = {}});
}

coupling::ClientInfo Reception::meet()
{
    return server_->wait_for_client(terms_of(settings_));
}

bool Reception::meet_again(CoupledRun& run, double grace_time, std::string const& reason)
{
    auto const lost = std::chrono::steady_clock::now();
    sessions_.insert(server_->session_number());
    std::string const endpoint = server_->endpoint();
    for (double left = grace_time; left > 0; left = grace_time - seconds_since(lost))
    {
        try
        {
            open(endpoint, left);
            if (left == grace_time)  // only now may somebody come
                events_.say("client_lost",
                            fmt::format("{}; waiting {:g} s for a client that goes on", reason, grace_time));
            go_on(run);
            return true;
        }
        catch (std::exception const& error)
        {
            if (!server_)  // the address is taken
            {
                server_.emplace(coupling::ServerOptions{
                    .endpoint = "tcp://127.0.0.1:*", .name = "gimdem-server", .keys = {}, .log = {}});
                throw;
            }
            server_->abort(error.what());
            events_.warn("nobody_came_back", fmt::format("no client has come back: {}", error.what()));
        }
    }
    return false;
}

void Reception::go_on(CoupledRun& run)
{
    coupling::ClientInfo const client = meet();
    if (!client.resume)
        throw UserError(
            fmt::format("{} begins a run (this server waits for a client that goes on with one); use "
                        "another endpoint, or let it go on from a checkpoint",
                        client.name));
    if (!sessions_.contains(client.resume->session))
        throw UserError(
            fmt::format("{} goes on from a checkpoint of session {} (it is not of this run); use another "
                        "endpoint, or restart the server from that checkpoint",
                        client.name, client.resume->session));
    run.go_on(client);
    events_.say("client_came_back", fmt::format("{} has come back", client.name), {{"client", client.name}});
}

}  // namespace gimdem::app
