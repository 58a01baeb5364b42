// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/MockServer.hpp"

#include <unistd.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

#include "conformance/ForceCheck.hpp"
#include "conformance/MeshGeometry.hpp"
#include "conformance/RawServer.hpp"

namespace gimdem::conformance
{
namespace
{

using namespace coupling;

template <class... Values>
std::string text(char const* format, Values... values)
{
    char buffer[400];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

/// One session by the rules, but for the one misbehaviour.
class Session
{
public:
    Session(Script const& script, FindingsFile& findings)
        : script_(script), findings_(findings), server_(options_of(script))
    {
        findings_.tell("endpoint", server_.endpoint());
    }

    bool play()
    {
        ClientInfo const client = greet();
        Mesh const mesh = server_.receive_mesh();
        MeshGeometry const geometry = measure(mesh);
        if (!judge(mesh, geometry)) return false;
        if (script_.misbehaviour == Misbehaviour::refuse_mesh)
        {
            findings_.tell("misbehaved", "");
            server_.reject_mesh(mock_reason);
            return true;
        }
        KnownSolid solid(script_.law, geometry.volumes);
        ForceCheck force(solid, client.schedule.value_or(script_.schedule));
        stage_ = "fields";
        server_.accept_mesh(solid.after(0, {}));
        std::string const cells = text("%d cells", mesh.cell_count);
        bool const ended = answer_steps(solid, force);
        findings_.pass("fields",
                       text("%d fields of ", static_cast<int>(script_.needs.size())) + cells + " in each step");
        findings_.check("steps", steps_ > 0, text("%d, contiguous, to t = %.6g s", steps_, time_));
        if (script_.schedule == Schedule::iterated)
            findings_.check("passes", passes_ > 0, text("%d steps were repeated %d times", steps_, passes_));
        if (script_.misbehaviour == Misbehaviour::none) report_end(force);
        return ended;
    }

    /// Writes down which line a fault belongs to.
    void take_fault(CouplingError const& error)
    {
        std::string const what = error.what();
        bool const about_steps = what.find("is out of order: step") != std::string::npos;
        findings_.fail(about_steps ? "steps" : stage_, what);
    }

private:
    static ServerOptions options_of(Script const& script)
    {
        ServerOptions options;
        options.endpoint = script.endpoint;
        options.name = "gimdem-mock-server";
        options.keys = script.keys;
        options.timeout = script.timeout;
        options.connect_time = script.connect_time;
        options.step_time = 600;
        return options;
    }

    ClientInfo greet()
    {
        ServerTerms terms;
        terms.title = "a mock without particles";
        terms.schedule = script_.schedule;
        terms.end_time = script_.end_time;
        terms.needs = script_.needs;
        server_.save_checkpoints_by([this](CheckpointRequest const& request) { return save(request); });
        ClientInfo client = server_.wait_for_client(terms);
        bool const has_fluid = client.fluid.density > 0 && client.fluid.viscosity > 0;
        findings_.check("handshake", has_fluid,
                        text("\"%s\", density %.6g kg/m^3, viscosity %.6g Pa s", client.name.c_str(),
                             client.fluid.density, client.fluid.viscosity));
        if (client.schedule) findings_.tell("schedule", name_of(*client.schedule));
        if (client.iterates) findings_.tell("iterates", "");
        stage_ = "mesh";
        return client;
    }

    /// Nothing moves here, so there is nothing to save.
    SavedCheckpoint save(CheckpointRequest const& request) const
    {
        SavedCheckpoint saved;
        saved.step = steps_;
        saved.time = request.time;
        saved.name = "none.h5";
        return saved;
    }

    /// A mesh that a server of particles would refuse is refused here too.
    bool judge(Mesh const& mesh, MeshGeometry const& geometry)
    {
        std::string const fault = find_fault(geometry);
        double const smallest = geometry.volumes[static_cast<std::size_t>(geometry.smallest_cell)];
        findings_.check("mesh", fault.empty(),
                        fault.empty() ? text("%d cells, closed to %.1e, the smallest of %.3g m^3", mesh.cell_count,
                                             geometry.opening, smallest)
                                      : fault);
        if (!fault.empty()) server_.reject_mesh(fault);
        return fault.empty();
    }

    /// True if the client said Goodbye.
    bool answer_steps(KnownSolid& solid, ForceCheck& force)
    {
        while (auto const fluid = server_.receive_fluid())
        {
            if (asked_to_stop_) ++steps_after_stop_;
            steps_ = static_cast<int>(fluid->step.number);
            time_ = fluid->step.time + fluid->step.dt;
            dt_ = fluid->step.dt;
            if (fluid->pass == 0) force.take(*fluid);
            passes_ += fluid->pass > 0 ? 1 : 0;
            if (fluid->step.number == script_.at && fluid->pass == 0 && !misbehave()) return false;
            server_.send_solid(solid.after(fluid->step.number, fluid->fields.velocity), {});
        }
        if (script_.misbehaviour == Misbehaviour::request_stop)
            findings_.check(
                "stop request", asked_to_stop_ && steps_after_stop_ <= 1,
                text("%d more steps after the request; \"%s\"", steps_after_stop_, server_.goodbye_reason().c_str()));
        return true;
    }

    /// False: there is no answer.
    bool misbehave()
    {
        if (script_.misbehaviour != Misbehaviour::none) findings_.tell("misbehaved", "");
        switch (script_.misbehaviour)
        {
            case Misbehaviour::request_stop:
                server_.request_stop(mock_reason);
                asked_to_stop_ = true;
                return true;
            case Misbehaviour::delay:
                std::this_thread::sleep_for(std::chrono::duration<double>(script_.delay));
                return true;
            case Misbehaviour::report_error:
                server_.abort(mock_reason);
                return false;
            case Misbehaviour::die:
                ::raise(SIGKILL);
                return false;
            case Misbehaviour::fall_silent:
                ::raise(SIGSTOP);
                return true;
            default:
                return true;
        }
    }

    void report_end(ForceCheck const& force)
    {
        force.report(findings_);
        // A step that begins before the end may go beyond it.
        bool const right = time_ >= script_.end_time * (1 - 1e-9) && time_ - dt_ < script_.end_time;
        findings_.check(
            "end time", right,
            text("it ended at %.6g s of %.6g s: \"%s\"", time_, script_.end_time, server_.goodbye_reason().c_str()));
    }

    Script const& script_;
    FindingsFile& findings_;
    Server server_;
    char const* stage_ = "handshake";
    int steps_ = 0;
    double time_ = 0;  ///< the end of the last step [s]
    double dt_ = 0;    ///< of the last step [s]
    int passes_ = 0;   ///< beyond the first of each step
    bool asked_to_stop_ = false;
    int steps_after_stop_ = 0;
};

}  // namespace

bool play(Script const& script, FindingsFile& findings)
{
    if (script.misbehaviour == Misbehaviour::wrong_version || script.misbehaviour == Misbehaviour::truncate)
        return play_raw(script, findings);
    std::unique_ptr<Session> session;
    try
    {
        session = std::make_unique<Session>(script, findings);
        return session->play();
    }
    catch (CouplingError const& error)
    {
        if (session)
            session->take_fault(error);
        else
            findings.fail("server", error.what());
        return false;
    }
}

}  // namespace gimdem::conformance
