// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "Endpoint.hpp"
#include "Exchange.hpp"
#include "FarEnd.hpp"
#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::bench
{

namespace
{

using namespace coupling;

double constexpr dt = 1e-4;  ///< [s]

MeshView view_of(Mesh const& mesh)
{
    return {mesh.points,    mesh.face_offsets, mesh.face_points, mesh.owner,
            mesh.neighbour, mesh.cell_count,   mesh.patches};
}

void serve(Way const& way, Scene const& scene, std::string const& endpoint,
           std::function<void(std::string const&)> const& tell)
{
    ServerOptions options;
    options.endpoint = endpoint;
    options.name = "exchange_times";
    options.shared_memory = way.shared_memory;
    options.encodings = way.encodings;
    Server server(options);
    tell(server.endpoint());
    server.wait_for_client({"exchange",
                            Schedule::serial,
                            1,
                            {field::velocity, field::velocity_gradient, field::pressure_gradient,
                             field::void_fraction_gradient, field::pressure}});
    server.receive_mesh();
    server.accept_mesh(scene.solid(), {}, scene.cells());
    while (server.receive_fluid())
        server.send_solid(scene.solid(), {}, scene.cells());
}

class Coupled : public Exchange
{
public:
    Coupled(Way const& way, Scene const& scene)
        : scene_(scene),
          far_end_(
              [&](auto const& tell)
              {
                  bool const ipc = way.transport == "ipc";
                  serve(way, scene, ipc ? test::unused_ipc_endpoint() : test::any_tcp_endpoint(), tell);
              }),
          way_(way)
    {
    }

    void exchange() override
    {
        if (!client_) connect();
        client_->begin_step({++step_, dt * static_cast<double>(step_ - 1), dt}, scene_.fluid());
        client_->end_step();
    }
    double bytes() const override
    {
        return (client_->exchange_times().bytes - bytes_before_) / static_cast<double>(step_);
    }

private:
    void connect()
    {
        ClientOptions options;
        options.endpoint = far_end_.endpoint();
        options.name = "exchange_times";
        options.shared_memory = way_.shared_memory;
        client_.emplace(options);
        client_->connect({1.28, 1.7e-5});
        client_->send_mesh(view_of(scene_.mesh()));
        bytes_before_ = client_->exchange_times().bytes;
    }

    Scene const& scene_;
    FarEnd far_end_;
    Way way_;
    std::optional<Client> client_;  ///< not before all ends have been forked: it has a thread
    std::int64_t step_ = 0;
    double bytes_before_ = 0;
};

}  // namespace

std::unique_ptr<Exchange> coupled(Way const& way, Scene const& scene)
{
    return std::make_unique<Coupled>(way, scene);
}

}  // namespace gimdem::bench
