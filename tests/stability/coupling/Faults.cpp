// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "Endpoint.hpp"
#include "Figure.hpp"
#include "Process.hpp"
#include "ProcessMeters.hpp"
#include "RawMessages.hpp"
#include "Relay.hpp"
#include "SessionScript.hpp"
#include "SharedMemoryNames.hpp"
#include "Storm.hpp"
#include "TemporaryFolder.hpp"

namespace gimdem::test
{
namespace
{

using coupling::Fault;

double constexpr short_timeout = 1;  ///< of the faults that wait for one [s]
double constexpr long_timeout = 30;  ///< of those that must not see one, on a busy machine [s]
/// After this somebody hangs: longer than any time-out of the peers, and than a busy machine keeps them waiting [s].
double constexpr hang = 90;
char const* const endless = "1000000000";

/// How a process ended: the fault it told, or none.
struct End
{
    int code = 0;
    std::string reason;  ///< after "fault <number>: "
    std::optional<Fault> fault;
};

/// One fault: two processes, and what is wrong with how they end.
class Scene
{
public:
    Scene(std::mt19937& random, TemporaryFolder const& folder) : random_(random), folder_(folder) {}

    std::vector<std::string> problems;

    bool coin() { return random_() % 2 == 0; }
    int any(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    unsigned number() { return static_cast<unsigned>(random_()); }
    void nap(int most_milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(any(most_milliseconds))); }

    std::string start_server(double timeout, bool ipc, std::string const& answer_time = "0",
                             double connect_time = appears_in)
    {
        given_ = ipc ? unused_ipc_endpoint() : any_tcp_endpoint();
        server.emplace(std::vector<std::string>{GIMDEM_COUPLING_PEER, "server", given_, std::to_string(timeout),
                                                answer_time, std::to_string(connect_time)},
                       folder_ / "server.txt");
        std::string const before = "bound to ";
        expect(server->wait_for_output("\n", appears_in), "the server did not start");
        std::string const output = server->output();
        auto const at = output.find(before);
        if (at == std::string::npos) return "";
        return output.substr(at + before.size(), output.find('\n', at) - at - before.size());
    }
    void start_client(std::string const& endpoint, double timeout, std::string const& steps,
                      std::string const& step_time = "0", double connect_time = appears_in)
    {
        client.emplace(std::vector<std::string>{GIMDEM_COUPLING_PEER, "client", endpoint, std::to_string(timeout),
                                                steps, step_time, std::to_string(connect_time)},
                       folder_ / "client.txt");
    }
    void wait_for_step(int step)
    {
        expect(client->wait_for_output("step " + std::to_string(step) + "\n", appears_in), "the client makes no steps");
    }

    /// Waits for the end, which must come, and for a reason.
    End end_of(Process& process, char const* who)
    {
        auto const code = process.wait(hang);
        if (!code) return problem(std::string("hang: the ") + who + " does not end"), End{};
        End end{*code, process.output(), std::nullopt};
        auto const at = end.reason.find("fault ");
        if (end.code == 1 && at != std::string::npos)
        {
            end.fault = static_cast<Fault>(end.reason[at + 6] - '0');
            end.reason = end.reason.substr(at + 9);
        }
        bool const crashed = end.code > 1 && end.code != 128 + SIGKILL;
        expect(!crashed, fmt::format("the {} crashed with {}: {}", who, end.code, end.reason));
        expect(end.code != 1 || (end.fault && end.reason.size() > 40),
               fmt::format("the {} ended without a reason: {}", who, end.reason));
        return end;
    }
    End end_of_server() { return end_of(*server, "server"); }
    End end_of_client() { return end_of(*client, "client"); }

    void expect(bool holds, std::string const& otherwise)
    {
        if (!holds) problem(otherwise);
    }
    void expect_fault(End const& end, std::vector<Fault> const& allowed, char const* who)
    {
        bool const fits = end.fault && std::find(allowed.begin(), allowed.end(), *end.fault) != allowed.end();
        expect(fits, fmt::format("the {} tells a fault that does not fit: code {}, {}", who, end.code, end.reason));
    }

