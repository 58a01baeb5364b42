// SPDX-License-Identifier: BSD-3-Clause
/// A program of C++ that couples itself and has a plugin with libgimdem_client.so: two copies of the library and of its
/// messages in one process, with a server each.
#include <gtest/gtest.h>

#include "ServerProcess.hpp"
#include "UniformFluid.hpp"
#include "gimdem/coupling/client.h"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr dt = 1e-4;  ///< [s]
int constexpr steps = 10;
Mesh const mesh = SmallCase::mesh();
std::size_t const cells = static_cast<std::size_t>(mesh.cell_count);
UniformFluid const fluid(cells, {0, 0, 1});

void expect_ok(gimdem_status status)
{
    EXPECT_EQ(status, GIMDEM_OK) << gimdem_client_last_error();
}

/// The plugin: client.h.
class Plugin
{
public:
    explicit Plugin(std::string const& endpoint)
    {
        gimdem_client_options options;
        expect_ok(gimdem_client_options_init(&options, sizeof options));
        options.endpoint = endpoint.c_str();
        options.name = "plugin";
        expect_ok(gimdem_client_create(&options, &client_));
    }
    ~Plugin() { gimdem_client_destroy(client_); }
    Plugin(Plugin const&) = delete;
    Plugin& operator=(Plugin const&) = delete;

    void open()
    {
        gimdem_fluid_properties const properties{sizeof properties, air.density, air.viscosity};
        expect_ok(gimdem_client_connect(client_, &properties, nullptr));
        std::vector<gimdem_patch> patches;
        for (Patch const& patch : mesh.patches)
            patches.push_back(
                {patch.name.c_str(), static_cast<std::int32_t>(patch.kind) + 1, patch.start_face, patch.face_count, 0});
        gimdem_mesh view{};
        view.struct_size = sizeof view;
        view.points = mesh.points.data();
        view.face_offsets = mesh.face_offsets.data();
        view.face_points = mesh.face_points.data();
        view.owner = mesh.owner.data();
        view.neighbour = mesh.neighbour.data();
        view.patches = patches.data();
        view.point_count = mesh.points.size() / 3;
        view.face_count = mesh.owner.size();
        view.internal_face_count = mesh.neighbour.size();
        view.patch_count = patches.size();
        view.cell_count = mesh.cell_count;
        expect_ok(gimdem_client_send_mesh(client_, &view));
    }

    std::vector<double> step(int n)
    {
        FluidFields const now = fluid.view();
        gimdem_step const step{sizeof step, n, dt * (n - 1), dt};
        gimdem_fluid_fields fields{};
        fields.struct_size = sizeof fields;
        fields.cell_count = cells;
        fields.velocity = now.velocity.data();
        fields.velocity_gradient = now.velocity_gradient.data();
        fields.pressure_gradient = now.pressure_gradient.data();
        fields.void_fraction_gradient = now.void_fraction_gradient.data();
        fields.pressure = now.pressure.data();
        gimdem_solid_fields solid{};
        solid.struct_size = sizeof solid;
        expect_ok(gimdem_client_begin_step(client_, &step, &fields, nullptr, 0, &solid));
        std::vector<double> momentum(solid.drag_momentum, solid.drag_momentum + 3 * solid.cell_count);
        expect_ok(gimdem_client_end_step(client_, nullptr));
        return momentum;
    }

    void finish() { expect_ok(gimdem_client_finish(client_, "all steps done")); }

private:
    gimdem_client* client_ = nullptr;
};

TEST(BothLibraries, InOneProcessTalkToAServerEachAndGetTheSame)
{
    ServerProcess host_server(unused_ipc_endpoint()), plugin_server(any_tcp_endpoint());
    ClientOptions options = client_options(host_server.endpoint());
    options.wants.clear();  // as the plugin
    Client host(std::move(options));
    Plugin plugin(plugin_server.endpoint());
    host.connect(air);
    plugin.open();
    host.send_mesh(view_of(mesh));
    for (int n = 1; n <= steps; ++n)
    {
        SolidFields const& solid = host.begin_step({n, dt * (n - 1), dt}, fluid.view());
        std::vector<double> const momentum(solid.drag_momentum.begin(), solid.drag_momentum.end());
        host.end_step();
        EXPECT_EQ(plugin.step(n), momentum) << "step " << n;
        EXPECT_GT(*std::max_element(momentum.begin(), momentum.end()), 0);
    }
    plugin.finish();
    host.finish("all steps done");
    host_server.expect_end(0, "");
    plugin_server.expect_end(0, "");
}

}  // namespace
}  // namespace gimdem::test
