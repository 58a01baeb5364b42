// SPDX-License-Identifier: BSD-3-Clause
/// A client of two ranks, one of which is killed: both come back, and the end is to the bit that of a run that nothing
/// happens to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <regex>

#include "ReturnScene.hpp"
#include "ScriptedMesh.hpp"
#include "UniformFluid.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr dt = return_dt;
int constexpr ranks = 2;

ClientOptions options_of(int rank, std::string const& endpoint, std::optional<ResumePoint> const& resume)
{
    ClientOptions options = client_options(endpoint);
    options.wants.clear();  // as the scripted client
    options.resume = resume;
    options.rank = {rank, ranks, run_number};
    return options;
}

/// Both ranks, each on a thread of its own while it may wait for the other.
class BothRanks
{
public:
    /// Rank 1 may say that it goes on elsewhere.
    BothRanks(std::string const& endpoint, std::optional<ResumePoint> const& resume,
              std::optional<ResumePoint> const& resume_of_other)
    {
        clients_.reserve(ranks);
        clients_.emplace_back(options_of(0, endpoint, resume));
        std::string const told = clients_[0].connect(air).rank_endpoints.at(0);
        clients_.emplace_back(options_of(1, told, resume_of_other));
        on_both(
            [&](int rank)
            {
                Client& client = clients_[static_cast<std::size_t>(rank)];
                if (rank > 0) client.connect(air);
                client.send_mesh(view_of(part_of_scripted_mesh({rank, ranks, run_number})));
            });
    }
    BothRanks(std::string const& endpoint, std::optional<ResumePoint> const& resume)
        : BothRanks(endpoint, resume, resume)
    {
    }

    /// Steps (from, return_steps]; rank 0 has each 20th saved.
    void run_from(int from)
    {
        on_both(
            [&](int rank)
            {
                Client& client = clients_[static_cast<std::size_t>(rank)];
                UniformFluid const fluid(scripted_mesh().cell_count / std::size_t{ranks}, {0, 0, 1});
                for (int n = from + 1; n <= return_steps; ++n)
                {
                    client.begin_step({n - from, dt * (n - 1), dt}, fluid.view());
                    client.end_step();
                    if (rank == 0 && n % 20 == 0) client.save_checkpoint(dt * (n - 1) + dt, n - 20);
                }
                client.finish("all steps done");
            });
    }

private:
    void on_both(std::function<void(int)> const& body)
    {
        auto other = std::async(std::launch::async, [&] { body(1); });
        body(0);
        other.get();
    }

    std::vector<Client> clients_;
};

/// Connects again where the socket was just being closed, as ReturnTest does.
BothRanks come_back(std::string const& endpoint, ResumePoint const& point, ResumePoint const& point_of_other)
{
    for (int k = 0;; ++k)
        try
        {
            return BothRanks(endpoint, point, point_of_other);
        }
        catch (CouplingError const& error)
        {
            bool const broke = std::string(error.what()).find("said nothing of its state") != std::string::npos;
            if (!broke || k == 20) throw;
        }
}

class RankReturn : public testing::TestWithParam<char const*>
{
protected:
    /// Kills rank 1 behind the checkpoint of step 20, which it returns.
    ResumePoint lose_rank(ServerProcess& server)
    {
        auto const command = [](std::string const& endpoint, char const* rank) -> std::vector<std::string>
        { return {GIMDEM_SCRIPTED_CLIENT, endpoint, "40", std::to_string(return_steps), "", "20", rank, "2"}; };
        Process first(command(server.endpoint(), "0"), folder / "rank0.txt");
        std::smatch told;
        EXPECT_TRUE(first.wait_for_output("the next rank at ", soon)) << first.output();
        std::string endpoint;
        wait_until(
            [&]
            {
                std::string const output = first.output();
                bool const found = std::regex_search(output, told, std::regex("the next rank at (.*)\n"));
                if (found) endpoint = told[1];
                return found;
            },
            soon);
        Process second(command(endpoint, "1"), folder / "rank1.txt");
        EXPECT_TRUE(second.wait_for_output("step 33\n", soon)) << second.output();
        second.signal(SIGKILL);
        EXPECT_EQ(first.wait(soon), 1) << "rank 0 must end too";
        std::string const output = first.output();
        EXPECT_THAT(output, testing::AllOf(testing::HasSubstr("rank 1 of 2"), testing::HasSubstr("has disappeared")));
        EXPECT_TRUE(server.process().wait_for_output("for a client that goes on", soon));
        EXPECT_TRUE(std::regex_search(output, told, std::regex("saved step 20 of session (\\d+)"))) << output;
        return {std::stoull(told[1]), 20, 20 * dt};
    }

    TemporaryFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Over, RankReturn, testing::Values("ipc", "tcp"),
                         [](auto const& transport) { return std::string(transport.param); });

TEST_P(RankReturn, OfAllEndsToTheBitAsIfNoneHadBeenLost)
{
    ServerProcess whole(endpoint_over(GetParam()), with_grace("0"));
    BothRanks(whole.endpoint(), {}).run_from(0);
    whole.expect_end(0, "");

    ServerProcess server(endpoint_over(GetParam()), with_grace("40"));
    ResumePoint const point = lose_rank(server);
    come_back(server.endpoint(), point, point).run_from(20);
    server.expect_end(0, "has come back");

    EXPECT_EQ(server.checkpoints().back().filename(), "step_000000060_at_0.006.h5");
    EXPECT_EQ(bytes_of(server.checkpoints().back()), bytes_of(whole.checkpoints().back()));
    EXPECT_EQ(bytes_of(server.result("bed.csv")), bytes_of(whole.result("bed.csv")));
}

TEST_P(RankReturn, IsForRanksThatGoOnFromOneCheckpoint)
{
    ServerProcess server(endpoint_over(GetParam()), with_grace("40"));
    ResumePoint const point = lose_rank(server);
    ResumePoint other = point;
    other.step = 40;

    try
    {
        come_back(server.endpoint(), point, other);
        ADD_FAILURE() << "was welcomed";
    }
    catch (CouplingError const& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr("it goes on from step 40"));
    }

    come_back(server.endpoint(), point, point).run_from(20);
    server.expect_end(0, "has come back");
}

TEST_P(RankReturn, HasItsTime)
{
    ServerProcess server(endpoint_over(GetParam()), with_grace("0.5"));
    lose_rank(server);
    server.expect_end(1, "rank 1 of 2\"");
    EXPECT_THAT(server.process().output(), testing::HasSubstr("no client has come back"));
}

}  // namespace
}  // namespace gimdem::test
