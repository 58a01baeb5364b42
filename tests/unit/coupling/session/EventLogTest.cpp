// SPDX-License-Identifier: BSD-3-Clause
/// The structured log: whole lines of JSON, on the clock that it is told.
#include "gimdem/coupling/EventLog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <vector>

#include "Faults.hpp"
#include "Pair.hpp"
#include "gimdem/coupling/StepTimes.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

class EventLogFile : public testing::Test
{
protected:
    ~EventLogFile() override { std::filesystem::remove(file_); }

    std::vector<std::string> lines() const
    {
        std::ifstream in(file_);
        std::vector<std::string> all;
        for (std::string line; std::getline(in, line);)
            all.push_back(line);
        return all;
    }

    /// The elapsed time of a line [s].
    static double elapsed(std::string const& line)
    {
        std::smatch match;
        return std::regex_search(line, match, std::regex("\"elapsed\": (-?[0-9.]+)")) ? std::stod(match[1]) : NAN;
    }

    std::string const file_ = file_of(unused_ipc_endpoint()) + ".jsonl";
};

TEST_F(EventLogFile, HasOneObjectALine)
{
    {
        EventLog log(file_, "server");
        log.set_origin(clock_now() - 2);
        log.write(LogLevel::warning, "odd", "a \"quoted\"\nline", {{"count", 3.0}, {"who", "x"}, {"none", NAN}});
    }
    ASSERT_EQ(lines().size(), 1u);
    EXPECT_THAT(lines()[0],
                testing::MatchesRegex(
                    R"(\{"time": "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}\.[0-9]{6}Z", "elapsed": [0-9]+\.[0-9]{6}, )"
                    R"("side": "server", "level": "warning", "event": "odd", "message": "a \\"quoted\\"\\u000aline", )"
                    R"("fields": \{"count": 3, "who": "x", "none": null\}\})"));
    EXPECT_NEAR(elapsed(lines()[0]), 2, patient);
    EXPECT_GE(elapsed(lines()[0]), 2);
}

TEST_F(EventLogFile, HoldsLinesUntilItKnowsWhenTheRunBegan)
{
    EventLog log(file_, "client");
    double const start = clock_now();
    log.write(LogLevel::info, "first", "");
    EXPECT_EQ(lines().size(), 0u);
    log.set_origin(start - 100);
    EXPECT_EQ(lines().size(), 1u);
    log.write(LogLevel::info, "second", "");
    ASSERT_EQ(lines().size(), 2u);
    EXPECT_GE(elapsed(lines()[0]), 100 - 1e-6);  // printed with six decimals
    EXPECT_GE(elapsed(lines()[1]), elapsed(lines()[0]));
    EXPECT_LT(elapsed(lines()[1]), 100 + patient);
}

TEST_F(EventLogFile, IsNotLostIfTheServerIsNeverMet)
{
    {
        EventLog log(file_, "client");
        log.write(LogLevel::error, "fault", "nobody there");
    }
    ASSERT_EQ(lines().size(), 1u);
    EXPECT_EQ(elapsed(lines()[0]), 0);
}

TEST_F(EventLogFile, ThatCannotBeMadeIsRefused)
{
    EXPECT_FAULT(EventLog("/nonexistent/log.jsonl", "client"), Fault::user, "cannot be written");
}

TEST_F(EventLogFile, OfAClientIsNamedByTheEnvironmentAndOnTheServersClock)
{
    double const origin = clock_now() - 1000;
    ServerOptions options = server_options(unused_ipc_endpoint());
    options.clock_origin = origin;
    Server server(options);
    auto served = in_background(
        [&]
        {
            server.wait_for_client(server_terms());
            server.receive_mesh();
            server.accept_mesh(SolidArrays(24, 0).view());
            return server.receive_fluid().has_value();
        });
    ::setenv("GIMDEM_CLIENT_LOG", file_.c_str(), 1);
    Client client(client_options(server.endpoint()));
    ::unsetenv("GIMDEM_CLIENT_LOG");
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(small_mesh()));
    client.finish("done");
    EXPECT_FALSE(served.get());

    ASSERT_EQ(lines().size(), 3u);
    EXPECT_THAT(lines()[0], testing::HasSubstr("\"event\": \"connected\""));
    EXPECT_THAT(lines()[1], testing::HasSubstr("\"event\": \"mesh_accepted\""));
    EXPECT_THAT(lines()[2], testing::HasSubstr("\"event\": \"finished\", \"message\": \"done\""));
    for (std::string const& line : lines())
    {
        EXPECT_GT(elapsed(line), 1000);
        EXPECT_LT(elapsed(line), 1000 + patient);
    }
}

}  // namespace
}  // namespace gimdem::test
