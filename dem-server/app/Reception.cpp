// SPDX-License-Identifier: BSD-3-Clause
#include "app/Reception.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "app/CoupledRun.hpp"
#include "app/LogParts.hpp"
#include "core/Error.hpp"

namespace gimdem::app
{

Reception::Reception(Case const& settings, coupling::Server::CheckpointSaver saver)
    : settings_(settings), saver_(std::move(saver))
{
    open(settings.coupling.endpoint, settings.coupling.connect_time);
}

void Reception::open(std::string const& endpoint, double patience)
{
    server_.reset();  // frees the address
    server_.emplace(coupling::ServerOptions{.endpoint = endpoint,
                                            .name = "gimdem-server " GIMDEM_VERSION,
                                            .timeout = settings_.coupling.timeout,
                                            .connect_time = patience});
    server_->save_checkpoints_by(saver_);
}

coupling::ClientInfo Reception::meet()
{
    return server_->wait_for_client(terms_of(settings_));
}

bool Reception::meet_again(CoupledRun& run, double grace_time)
{
    auto const lost = std::chrono::steady_clock::now();
    sessions_.insert(server_->session_number());
    std::string const endpoint = server_->endpoint();
    for (double left = grace_time; left > 0; left = grace_time - seconds_since(lost))
    {
        try
        {
            open(endpoint, left);
            go_on(run);
            return true;
        }
        catch (std::exception const& error)
        {
            server_->abort(error.what());
            if (seconds_since(lost) < grace_time)
                fmt::print(stderr, "gimdem-server: no client has come back: {}\n", error.what());
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
    run.go_on(*server_, client);
    fmt::print(stderr, "gimdem-server: {} has come back\n", client.name);
}

}  // namespace gimdem::app