    /// Nothing is left of a server that could still tidy up, nor of memory that both had mapped.
    void expect_tidy(bool server_tidies)
    {
        bool const ipc = given_.rfind("ipc", 0) == 0;
        auto const exists = [](std::string const& file) { return std::filesystem::exists(file); };
        if (ipc && server_tidies)
            expect(!exists(file_of(given_)) && !exists(file_of(given_) + ".lock"), "a socket file is left");
        for (auto const* process : {&server, &client})
            if (*process) expect(shared_memory_names((*process)->id()).empty(), "shared memory is left");
        if (ipc && !server_tidies)
            for (std::string const& file : {file_of(given_), file_of(given_) + ".lock"})
                std::filesystem::remove(file);
    }

    std::optional<Process> server;
    std::optional<Process> client;

private:
    void problem(std::string const& text) { problems.push_back(text); }

    std::mt19937& random_;
    TemporaryFolder const& folder_;
    std::string given_;
};

/// SIGKILL for either, at any time of the run.
void kill_one(Scene& scene)
{
    scene.start_client(scene.start_server(long_timeout, scene.coin()), long_timeout, endless);
    scene.wait_for_step(1);
    scene.nap(30);
    bool const server_dies = scene.coin();
    (server_dies ? scene.server : scene.client)->signal(SIGKILL);
    End const end = server_dies ? scene.end_of_client() : scene.end_of_server();
    scene.expect_fault(end, {Fault::peer}, server_dies ? "client" : "server");
    static_cast<void>(server_dies ? scene.end_of_server() : scene.end_of_client());
    scene.expect_tidy(!server_dies);
}

/// SIGKILL while they greet each other; who has not yet spoken is waited for.
void kill_early(Scene& scene)
{
    std::string const endpoint = scene.start_server(long_timeout, scene.coin(), "0", short_timeout);
    scene.start_client(endpoint, long_timeout, endless, "0", short_timeout);
    scene.nap(20);
    bool const server_dies = scene.coin();
    (server_dies ? scene.server : scene.client)->signal(SIGKILL);
    // The one that is left may wait for a peer that never comes: it has connect_time for that.
    End const end = server_dies ? scene.end_of_client() : scene.end_of_server();
    scene.expect_fault(end, {Fault::peer, server_dies ? Fault::endpoint : Fault::timeout},
                       server_dies ? "client" : "server");
    static_cast<void>(server_dies ? scene.end_of_server() : scene.end_of_client());
}

/// SIGSTOP for longer than the time-out: the other ends, and the stopped one hears why once it goes on.
void stop_one(Scene& scene)
{
    scene.start_client(scene.start_server(short_timeout, scene.coin()), short_timeout, endless);
    scene.wait_for_step(1);
    scene.nap(30);
    bool const server_stops = scene.coin();
    Process& stopped = server_stops ? *scene.server : *scene.client;
    stopped.signal(SIGSTOP);
    End const end = server_stops ? scene.end_of_client() : scene.end_of_server();
    scene.expect_fault(end, {Fault::timeout}, server_stops ? "client" : "server");
    stopped.signal(SIGCONT);
    End const other = server_stops ? scene.end_of_server() : scene.end_of_client();
    scene.expect_fault(other, {Fault::peer, Fault::timeout}, "stopped one");
    scene.expect_tidy(true);
}

/// A step that takes longer than the time-out is no fault: heartbeats tell that the slow one lives.
void be_slow(Scene& scene)
{
    std::string const slow = std::to_string(static_cast<int>(1500 * short_timeout));
    bool const server_is_slow = scene.coin();
    // The time-out of the slow one's peer matters; on a busy machine the other needs patience.
    std::string const endpoint = scene.start_server(server_is_slow ? long_timeout : 3 * short_timeout, scene.coin(),
                                                    server_is_slow ? slow : "0");
    scene.start_client(endpoint, server_is_slow ? 3 * short_timeout : long_timeout, "1", server_is_slow ? "0" : slow);
    scene.expect(scene.end_of_client().code == 0, "the client ended for a slow step");
    scene.expect(scene.end_of_server().code == 0, "the server ended for a slow step");
    scene.expect_tidy(true);
}

/// A client that greets and then neither reads nor speaks.
void read_nothing(Scene& scene)
{
    std::string const endpoint = scene.start_server(short_timeout, scene.coin());
    RawPeer deaf = RawPeer::client(endpoint);
    deaf.send(raw_hello());
    scene.expect_fault(scene.end_of_server(), {Fault::timeout}, "server");
    scene.expect_tidy(true);
}

/// One message is damaged on its way. Wrong numbers in a field look like right ones; all else must be noticed.
void damage_message(Scene& scene)
{
    auto const kind = static_cast<Relay::Damage>(scene.any(5));
    std::string const server = scene.start_server(long_timeout, false);
    {
        Relay relay(server, kind, 1 + scene.any(12), scene.number());
        scene.start_client(relay.endpoint(), long_timeout, "20");
        End const client = scene.end_of_client();
        scene.expect(relay.has_damaged() || client.code == 0, "the client ended before the damage: " + client.reason);
        if (client.code != 0)
            scene.expect_fault(client, {Fault::protocol, Fault::peer, Fault::version, Fault::timeout, Fault::endpoint},
                               "client");
    }
    End const end = scene.end_of_server();
    if (end.code != 0)
        scene.expect_fault(end, {Fault::protocol, Fault::peer, Fault::version, Fault::timeout}, "server");
    scene.expect_tidy(true);
}

/// Strangers talk to the server during a run: it goes on to its end.
void disturb(Scene& scene)
{
    std::string const endpoint = scene.start_server(long_timeout, scene.coin());
    scene.start_client(endpoint, long_timeout, "100", "2");
    scene.wait_for_step(1);
    RawPeer second = RawPeer::client(endpoint);
    second.send(raw_hello());
    scene.expect(second.receive_error(appears_in).find("busy") != std::string::npos, "a second client is not refused");
    RawPeer noisy = RawPeer::client(endpoint);
    for (int n = 0; n < 50; ++n)
        noisy.send_frames(std::vector<std::string>(1 + scene.number() % 4, std::string(scene.number() % 10000, 'x')));
    scene.expect(scene.end_of_client().code == 0, "strangers ended the client");
    scene.expect(scene.end_of_server().code == 0, "strangers ended the server");
    scene.expect_tidy(true);
}

struct Kind
{
    char const* name;
    void (*run)(Scene&);
};
std::array<Kind, 7> constexpr kinds{{{"kill", kill_one},
                                     {"early kill", kill_early},
                                     {"stop", stop_one},
                                     {"slow step", be_slow},
                                     {"deaf client", read_nothing},
                                     {"damaged message", damage_message},
                                     {"strangers", disturb}}};

}  // namespace

int run_faults(int count, unsigned seed)
{
    std::mt19937 random(seed);
    TemporaryFolder const folder;
    double const descriptors = file_descriptors();
    std::map<std::string, int> survived;
    int wrong = 0;
    for (int n = 0; n < count; ++n)
    {
        // Each kind once, then as chance has it.
        std::size_t const which =
            static_cast<std::size_t>(n) < kinds.size() ? static_cast<std::size_t>(n) : random() % kinds.size();
        std::mt19937 own(random());
        Scene scene(own, folder);
        kinds[which].run(scene);
        for (std::string const& problem : scene.problems)
            fmt::print("wrong: fault {} ({}): {}\n", n, kinds[which].name, problem);
        scene.problems.empty() ? ++survived[kinds[which].name] : ++wrong;
    }
    for (auto const& [name, times] : survived)
        fmt::print("{:>4} x {}\n", times, name);
    figure("faults_survived", count - wrong);
    figure("faults", count);
    figure("faults_file_descriptors_growth", file_descriptors() - descriptors);
    return wrong;
}

}  // namespace gimdem::test
