// SPDX-License-Identifier: BSD-3-Clause
#include "output/Progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace
{

using namespace gimdem::output;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

/// A stream into memory and a clock that stands still unless told.
class ProgressTest : public testing::Test
{
protected:
    ~ProgressTest() override
    {
        std::fclose(stream_);
        std::free(buffer_);
    }

    std::unique_ptr<Progress> make(bool is_terminal)
    {
        return std::make_unique<Progress>(stream_, is_terminal, [this] { return now_; });
    }

    void wait(std::chrono::milliseconds time) { now_ += time; }

    std::string text() const
    {
        std::fflush(stream_);
        return {buffer_, size_};
    }

private:
    std::chrono::steady_clock::time_point now_{1h};
    char* buffer_ = nullptr;
    std::size_t size_ = 0;
    std::FILE* stream_ = ::open_memstream(&buffer_, &size_);
};

ProgressSample sample_at(double time)
{
    ProgressSample sample;
    sample.time = time;
    sample.until = 1;
    sample.dem_ms = 12.34;
    sample.cfd_ms = 45.67;
    sample.void_fraction_min = 0.38;
    sample.void_fraction_max = 1;
    sample.courant = 0.21;
    sample.speed_max = 0.83;
    return sample;
}

TEST_F(ProgressTest, LogHasALineEveryTenSecondsAndTheLast)
{
    auto const progress = make(false);

    for (int step = 0; step <= 25; ++step)
    {
        progress->show(sample_at(step * 0.01));
        wait(1s);
    }
    progress->finish();

    EXPECT_THAT(text(), testing::MatchesRegex("t = 0.0000 of 1 s .*\n"
                                              "t = 0.1000 of 1 s .*\n"
                                              "t = 0.2000 of 1 s .*\n"
                                              "t = 0.2500 of 1 s .*\n"));
}

TEST_F(ProgressTest, LineTellsAllNumbersAndTheTimeLeft)
{
    auto const progress = make(false);

    progress->show(sample_at(0));
    wait(100s);
    progress->show(sample_at(0.25));

    // 100 s for a quarter: 400 s for the whole, 300 s are left
    EXPECT_THAT(text(), HasSubstr("t = 0.2500 of 1 s  left 5 min 00 s  DEM 12.3 ms  CFD 45.7 ms  "
                                  "void fraction 0.380..1.000  Co 0.21  fastest 0.83 m/s  400 s per simulated s\n"));
}

TEST_F(ProgressTest, TerminalLineIsRewrittenAtMostFiveTimesASecond)
{
    auto const progress = make(true);

    for (int step = 0; step < 1000; ++step)
    {
        progress->show(sample_at(step * 1e-3));
        wait(1ms);
    }

    std::string const shown = text();
    EXPECT_EQ(std::count(shown.begin(), shown.end(), '\r'), 5);
    EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 0);
}

TEST_F(ProgressTest, ShorterLineCoversTheLongerOne)
{
    auto const progress = make(true);
    progress->show(sample_at(0));
    std::size_t const length = text().size();
    ProgressSample shorter = sample_at(0.5);
    shorter.dem_ms = shorter.cfd_ms = shorter.courant = shorter.speed_max = NAN;

    wait(200ms);
    progress->show(shorter);

    EXPECT_GE(text().size(), 2 * length);
    EXPECT_THAT(text().substr(length), Not(HasSubstr("nan")));
}

TEST_F(ProgressTest, FinishLeavesTheLastSampleStanding)
{
    auto const progress = make(true);
    progress->show(sample_at(0));
    wait(10ms);
    progress->show(sample_at(0.9));

    progress->finish();
    std::string const once = text();
    progress->finish();

    EXPECT_THAT(once, HasSubstr("t = 0.9000"));
    EXPECT_EQ(once.back(), '\n');
    EXPECT_EQ(text(), once);
}

TEST_F(ProgressTest, ClearMakesRoomAndTheNextSampleShowsAtOnce)
{
    auto const progress = make(true);
    progress->show(sample_at(0));

    progress->clear();
    std::size_t const length = text().size();
    progress->show(sample_at(0.001));

    EXPECT_EQ(text()[length - 1], '\r');
    EXPECT_THAT(text().substr(length), HasSubstr("t = 0.0010"));
}

TEST_F(ProgressTest, SettlingIsAPhaseOfItsOwn)
{
    auto const progress = make(false);

    progress->show(SettlingSample{0, 0.5, 1e-6, 1e-9});
    wait(10s);
    progress->show(SettlingSample{0.1, 0.5, 2e-8, 1e-9});
    progress->show(sample_at(0));

    EXPECT_EQ(text(),
              "settling bed: t = 0.0000 of at most 0.5 s  mean kinetic energy 1.00e-06 J (settled below 1e-09 J)\n"
              "settling bed: t = 0.1000 of at most 0.5 s  mean kinetic energy 2.00e-08 J (settled below 1e-09 J)  "
              "left at most 40 s\n"
              "t = 0.0000 of 1 s  DEM 12.3 ms  CFD 45.7 ms  void fraction 0.380..1.000  Co 0.21  fastest 0.83 m/s\n");
}

}  // namespace
